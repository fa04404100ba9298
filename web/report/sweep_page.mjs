// The page of a sweep, part by part.
import { ChosenLayout } from './chosen_layout.mjs';
import { Filter, withFilter } from './filter.mjs';
import { trayOfLayout } from './first_screen.mjs';
import { heatMapSection } from './heat_map.mjs';
import { figuresOf } from './layout_figures.mjs';
import { layoutSection } from './layout_section.mjs';
import { layoutTableSection } from './layout_table.mjs';
import { rankingSection } from './ranked_chart.mjs';
import { ranked } from './ranking.mjs';
import { scatterSection } from './scatter.mjs';
import { Wanted } from './wanted.mjs';

// The figure that is looked at first, and the layout that has most of it, or least where little is wanted.
function leadOf(data) {
  const figures = figuresOf(data);
  const inOrder = [...figures].sort((a, b) => b.has_interval - a.has_interval);
  const figure = inOrder.find(({ name }) => name === 'rate_g_per_s') ?? inOrder[0];
  const first = figure ? ranked(data.layouts, figure, figure.wanted_low)[0]?.layout : null;
  return { figures, inOrder, figure, layout: first ?? data.layouts[0] };
}

function sections(data, { figures, inOrder, figure, layout }) {
  const chosen = new ChosenLayout(data.layouts, layout?.number ?? null);
  const filter = new Filter(data, inOrder, new Wanted(null, figure));
  return [
    figure ? withFilter(filter, rankingSection(data, inOrder, figure, chosen, filter)) : null, heatMapSection(data, inOrder, figure, chosen, filter), layoutTableSection(data, figures, chosen, filter),
    layoutSection(data, figures, chosen), scatterSection(data, figures, chosen, filter),
  ].filter(Boolean);
}

/** What main.mjs lays out of a sweep. */
export function sweepPage(data) {
  const lead = leadOf(data);
  return {
    kicker: `Sweep ${data.space === 'plane' ? 'in 2D' : 'in 3D'}`,
    title: data.title || 'A sweep',
    headlines: [data.headline, data.expected],
    remarks: data.remarks,
    tray: trayOfLayout(data, lead.layout, lead.figure ? `the ${lead.figure.wanted_low ? 'lowest' : 'highest'} ${lead.figure.words}` : 'the first'),
    whole: 'Every layout',
    beside: true,
    sections: async () => sections(data, lead),
  };
}

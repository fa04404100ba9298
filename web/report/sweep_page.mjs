// The page of a sweep, part by part.
import { ChosenLayout } from './chosen_layout.mjs';
import { figuresOf } from './layout_figures.mjs';
import { layoutSection } from './layout_section.mjs';
import { layoutTableSection } from './layout_table.mjs';
import { rankingSection } from './ranked_chart.mjs';
import { ranked } from './ranking.mjs';
import { scatterSection } from './scatter.mjs';

function sections(data) {
  const figures = figuresOf(data);
  const inOrder = [...figures].sort((a, b) => b.has_interval - a.has_interval);
  const figure = inOrder.find(({ name }) => name === 'rate_g_per_s') ?? inOrder[0];
  const first = figure ? ranked(data.layouts, figure, figure.wanted_low)[0]?.layout : null;
  const chosen = new ChosenLayout(data.layouts, (first ?? data.layouts[0])?.number ?? null);
  return [
    figure ? rankingSection(data, inOrder, figure, chosen) : null, layoutTableSection(data, figures, chosen),
    layoutSection(data, figures, chosen), scatterSection(data, figures, chosen),
  ].filter(Boolean);
}

/** What main.mjs lays out of a sweep. */
export function sweepPage(data) {
  return {
    kicker: `Sweep ${data.space === 'plane' ? 'in 2D' : 'in 3D'}`,
    title: data.title || 'A sweep',
    headlines: [data.headline, data.expected],
    remarks: data.doubts,
    whole: 'Every layout',
    beside: true,
    sections: async () => sections(data),
  };
}

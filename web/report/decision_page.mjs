// The page of a decision, part by part: the answer, the layouts in the order of the goal, and what was asked.
import { ChosenLayout } from './chosen_layout.mjs';
import { Filter, withFilter } from './filter.mjs';
import { trayOfLayout } from './first_screen.mjs';
import { figuresOf } from './layout_figures.mjs';
import { layoutSection } from './layout_section.mjs';
import { layoutTableSection } from './layout_table.mjs';
import { questionSection } from './question.mjs';
import { rankingSection } from './ranked_chart.mjs';
import { ranked } from './ranking.mjs';
import { scatterSection } from './scatter.mjs';
import { Wanted } from './wanted.mjs';

// What was decided by, and the layout that is the best, or the first in its order.
function leadOf(data) {
  const figures = figuresOf(data);
  const goal = figures.find((figure) => figure.judged) ?? figures[0];
  const rows = goal ? ranked(data.layouts, goal, goal.wanted_low) : [];
  const first = rows.find(({ told }) => told === 'first') ?? rows[0];
  return { figures, goal, layout: first?.layout ?? data.layouts[0] };
}

function sections(data, { figures, goal, layout }) {
  const chosen = new ChosenLayout(data.layouts, layout?.number ?? null);
  const filter = new Filter(data, figures, new Wanted(data.wanted, null));
  return [
    goal ? withFilter(filter, rankingSection(data, figures, goal, chosen, filter)) : null, layoutTableSection(data, figures, chosen, filter), layoutSection(data, figures, chosen),
    scatterSection(data, figures.filter((figure) => figure.has_interval), chosen, filter), questionSection(data),
  ].filter(Boolean);
}

/** What main.mjs lays out of a decision. */
export function decisionPage(data) {
  const lead = leadOf(data);
  return {
    kicker: `Decision ${data.space === 'plane' ? 'in 2D' : 'in 3D'}`,
    title: data.title || 'A decision',
    headlines: [data.headline, data.expected],
    remarks: data.remarks,
    tray: trayOfLayout(data, lead.layout, lead.layout?.standing),
    whole: 'Every layout',
    beside: true,
    sections: async () => sections(data, lead),
  };
}

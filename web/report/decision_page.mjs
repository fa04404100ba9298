// The page of a decision, part by part: the answer, the layouts in the order of the goal, and what was asked.
import { ChosenLayout } from './chosen_layout.mjs';
import { figuresOf } from './layout_figures.mjs';
import { layoutSection } from './layout_section.mjs';
import { layoutTableSection } from './layout_table.mjs';
import { questionSection } from './question.mjs';
import { rankingSection } from './ranked_chart.mjs';
import { ranked } from './ranking.mjs';
import { scatterSection } from './scatter.mjs';

function sections(data) {
  const figures = figuresOf(data);
  const goal = figures.find((figure) => figure.judged) ?? figures[0];
  const rows = goal ? ranked(data.layouts, goal, goal.wanted_low) : [];
  const first = rows.find(({ told }) => told === 'first') ?? rows[0];
  const chosen = new ChosenLayout(data.layouts, (first?.layout ?? data.layouts[0])?.number ?? null);
  return [
    goal ? rankingSection(data, figures, goal, chosen) : null, layoutTableSection(data, figures, chosen), layoutSection(data, figures, chosen),
    scatterSection(data, figures.filter((figure) => figure.has_interval), chosen), questionSection(data),
  ].filter(Boolean);
}

/** What main.mjs lays out of a decision. */
export function decisionPage(data) {
  return {
    kicker: `Decision ${data.space === 'plane' ? 'in 2D' : 'in 3D'}`,
    title: data.title || 'A decision',
    headlines: [data.headline, data.expected],
    remarks: data.doubts,
    whole: 'Every layout',
    beside: true,
    sections: async () => sections(data),
  };
}

// The page of a search for layouts that no other dominates: the front, every layout that was tried, and what was asked.
import { ChosenLayout } from './chosen_layout.mjs';
import { element } from './dom.mjs';
import { figuresOf } from './layout_figures.mjs';
import { layoutSection } from './layout_section.mjs';
import { layoutTableSection } from './layout_table.mjs';
import { questionSection } from './question.mjs';
import { rankingSection } from './ranked_chart.mjs';
import { ranked } from './ranking.mjs';
import { scatterOf } from './scatter.mjs';

const standings = { 'on the front': 'on-front', 'may be on the front': 'may-be', dominated: 'dominated' };

function leads(layout) {
  return layout.standing === 'on the front' || layout.first_by_means;
}

function legend(data) {
  const there = (standing) => data.layouts.some((layout) => layout.standing === standing);
  const dot = (name) => element('span', { class: `dot ${name}` });
  return [
    ...Object.entries(standings).filter(([standing]) => there(standing)).map(([standing, name]) => element('span', { class: 'legend-item' }, dot(name), standing)),
    data.layouts.some(({ compared }) => !compared) ? element('span', { class: 'legend-item' }, dot('not-ok'), 'misses a constraint, or failed') : null,
    element('span', {}, 'Crosses: 95 % intervals of those that lead and of the chosen one.'),
  ];
}

const look = { classOf: (layout) => standings[layout.standing] ?? 'not-ok', withIntervals: leads };

function sections(data) {
  const figures = figuresOf(data);
  const goals = figures.filter((figure) => figure.goal);
  const [first] = goals;
  const best = first ? ranked(data.layouts.filter(leads), first, first.wanted_low)[0]?.layout : null;
  const chosen = new ChosenLayout(data.layouts, (best ?? data.layouts[0])?.number ?? null);
  const compared = goals.length > 1
    ? scatterOf('The front', data, figures.filter((figure) => figure.has_interval), goals, chosen, { ...look, legend: () => legend(data) })
    : first && rankingSection(data, figures, first, chosen);
  return [compared, layoutTableSection(data, figures, chosen), layoutSection(data, figures, chosen), questionSection(data)].filter(Boolean);
}

/** What main.mjs lays out of a search for a front. */
export function frontPage(data) {
  return {
    kicker: `Pareto search ${data.space === 'plane' ? 'in 2D' : 'in 3D'}`,
    title: data.title || 'A search',
    headlines: [data.headline, data.expected],
    remarks: data.doubts,
    whole: 'Every layout',
    beside: true,
    sections: async () => sections(data),
  };
}

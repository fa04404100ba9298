// The page of a search for layouts that no other dominates: the front, every layout that was tried, and what was asked.
import { ChosenLayout } from './chosen_layout.mjs';
import { element } from './dom.mjs';
import { Filter, withFilter } from './filter.mjs';
import { trayOfLayout } from './first_screen.mjs';
import { list } from './format.mjs';
import { frontReason } from './front_reasons.mjs';
import { figuresOf } from './layout_figures.mjs';
import { layoutSection } from './layout_section.mjs';
import { layoutTableSection } from './layout_table.mjs';
import { keyWords } from './layout_words.mjs';
import { notes } from './light.mjs';
import { questionSection } from './question.mjs';
import { rankingSection } from './ranked_chart.mjs';
import { ranked } from './ranking.mjs';
import { scatterOf } from './scatter.mjs';
import { Wanted } from './wanted.mjs';

const standings = { 'on the front': 'on-front', 'may be on the front': 'may-be', dominated: 'dominated' };

function leads(layout) {
  return layout.standing === 'on the front' || layout.first_by_means;
}

// Of those that lead at the end of a range, each with which; none where there is none.
function edgeRemarks(data) {
  const words = keyWords(data.keys);
  return data.layouts.filter((layout) => layout.at_edge.length > 0 && leads(layout))
    .map((layout) => `layout ${layout.number} leads at the end of the range of ${list(layout.at_edge.map((key) => words[key].words))}: better ones may lie beyond`);
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

// The goals, and of the layouts that lead the best by the first of them.
function leadOf(data) {
  const figures = figuresOf(data);
  const goals = figures.filter((figure) => figure.goal);
  const best = goals.length ? ranked(data.layouts.filter(leads), goals[0], goals[0].wanted_low)[0]?.layout : null;
  return { figures, goals, layout: best ?? data.layouts[0] };
}

function sections(data, { figures, goals, layout }) {
  const chosen = new ChosenLayout(data.layouts, layout?.number ?? null);
  const filter = new Filter(data, figures, new Wanted(data.wanted, null));
  const why = (one) => frontReason(data, one, goals);
  const compared = goals.length > 1
    ? scatterOf('The front', data, figures.filter((figure) => figure.has_interval), goals, chosen, filter, { ...look, legend: () => legend(data), why })
    : goals.length > 0 && rankingSection(data, figures, goals[0], chosen, filter);
  return [compared && withFilter(filter, compared), layoutTableSection(data, figures, chosen, filter), layoutSection(data, figures, chosen, why), questionSection(data)].filter(Boolean);
}

/** What main.mjs lays out of a search for a front. */
export function frontPage(data) {
  const lead = leadOf(data);
  return {
    kicker: `Pareto search ${data.space === 'plane' ? 'in 2D' : 'in 3D'}`,
    title: data.title || 'A search',
    headlines: [data.headline, data.expected],
    remarks: [...data.remarks, ...notes(edgeRemarks(data))],
    tray: trayOfLayout(data, lead.layout, lead.layout?.standing),
    whole: 'Every layout',
    beside: true,
    sections: async () => sections(data, lead),
  };
}

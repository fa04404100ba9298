// The page of a sweep, part by part.
import { list } from './format.mjs';
import { ChosenLayout } from './chosen_layout.mjs';
import { figuresOf } from './layout_figures.mjs';
import { layoutSection } from './layout_section.mjs';
import { layoutTableSection } from './layout_table.mjs';
import { sentenceWithNote } from './layout_words.mjs';
import { rankingSection } from './ranked_chart.mjs';
import { ranked } from './ranking.mjs';
import { scatterSection } from './scatter.mjs';

const doubtsShown = 6;
const numbersShown = 12;
const words = {
  'outside the model': ['lies outside the model', 'lie outside the model'], invalid: ['cannot be built', 'cannot be built'],
  stopped: ['was stopped by the guard', 'were stopped by the guard'], incomplete: ['has runs that are missing', 'have runs that are missing'],
  failed: ['failed', 'failed'],
};

function numbersOf(layouts) {
  const numbers = layouts.map((layout) => String(layout.number));
  if (numbers.length <= numbersShown) return list(numbers);
  return `${numbers.slice(0, numbersShown).join(', ')} and ${numbers.length - numbersShown} more`;
}

/** A sentence for every reason why these layouts are not compared; beyond six reasons, one that counts the rest. */
export function doubtsOf(data) {
  const reasons = new Map();
  for (const layout of data.layouts) {
    const reason = `${layout.status}\n${layout.note}`;
    reasons.set(reason, [...(reasons.get(reason) ?? []), layout]);
  }
  const sentences = [...reasons.values()].map((layouts) => {
    const [{ status, note }] = layouts;
    const [one, many] = words[status] ?? [`is ${status}`, `are ${status}`];
    const what = layouts.length === 1 ? `Layout ${layouts[0].number} ${one}` : `Layouts ${numbersOf(layouts)} ${many}`;
    return sentenceWithNote(what, note);
  });
  if (sentences.length <= doubtsShown) return sentences;
  const rest = [...reasons.values()].slice(doubtsShown).flat().length;
  return [...sentences.slice(0, doubtsShown), `${rest} more layout${rest === 1 ? ' is' : 's are'} not compared, for other reasons: the table names them.`];
}

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
    kicker: `Sweep ${data.space === 'plane' ? 'in the plane' : 'in space'}`,
    title: data.title || 'A sweep',
    headlines: [data.headline],
    remarks: [...data.doubts, ...doubtsOf({ layouts: data.layouts.filter(({ compared }) => !compared) })],
    whole: 'Every layout',
    beside: true,
    sections: async () => sections(data),
  };
}

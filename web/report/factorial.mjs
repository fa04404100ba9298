// A study whose layouts are all combinations of a few choices: the choices, and what each does to a figure.
import { valueOf } from './layout_figures.mjs';
import { keyWords, withUnit } from './layout_words.mjs';
import { eachOf } from './same_layouts.mjs';

function levelsOf(layouts, of) {
  return [...new Set(layouts.map(of))].sort((a, b) => a.localeCompare(b, 'en', { numeric: true }));
}

/** What layouts are told apart by: { name, of(layout): text, levels }, of names and of keys that differ among layouts of one name. */
export function factorsOf({ keys, layouts: shown }) {
  const layouts = shown.flatMap(eachOf);
  const byName = levelsOf(layouts, ({ name }) => name);
  const named = byName.length > 1 ? [{ name: 'layout', of: (layout) => layout.name, levels: byName }] : [];
  const differs = (of) => byName.some((name) => levelsOf(layouts.filter((layout) => layout.name === name), of).length > 1);
  const ofKeys = keyWords(keys).map(({ words, unit }, k) => {
    const of = (layout) => withUnit(layout.values[k] ?? '', unit);
    return { name: words, of, levels: levelsOf(layouts, of) };
  }).filter(({ of }) => differs(of));
  return [...named, ...ofKeys];
}

/** The factors of a study that has every combination of them; none of another study, or of one factor. */
export function factorialOf(data) {
  const factors = factorsOf(data);
  const combinations = factors.reduce((product, { levels }) => product * levels.length, 1);
  const there = new Set(data.layouts.flatMap(eachOf).map((layout) => JSON.stringify(factors.map(({ of }) => of(layout)))));
  return factors.length > 1 && there.size === combinations ? factors : [];
}

// The mean of a figure over those layouts that are compared and have it, with the least and the most; null of none.
function summaryOf(layouts, figure) {
  const values = layouts.filter(({ compared }) => compared).map((layout) => valueOf(layout, figure)).filter(Boolean).map(({ value }) => value);
  if (values.length === 0) return null;
  return { value: values.reduce((sum, one) => sum + one, 0) / values.length, low: Math.min(...values), high: Math.max(...values), count: values.length };
}

/** Of each factor the mean of the figure at each level, over all levels of the others; those first that change it most: [{ factor, levels: [{ level, summary }], size }]. */
export function mainEffects({ layouts }, factors, figure) {
  return factors.map((factor) => {
    const levels = factor.levels.map((level) => ({ level, summary: summaryOf(layouts.flatMap(eachOf).filter((layout) => factor.of(layout) === level), figure) }));
    const means = levels.filter(({ summary }) => summary).map(({ summary }) => summary.value);
    return { factor, levels, size: means.length ? Math.max(...means) - Math.min(...means) : 0 };
  }).sort((a, b) => b.size - a.size);
}

/** Cells of two factors, a row for each level of the first: { layouts, summary }. */
export function cellsOf({ layouts }, [down, across], figure) {
  return down.levels.map((row) => across.levels.map((column) => {
    const own = layouts.flatMap(eachOf).filter((layout) => down.of(layout) === row && across.of(layout) === column);
    return { layouts: own, summary: summaryOf(own, figure) };
  }));
}

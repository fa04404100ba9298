// Layouts in the order of a figure, and which of them the intervals do not tell apart from the first.
import { list } from './format.mjs';
import { textWithUnit, valueOf } from './layout_figures.mjs';
import { layoutInSentence } from './layout_words.mjs';
import { toldByDecision } from './told_words.mjs';

function overlap(a, b) {
  if (a.low === null || a.high === null || b.low === null || b.high === null) return null;
  return a.low <= b.high && b.low <= a.high;
}

/**
 * [{ layout, value, told }] of the layouts that have the figure: those that are compared first, in its order; layouts of the same
 * value by number. `told`: "first", "alike" (its interval overlaps that of the first), "apart", "no interval"; "not compared". Where the figure is what a decision was made by, `told` is what the decision found.
 */
export function ranked(layouts, figure, leastFirst) {
  const sign = leastFirst ? 1 : -1;
  const rows = layouts.map((layout) => ({ layout, value: valueOf(layout, figure) })).filter((row) => row.value)
    .sort((a, b) => b.layout.compared - a.layout.compared || sign * (a.value.value - b.value.value) || a.layout.number - b.layout.number);
  const first = rows[0]?.layout.compared ? rows[0] : null;
  const toldOf = (row) => {
    if (!row.layout.compared) return 'not compared';
    if (figure.judged) return toldByDecision(row.layout);
    if (row === first) return 'first';
    const same = overlap(row.value, first.value);
    return same === null ? 'no interval' : same ? 'alike' : 'apart';
  };
  return rows.map((row) => ({ ...row, told: toldOf(row) }));
}

function alikeWords(count) {
  if (count === 0) return 'no other interval overlaps its own';
  return count === 1 ? '1 other is not told apart from it' : `${count} others are not told apart from it`;
}

/** Who is best, and how many are not shown to be worse, worse, or not compared. */
function decisionSentence(data, rows, figure) {
  const best = rows.find((row) => row.told === 'first');
  const of = (standing) => data.layouts.filter((layout) => layout.standing === standing).length;
  const are = (count, one, many) => `${count} ${count === 1 ? one : many}`;
  const rest = [
    [of('undecided'), 'may still be the best', 'may still be the best'], [of('not shown to be worse'), 'is not shown to be worse', 'are not shown to be worse'],
    [of('worse'), 'is worse', 'are worse'], [data.layouts.filter(({ compared }) => !compared).length, 'is not compared', 'are not compared'],
  ].filter(([count]) => count > 0).map((words) => are(...words));
  const lead = best ? `By ${figure.words} ${layoutInSentence(data, best.layout)} is the best: ${textWithUnit(best.value, figure)}` : `By ${figure.words} no layout is known to be the best`;
  return `${lead}${rest.length ? `; of the ${best ? 'others' : 'layouts'} ${list(rest)}` : ''}.`;
}

/** Who is first, and how many are not told apart from it. */
export function rankingSentence(data, rows, figure, leastFirst) {
  if (figure.judged) return decisionSentence(data, rows, figure);
  const first = rows.find((row) => row.told === 'first');
  const without = data.layouts.length - rows.length;
  const missing = without === 0 ? '' : ` ${without} layout${without === 1 ? ' has' : 's have'} no value of it.`;
  if (!first) return `No layout that can be compared has a value of ${figure.words}.`;
  const compared = rows.filter((row) => row.told !== 'not compared');
  const alike = rows.filter((row) => row.told === 'alike').length;
  const unknown = rows.filter((row) => row.told === 'no interval').length;
  const lead = `By ${figure.words} ${layoutInSentence(data, first.layout)} has the ${leastFirst ? 'least' : 'most'}: ${textWithUnit(first.value, figure)}`;
  if (compared.length === 1) return `${lead}; there is none to compare it with.${missing}`;
  if (unknown === compared.length - 1) return `${lead}; without intervals nothing says which layouts differ from it.${missing}`;
  const some = unknown === 0 ? '' : `, and ${unknown} ${unknown === 1 ? 'has' : 'have'} no interval`;
  return `${lead}; ${alikeWords(alike)}${some}.${missing}`;
}

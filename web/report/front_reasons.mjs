// Why a layout of a search is where it is: which layouts beat it, and by how much; or that none does.
import { list } from './format.mjs';
import { textWithUnit, valueOf } from './layout_figures.mjs';

const mostNamed = 3;

const ends = ({ value, low, high }) => [low ?? value, high ?? value];
const overlap = (a, b) => ends(a)[0] <= ends(b)[1] && ends(b)[0] <= ends(a)[1];

// The layout's values of all goals; null where one is missing.
function valuesOf(layout, goals) {
  const values = goals.map((goal) => valueOf(layout, goal));
  return values.every(Boolean) ? values : null;
}

function beats(a, b, goals) {
  const ahead = goals.map((goal, g) => (goal.wanted_low ? b[g].value - a[g].value : a[g].value - b[g].value));
  return ahead.every((by) => by >= 0) && ahead.some((by) => by > 0);
}

const called = (numbers) => (numbers.length === 1 ? `layout ${numbers[0]}` : `layouts ${list(numbers.map(String))}`);
const against = (better, own, goals) => list(goals.map((goal, g) => `${goal.words} ${textWithUnit(better[g], goal)} against ${textWithUnit(own[g], goal)}`));

// Those of the others that are best in a goal.
function bestIn(own, others, goals) {
  return goals.filter((goal, g) => others.every(({ values }) => (goal.wanted_low ? own[g].value <= values[g].value : own[g].value >= values[g].value))).map(({ words }) => words);
}

/** One sentence on a layout that is compared, by its means and 95 % intervals; "" of another, or where a goal has no value. */
export function frontReason(data, layout, goals) {
  const own = layout.compared ? valuesOf(layout, goals) : null;
  if (!own || goals.length === 0) return '';
  const others = data.layouts.filter((other) => other !== layout && other.compared).map((other) => ({ other, values: valuesOf(other, goals) })).filter(({ values }) => values);
  const ahead = others.filter(({ values }) => beats(values, own, goals)).sort((a, b) => (b.other.standing === 'on the front') - (a.other.standing === 'on the front') || a.other.number - b.other.number);
  if (ahead.length > 0) {
    const [first] = ahead, more = ahead.length - 1;
    const unsure = goals.filter((goal, g) => overlap(first.values[g], own[g])).map(({ words }) => words);
    const by = `Layout ${first.other.number} beats it by the means, ${against(first.values, own, goals)}${more ? `; so ${more === 1 ? 'does' : 'do'} ${more} more` : ''}`;
    return layout.standing === 'dominated' || unsure.length === 0 ? `${by}.` : `${by}; but the intervals of ${list(unsure)} overlap.`;
  }
  const best = bestIn(own, others, goals);
  const lead = `No layout beats it by the means${best.length ? `: it is the best in ${list(best)}` : ''}`;
  const near = others.filter(({ values }) => values.every((value, g) => overlap(value, own[g]))).map(({ other }) => other.number);
  if (layout.standing !== 'may be on the front' || near.length === 0) return `${lead}.`;
  return `${lead}; but its intervals overlap those of ${near.length > mostNamed ? `${near.length} layouts` : called(near)}.`;
}

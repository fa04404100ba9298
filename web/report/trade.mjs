// Two figures of the layouts against each other: which layouts no other beats in both.
import { valueOf } from './layout_figures.mjs';
import { list } from './format.mjs';

/** [{ layout, x, y }] of the layouts that have both; x and y as valueOf gives them. */
export function pointsOf(layouts, figureX, figureY) {
  return layouts.map((layout) => ({ layout, x: valueOf(layout, figureX), y: valueOf(layout, figureY) })).filter(({ x, y }) => x && y);
}

/** Those that are compared and that no other one beats: as good in both and better in one. In the order of x. */
export function unbeaten(points, figureX, figureY) {
  const worth = ({ x, y }) => [figureX.wanted_low ? -x.value : x.value, figureY.wanted_low ? -y.value : y.value];
  const ok = points.filter(({ layout }) => layout.compared);
  const beats = (a, b) => a[0] >= b[0] && a[1] >= b[1] && (a[0] > b[0] || a[1] > b[1]);
  return ok.filter((one) => !ok.some((other) => beats(worth(other), worth(one)))).sort((a, b) => a.x.value - b.x.value || a.y.value - b.y.value);
}

const named = 8;

export function tradeSentence(data, points, front, figureX, figureY) {
  const missing = data.layouts.length - points.length;
  const without = missing === 0 ? '' : ` ${missing} layout${missing === 1 ? ' has' : 's have'} no value of one of the two and ${missing === 1 ? 'is' : 'are'} not shown.`;
  if (front.length === 0) return `No layout that can be compared has both figures.${without}`;
  const numbers = front.map(({ layout }) => layout.number).sort((a, b) => a - b);
  const which = numbers.length === 1 ? `layout ${numbers[0]}` : numbers.length > named ? `the ${numbers.length} layouts on the line` : `layouts ${list(numbers.map(String))}`;
  const small = front.some(({ x, y }) => x.below || y.below) ? ', what is too small to be resolved taken as 0' : '';
  const goal = (figure) => `${figure.wanted_low ? 'low' : 'high'} ${figure.words}`;
  return `For a ${goal(figureX)} and a ${goal(figureY)}, no layout beats ${which} in both, by their means${small}.${without}`;
}

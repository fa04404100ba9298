// Where a chart has its values: axes, their numbers and the grid, in SVG.
import { shape } from './dom.mjs';
import { axisScale, number } from './format.mjs';

const margin = { left: 62, right: 16, top: 14, bottom: 46 };
const steps = 12;             // of an axis with round ends: so many that little of it is empty
const room = { x: 90, y: 46 };  // px of a number of an axis

/** From `low` to `high`. `more`: { ticks: [{ at, text }] } instead of round ones, { log: true }. */
export function axis(title, low, high, more = {}) {
  return { title, low, high, ...more };
}

/** The same, with round ends that hold both. */
export function roundAxis(title, low, high) {
  const scale = axisScale(low, high, steps);
  return axis(title, scale.low, scale.high);
}

/** Logarithmic, with a number at each power of ten. */
export function logAxis(title, [low, high]) {
  const first = Math.ceil(Math.log10(low) - 1e-9), last = Math.floor(Math.log10(high) + 1e-9);
  const ticks = Array.from({ length: Math.max(0, last - first + 1) }, (_, k) => 10 ** (first + k)).map((at) => ({ at, text: number(at) }));
  return axis(title, low, high, { ticks, log: true });
}

function ticksOf({ low, high, ticks }, length, each) {
  if (ticks) return ticks;
  const slack = 1e-9 * (high - low);
  return axisScale(low, high, Math.max(2, Math.floor(length / each))).ticks.filter((at) => at >= low - slack && at <= high + slack).map((at) => ({ at, text: number(at) }));
}

// px of a value; the axis lies from `from` to `to`.
function placer({ low, high, log }, from, to) {
  const of = log ? Math.log10 : (value) => value;
  return (value) => from + ((of(value) - of(low)) / (of(high) - of(low) || 1)) * (to - from);
}

/** { x(value), y(value), inside: { left, right, top, bottom }, grid } of a chart so wide and high (px). */
export function plotFrame(width, height, xAxis, yAxis) {
  const inside = { left: margin.left, right: width - margin.right, top: margin.top, bottom: height - margin.bottom };
  const { left, right, top, bottom } = inside;
  const x = placer(xAxis, left, right), y = placer(yAxis, bottom, top);
  const text = (attributes, words) => shape('text', attributes, words);
  const grid = shape('g', { class: 'grid', 'aria-hidden': 'true' },
    ticksOf(xAxis, right - left, room.x).map(({ at, text: words }) => [xAxis.bare ? null : shape('path', { d: `M${x(at)} ${top}V${bottom}` }), text({ x: x(at), y: bottom + 18, 'text-anchor': 'middle' }, words)]),
    ticksOf(yAxis, bottom - top, room.y).map(({ at, text: words }) => [shape('path', { d: `M${left} ${y(at)}H${right}` }), text({ x: left - 8, y: y(at) + 4, 'text-anchor': 'end' }, words)]),
    text({ x: (left + right) / 2, y: height - 8, 'text-anchor': 'middle' }, xAxis.title),
    text({ transform: `translate(14 ${(top + bottom) / 2}) rotate(-90)`, 'text-anchor': 'middle' }, yAxis.title));
  return { x, y, inside, grid };
}

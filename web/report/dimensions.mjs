// Dimension lines of a drawing, in mm: from rim to rim, with what lies between them.
import { shape } from './dom.mjs';
import { millimetres } from './format.mjs';
import { floorAt, restPose } from './geometry.mjs';

const same = 0.05;    // mm: places that differ by less are one
const mostSteps = 6;  // places that have a dimension each; of more, only the ends have

/** Sorted, without those that are the same. */
export function different(places) {
  const sorted = [...places].sort((a, b) => a - b);
  return sorted.filter((place, k) => k === 0 || place - sorted[k - 1] > same);
}

/** The step of equal steps between sorted places; null where there are fewer than three, or they differ. */
export function stepOf(places) {
  const steps = places.slice(1).map((place, k) => place - places[k]);
  return steps.length > 1 && Math.max(...steps) - Math.min(...steps) < same ? steps[0] : null;
}

/** What a chain of dimensions says from 0 over the holes' places to the end: [{ from, to, text }]. */
export function chainOf(places, length) {
  const centres = different(places);
  if (centres.length === 0) return [];
  const [first, last] = [centres[0], centres[centres.length - 1]];
  const step = stepOf(centres);
  const part = (from, to, text = millimetres(to - from)) => ({ from, to, text });
  const between = step === null && centres.length <= mostSteps ? centres.slice(1).map((place, k) => part(centres[k], place))
    : centres.length > 1 ? [part(first, last, step === null ? undefined : `${centres.length - 1} × ${millimetres(step)}`)] : [];
  return [part(0, first), ...between, part(last, length)].filter(({ from, to }) => to - from > same);
}

/** Of each width the first hole: "⌀ 12" of a round one, "12" of a slot. */
export function widthsOf(holes) {
  const text = (hole) => `${hole.round ? '⌀ ' : ''}${millimetres(2 * hole.half_x_mm)}`;
  return holes.filter((hole, k) => holes.findIndex((other) => text(other) === text(hole)) === k).map((hole) => ({ hole, text: text(hole) }));
}

/**
 * A dimension line between two places, both moved by `away`; `place` takes a place of the drawing's own frame to the picture's (y down).
 * `size`: of its text, mm; `turned`: degrees.
 */
function dimension(place, [from, to], away, text, size, turned) {
  const moved = ([x, y], by = 1) => place([x + by * away[0], y + by * away[1]]);
  const [a, b] = [moved(from), moved(to)];
  const line = (...points) => `M${points.map(([x, y]) => `${x.toFixed(2)} ${y.toFixed(2)}`).join('L')}`;
  const tick = ([x, y]) => line([x - 0.22 * size, y + 0.22 * size], [x + 0.22 * size, y - 0.22 * size]);
  const isFlat = from[1] === to[1], fits = Math.hypot(b[0] - a[0], b[1] - a[1]) > 0.62 * size * text.length;
  const [x, y] = fits || !isFlat ? [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2] : [b[0] + 0.4 * size, b[1] + 0.6 * size];
  return shape('g', { class: 'dimension' },
    shape('path', { d: [from, to].map((one, k) => line(place(one), [a, b][k])).join('') + line(a, b) + tick(a) + tick(b) }),
    shape('text', { 'font-size': size, 'text-anchor': isFlat && fits ? 'middle' : 'start', transform: `translate(${(x + (isFlat ? 0 : 0.35 * size)).toFixed(2)} ${(y + (isFlat ? -0.3 : 0.35) * size).toFixed(2)}) rotate(${turned})` }, text));
}

/** Of the tray from the side: the holes' places and the length under it, its height beside it, the holes' widths over them. `below`: mm under the floor that is taken. */
export function sideDimensions(tray, place, size, below) {
  const turned = (-(tray.tilt_rad ?? 0) * 180) / Math.PI;
  const { length_mm: length, height_mm: height, holes } = tray;
  const low = Math.min(0, ...tray.lines.flatMap(({ points_mm: points }) => points.map(([, y]) => y)));
  const along = (from, to, text, row) => dimension(place, [[from, 0], [to, 0]], [0, low - below - 1.5 * row * size], text, size, turned);
  const chain = chainOf(holes.map(({ x_mm: x }) => x), length);
  return [
    ...chain.map(({ from, to, text }) => along(from, to, text, 1)), along(0, length, millimetres(length), chain.length > 0 ? 2 : 1),
    height > 0 ? dimension(place, [[length, 0], [length, height]], [1.2 * size, 0], millimetres(height), size, turned) : null,
    ...widthsOf(holes).map(({ hole, text }) => dimension(place, [-1, 1].map((side) => [hole.x_mm + side * hole.half_x_mm, floorAt(tray, hole)]), [0, 0.9 * size], text, size, turned)),
  ];
}

/** Of a hopper over a level tray: what it lets through, and how high over the floor it ends. `place`: of its own frame. */
export function hopperDimensions(tray, hopper, place, size) {
  const widths = widthsOf(hopper.holes).map(({ hole, text }) => dimension(place, [-1, 1].map((side) => [hole.x_mm + side * hole.half_x_mm, floorAt(hopper, hole)]), [0, 0.9 * size], text, size, 0));
  const points = hopper.lines.flatMap(({ points_mm: all }) => all);
  const low = Math.min(...points.map(([, y]) => y)), right = Math.max(...points.filter(([, y]) => y - low < same).map(([x]) => x));
  const floor = (restPose(tray).y - restPose(hopper).y) * 1000;  // in the hopper's frame
  if (tray.tilt_rad || hopper.tilt_rad || !(low - floor > same)) return widths;
  return [...widths, dimension(place, [[right, floor], [right, low]], [0.8 * size, 0], millimetres(low - floor), size, 0)];
}

/** Lines of text that stand under a tray for its dimensions. */
export function dimensionRows(vessels) {
  return vessels.some(({ holes }) => holes.length > 0) ? 2 : 1;
}

/** Of the tray from above: its depth beside it. */
export function aboveDimensions({ length_mm: length, depth_mm: depth }, place, size) {
  return [dimension(place, [[length, 0], [length, depth]], [1.2 * size, 0], millimetres(depth), size, 0)];
}

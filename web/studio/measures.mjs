// Dimensions of the tray, a scale bar and the ends of its shake, drawn over its picture; a ruler under its floor.
import { shape } from '../report/dom.mjs';
import { niceAbove, number } from '../report/format.mjs';
import { toLab } from '../report/geometry.mjs';
import { swingOf } from './live_recording.mjs';
import { mmOf } from './quantities.mjs';

const barWidth = 70;      // px, about, of a scale bar
const markWidth = 64;     // px, at least, between two numbers of the ruler
const leastSwing = 1.5;   // px, below which the ends of a shake are not told from its middle
const inset = 12;         // px of the height's line from where the wall comes to
const half = 4;           // px of the stroke that ends a dimension

/** Marks, mm, of a ruler so long (mm) where a millimetre has `scale` px: round ones, and the end. */
export function rulerMarks(length, scale) {
  const step = niceAbove(markWidth / scale);
  const marks = Array.from({ length: Math.floor(length / step) + 1 }, (_, k) => k * step);
  return length - marks[marks.length - 1] < 1e-6 ? marks : [...marks.filter((mark) => mark === 0 || length - mark >= 0.75 * step), length];
}

/** A round length, mm, of a scale bar. */
export function barLength(scale) {
  return niceAbove(barWidth / scale / 2);
}

/** "9 Hz, \u00b110 mm"; of a motion that is not harmonic, nothing. */
export function shakeWords(motion) {
  return motion ? `${number(motion.frequency_hz)} Hz, ±${number(mmOf(motion.amplitude_m))} mm` : '';
}

function line(points) {
  return `M${points.map(([x, y]) => `${x.toFixed(1)} ${y.toFixed(1)}`).join('L')}`;
}

// A line with a stroke at each end.
function measured([x, y], [toX, toY]) {
  const length = Math.hypot(toX - x, toY - y) || 1;
  const [dx, dy] = [(-half * (toY - y)) / length, (half * (toX - x)) / length];
  const stroke = (a, b) => line([[a - dx, b - dy], [a + dx, b + dy]]);
  return shape('path', { d: line([[x, y], [toX, toY]]) + stroke(x, y) + stroke(toX, toY) });
}

function text(words, x, y, more = {}) {
  return shape('text', { x: x.toFixed(1), y: y.toFixed(1), ...more }, words);
}

function heightOf({ tray, pose, place, trayMotion }) {
  const x = tray.length_mm - Math.abs(swingOf(trayMotion)[0]) * 1000 - inset / place.scale;
  const low = place.of(...toLab(pose, x, 0)), high = place.of(...toLab(pose, x, tray.height_mm));
  return shape('g', { class: 'dimension' }, measured(low, high), text(`${number(tray.height_mm)} mm`, high[0] - 8, high[1] + 14, { 'text-anchor': 'end' }));
}

function scaleBar({ place, height }) {
  const length = barLength(place.scale), y = height - 8;
  return shape('g', { class: 'scale-bar' }, measured([14, y], [14 + length * place.scale, y]), text(`${number(length)} mm`, 22 + length * place.scale, y + 4));
}

// The tray's walls where the shake ends, and how it shakes.
function shakeOf({ tray, pose, place, motion, trayMotion }) {
  const [x, y] = swingOf(trayMotion);
  const seen = Math.hypot(x, y) * 1000 * place.scale >= leastSwing;
  const at = (sign) => (tray.lines ?? []).map(({ points_mm: points }) => line(points.map(([a, b]) => place.of(...toLab({ ...pose, x: pose.x + sign * x, y: pose.y + sign * y }, a, b))))).join('');
  const [left, top] = place.of(...toLab(pose, 0, tray.height_mm));
  return shape('g', { class: 'shake' }, seen ? [-1, 1].map((sign) => shape('path', { class: 'shake-end', d: at(sign) })) : [],
    text(shakeWords(motion), left + 8 + Math.abs(x) * 1000 * place.scale, top + 14));
}

function rulerOf({ tray, pose, place, height, strip }) {
  const y = height + strip - 16;
  return shape('g', { class: 'ruler' }, rulerMarks(tray.length_mm, place.scale).map((mark) => {
    const [x] = place.of(...toLab(pose, mark, 0));
    return [shape('path', { d: line([[x, y - 6], [x, y]]) }), text(mark === tray.length_mm ? `${number(mark)} mm` : number(mark), x, y + 12, { 'text-anchor': 'middle' })];
  }));
}

export class Measures {
  constructor() {
    this.frame = shape('svg', { class: 'measures', 'aria-hidden': 'true' });
  }

  /**
   * `tray`: the vessel, at rest in `pose`; `place`: { scale (px a mm), of(x, y): px of a place of the lab }; `motion`: of the layout,
   * `trayMotion`: of its scene; `height`: px of the picture, under which is the strip of the handles; `still`: the tray is held still.
   */
  show(what) {
    this.frame.replaceChildren(heightOf(what), scaleBar(what), ...(what.still ? [] : [shakeOf(what)]), rulerOf(what));
  }

  clear() {
    this.frame.replaceChildren();
  }
}

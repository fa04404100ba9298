// A chart, in SVG: it follows the page's width, is light or dark as the page is, gives its values under the pointer and by keys, and is saved.
import { saveButtons } from './chart_files.mjs';
import { element, shape } from './dom.mjs';
import { plotFrame } from './plot.mjs';
import { onTheme, theme } from './theme.mjs';

const cap = 4;     // px to either side at the ends of an interval
const size = 4.5;  // px, half, of a point
const dashes = ['', '7 4', '2 3', '11 4 2 4'];

/** The dashes of the line with a place in a list, so that not colour alone tells it from the others. */
export function dashOf(place) {
  return dashes[place % dashes.length];
}

const path = (points) => points.map(([x, y], k) => `${k ? 'L' : 'M'}${x.toFixed(2)} ${y.toFixed(2)}`).join('');
const outlines = {
  circle: (r) => [[r, 0], ...Array.from({ length: 23 }, (_, k) => [r * Math.cos(((k + 1) * Math.PI) / 12), r * Math.sin(((k + 1) * Math.PI) / 12)])],
  square: (r) => [[-r, -r], [r, -r], [r, r], [-r, r]].map(([x, y]) => [0.9 * x, 0.9 * y]),
  triangle: (r) => [[0, -1.25 * r], [1.1 * r, 0.8 * r], [-1.1 * r, 0.8 * r]],
  diamond: (r) => [[0, -1.3 * r], [1.3 * r, 0], [0, 1.3 * r], [-1.3 * r, 0]],
};
const markers = Object.keys(outlines);

/** The shape of points with a place in a list: told apart without colour. */
export function markerOf(place) {
  return markers[place % markers.length];
}

/** A marker by itself, for a legend. */
export function markerPicture(name, style) {
  return shape('svg', { class: 'marker', viewBox: '-8 -8 16 16', 'aria-hidden': 'true' }, shape('path', { d: `${path(outlines[name](6))}Z`, style }));
}

const interval = (x, low, high) => `M${x - cap} ${low}h${2 * cap}M${x - cap} ${high}h${2 * cap}M${x} ${low}V${high}`;
const hasInterval = ({ low, high }) => Number.isFinite(low) && Number.isFinite(high);

// What a chart is made of: each takes a layer and the frame, and gives shapes.
const drawn = {
  shade: ({ from, to }, { x, inside }) => shape('rect', { class: 'window', x: x(from), y: inside.top, width: Math.max(0, x(to) - x(from)), height: inside.bottom - inside.top }),
  band: ({ points }, { x, y }) => shape('path', { class: 'interval-band', d: points.length ? `${path([...points.map(([at, low]) => [x(at), y(low)]), ...[...points].reverse().map(([at, , high]) => [x(at), y(high)])])}Z` : '' }),
  line: ({ points, style }, { x, y }) => shape('path', { class: 'line', style, d: path(points.map(([at, value]) => [x(at), y(value)])) }),
  rule: ({ from, to }, { x, y }) => shape('path', { class: 'rule', d: path([from, to].map(([at, value]) => [x(at), y(value)])) }),
  bars: ({ bars, half }, { x, y }) => bars.filter(({ value }) => Number.isFinite(value)).map((bar) => [
    shape('rect', { class: 'bar', x: x(bar.x - half), width: x(bar.x + half) - x(bar.x - half), y: y(bar.value), height: y(0) - y(bar.value) }),
    hasInterval(bar) ? shape('path', { class: 'interval', d: interval(x(bar.x), y(bar.low), y(bar.high)) }) : null,
  ]),
  points: ({ points, marker = 'circle', style, plain }, { x, y }) => points.map((point) => [
    hasInterval(point) ? shape('path', { class: 'interval', style: plain ? null : style, d: interval(x(point.x), y(point.low), y(point.high)) }) : null,
    shape('path', { class: ['point-mark', point.look].filter(Boolean).join(' '), style: point.style ?? style, transform: `translate(${x(point.x)} ${y(point.y)})`, d: `${path(outlines[marker](point.size ?? size))}Z` }),
    point.label ? shape('text', { class: 'point-label', x: x(point.x) + 9, y: y(point.y) + 4 }, point.label) : null,
  ]),
};

// The frame, in which what is beyond an axis stays at its end.
function clamped({ x, y, inside }) {
  const { left, right, top, bottom } = inside;
  return { inside, x: (value) => Math.min(right, Math.max(left, x(value))), y: (value) => Math.min(bottom, Math.max(top, y(value))) };
}

export class Chart {
  /**
   * `name`: said aloud; `file`: what its files are called. `make(theme)` gives { x, y (axes), layers: [{ kind, .. }], marks: [{ x, y (optional), text }] by
   * x, which are what is read, table: { columns, rows } }. `seek(x)` is called with where a press or a stroke is, if it is given.
   */
  constructor(name, file, make, { height = 300, seek = null } = {}) {
    Object.assign(this, { make, height, seek, at: -1, time: null });
    this.place = element('div', { class: 'chart-place', style: `height:${height}px` });  // so that drawing moves nothing
    this.reading = element('p', { class: 'chart-reading', 'aria-hidden': 'true' });
    this.frame = element('div', { class: 'chart', role: 'group', 'aria-label': name }, this.place,
      element('div', { class: 'chart-foot' }, this.reading, saveButtons(file, () => this.svg, () => this.content.table)));
    new ResizeObserver(() => { if (this.place.clientWidth !== this.width) this.draw(); }).observe(this.place);
    onTheme(() => this.draw());
  }

  draw() {
    this.width = this.place.clientWidth;
    if (!this.width) return;
    const hadFocus = this.svg && document.activeElement === this.svg;
    const content = this.content = this.make(theme());
    this.plot = plotFrame(this.width, this.height, content.x, content.y);
    this.cursor = shape('g', { class: 'reading', visibility: 'hidden' }, shape('path', {}), shape('circle', { r: 7 }));
    this.timeLine = shape('path', { class: 'time-line reading' });
    this.svg = shape('svg', { width: this.width, height: this.height, viewBox: `0 0 ${this.width} ${this.height}`, tabindex: 0, role: 'slider', 'aria-label': 'Values of the chart, one by one', 'aria-valuemin': 0,
      'aria-valuemax': Math.max(0, content.marks.length - 1), 'aria-valuenow': 0, 'aria-valuetext': 'Arrow keys go through its values',
      onkeydown: (event) => this.key(event), onpointermove: (event) => this.point(event), onpointerdown: (event) => this.press(event), onpointerleave: () => this.read(-1), onblur: () => this.read(-1) },
    this.plot.grid, content.layers.map((layer) => drawn[layer.kind](layer, clamped(this.plot))), this.timeLine, this.cursor);
    this.place.replaceChildren(this.svg);
    if (hadFocus) this.svg.focus();
    this.showTime(this.time);
  }

  /** A line over the chart at a value of x; none of null. */
  showTime(x) {
    this.time = x;
    if (!this.plot || x === null) return;
    const { top, bottom } = this.plot.inside;
    this.timeLine.setAttribute('d', `M${this.plot.x(x)} ${top}V${bottom}`);
  }

  placeOf({ clientX, clientY }) {
    const box = this.svg.getBoundingClientRect();
    return [clientX - box.left, clientY - box.top];
  }

  point(event) {
    const [px, py] = this.placeOf(event);
    const far = ({ x, y }) => Math.hypot(this.plot.x(x) - px, y === undefined ? 0 : this.plot.y(y) - py);
    const { marks } = this.content;
    this.read(marks.reduce((best, mark, k) => (best >= 0 && far(marks[best]) <= far(mark) ? best : k), -1));
    if (event.buttons === 1) this.press(event);
  }

  press(event) {
    if (!this.seek) return;
    const { left, right } = this.plot.inside;
    const { low, high } = this.content.x;
    const part = Math.min(1, Math.max(0, (this.placeOf(event)[0] - left) / (right - left)));
    this.seek(low + part * (high - low));
  }

  key(event) {
    const last = this.content.marks.length - 1;
    const to = { ArrowRight: this.at + 1, ArrowUp: this.at + 1, ArrowLeft: this.at - 1, ArrowDown: this.at - 1, Home: 0, End: last }[event.key];
    if (to === undefined || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    event.stopPropagation();
    this.read(Math.min(last, Math.max(0, to)));
  }

  /** Shows and says the value of a place among the marks; nothing of -1. */
  read(at) {
    if (!this.content) return;
    this.at = at;
    const mark = this.content.marks[at];
    this.cursor.setAttribute('visibility', mark ? 'visible' : 'hidden');
    this.reading.textContent = mark?.text ?? '';
    if (!mark) return;
    const [line, ring] = this.cursor.children;
    const { top, bottom } = this.plot.inside, px = this.plot.x(mark.x);
    line.setAttribute('d', mark.y === undefined ? `M${px} ${top}V${bottom}` : '');
    ring.setAttribute('cx', px);
    ring.setAttribute('cy', mark.y === undefined ? 0 : this.plot.y(mark.y));
    ring.setAttribute('visibility', mark.y === undefined ? 'hidden' : 'inherit');
    this.svg.setAttribute('aria-valuenow', at);
    this.svg.setAttribute('aria-valuetext', mark.text);
  }
}

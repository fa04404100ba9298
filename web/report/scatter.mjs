// Two figures of the layouts against each other, each layout a point to press.
import { saveButtons } from './chart_files.mjs';
import { element, listChoice, section, shape } from './dom.mjs';
import { textWithUnit, titleOf } from './layout_figures.mjs';
import { layoutName } from './layout_words.mjs';
import { plotFrame, roundAxis } from './plot.mjs';
import { onTheme } from './theme.mjs';
import { pointsOf, tradeSentence, unbeaten } from './trade.mjs';

const height = 380;  // px
const reach = 24;    // px, from a press to the point that is meant
const steps = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 };

function axisOf(figure, values) {
  if (values.length === 0) return roundAxis(titleOf(figure), 0, 1);
  const highest = Math.max(...values, 0), least = Math.min(...values);
  return roundAxis(titleOf(figure), least > 0.5 * highest ? least : 0, highest || 1);
}

// The tip of an arrow at (x, y), whose strokes go back along (dx, dy).
function tip(x, y, dx, dy) {
  return [1, -1].map((side) => `M${x} ${y}l${6 * dx + 4 * side * dy} ${6 * dy + 4 * side * dx}`).join('');
}

class Scatter {
  constructor(data, figures, [figureX, figureY], chosen, filter, look) {
    Object.assign(this, { data, chosen, figureX, figureY, look, wanted: filter.wanted });
    const options = figures.map((one) => ({ value: one, text: titleOf(one) }));
    this.place = element('div', { class: 'scatter' });
    this.reading = element('p', { class: 'chart-reading', 'aria-hidden': 'true' });
    this.sentence = element('p', { id: 'trade-sentence', class: 'lead', 'aria-live': 'polite' });
    this.frame = element('div', {}, element('div', { class: 'choices' },
      listChoice('Across', options, figureX, (one) => { this.figureX = one; this.draw(); }), listChoice('Up', options, figureY, (one) => { this.figureY = one; this.draw(); })),
    this.sentence, element('figure', { class: 'card' }, this.place, element('div', { class: 'chart-foot' }, this.reading, saveButtons('layouts', () => this.place.querySelector('svg'), () => this.table())),
      element('figcaption', {}, element('p', { class: 'legend' },
        element('span', { class: 'legend-item' }, element('span', { class: 'stroke front-stroke' }), 'layouts that no other beats in both, by their means'), look.legend(), element('span', {}, 'An arrow: it goes on.')))));
    const follow = () => { if (this.place.clientWidth !== this.width) this.draw(); };
    new ResizeObserver(follow).observe(this.place);
    onTheme(follow);
    chosen.onChange(() => this.mark());
    filter.onChange((shown) => { this.data = shown; this.draw(); });
  }

  draw() {
    const { data, figureX, figureY } = this;
    this.width = this.place.clientWidth;
    const points = pointsOf(data.layouts, figureX, figureY);
    const front = unbeaten(points, figureX, figureY);
    this.sentence.textContent = tradeSentence(data, points, front, figureX, figureY);
    const { x: place, y: up, inside, grid } = plotFrame(this.width, height, axisOf(figureX, points.map(({ x }) => x.value)), axisOf(figureY, points.map(({ y }) => y.value)));
    Object.assign(this, { x: place, y: up, inside });
    this.points = points.sort((a, b) => a.x.value - b.x.value || a.y.value - b.y.value);
    this.circles = this.points.map((point) => this.circle(point));
    this.cross = shape('path', { class: 'cross' });
    this.ring = shape('circle', { class: 'ring', r: 8, 'aria-hidden': 'true' });
    const line = front.length > 1 ? shape('polyline', { class: 'front', points: front.map(({ x, y }) => `${this.x(x.value)},${this.y(y.value)}`).join(' ') }) : null;
    const crosses = this.points.filter(({ layout }) => this.look.withIntervals(layout)).map((point) => shape('path', { class: 'cross', d: this.crossOf(point) }));
    this.place.replaceChildren(shape('svg', { width: this.width, height, role: 'group', 'aria-label': `${titleOf(figureY)} against ${titleOf(figureX)}: a point for every layout; arrow keys go from one to the next`,
      onclick: (event) => this.press(event), onpointermove: (event) => this.read(this.nearest(event)), onpointerleave: () => this.read(null), onkeydown: (event) => this.key(event) },
    grid, this.wantedLines(), line, crosses, this.cross, this.circles, this.ring));
    this.mark();
  }

  // A line at each end of what is wanted, of ends that the diagram holds.
  wantedLines() {
    const { left, right, top, bottom } = this.inside;
    const ends = (figure) => Object.values(this.wanted.of(figure) ?? {}).filter(Number.isFinite);
    const across = ends(this.figureX).map((value) => this.x(value)).filter((x) => x >= left && x <= right).map((x) => `M${x} ${top}V${bottom}`);
    const along = ends(this.figureY).map((value) => this.y(value)).filter((y) => y >= top && y <= bottom).map((y) => `M${left} ${y}H${right}`);
    return shape('path', { class: 'wanted-line', d: [...across, ...along].join('') });
  }

  table() {
    const ends = ({ value, low, high }) => [value, low, high];
    const names = [this.figureX, this.figureY].flatMap((figure) => [figure.name, `${figure.name}_low`, `${figure.name}_high`]);
    return { columns: ['layout', 'name', 'standing', ...names], rows: this.points.map(({ layout, x, y }) => [layout.number, layoutName(this.data, layout), layout.standing ?? layout.status, ...ends(x), ...ends(y)]) };
  }

  circle(point) {
    const { layout, x, y } = point;
    const name = this.said(point);
    return shape('circle', { cx: this.x(x.value), cy: this.y(y.value), r: 5, role: 'button', tabindex: -1, 'data-layout': layout.number,
      class: this.look.classOf(layout), 'aria-label': name, onfocus: () => this.read(point), onblur: () => this.read(null) });
  }

  nearest(event) {
    const box = this.place.getBoundingClientRect();
    const far = ({ x, y }) => Math.hypot(this.x(x.value) - (event.clientX - box.left), this.y(y.value) - (event.clientY - box.top));
    const nearest = this.points.reduce((best, point) => (best && far(best) <= far(point) ? best : point), null);
    return nearest && far(nearest) <= reach ? nearest : null;
  }

  press(event) {
    const point = this.nearest(event);
    if (point) this.chosen.choose(point.layout.number);
  }

  read(point) {
    this.reading.textContent = point ? this.said(point) : '';
  }

  // Its values, and why it is there.
  said(point) {
    return [this.words(point), this.look.why?.(point.layout)].filter(Boolean).join('. ');
  }

  words({ layout, x, y }) {
    return `Layout ${layout.number}, ${layoutName(this.data, layout)}: ${this.figureX.words} ${textWithUnit(x, this.figureX)}, ${this.figureY.words} ${textWithUnit(y, this.figureY)}`;
  }

  key(event) {
    const at = this.circles.indexOf(event.target);
    const by = steps[event.key];
    if (at < 0 || (!by && !['Enter', ' '].includes(event.key))) return;
    event.preventDefault();
    if (by) this.focusOn(Math.min(this.circles.length - 1, Math.max(0, at + by)));
    else this.chosen.choose(this.points[at].layout.number);
  }

  focusOn(at) {
    this.circles.forEach((circle, k) => circle.setAttribute('tabindex', k === at ? 0 : -1));
    this.circles[at].focus();
  }

  // The tab key comes to the chosen point, else to the first.
  mark() {
    if (!this.circles) return;
    const at = this.points.findIndex(({ layout }) => layout.number === this.chosen.number);
    this.circles.forEach((circle, k) => {
      circle.setAttribute('aria-pressed', String(k === at));
      circle.setAttribute('tabindex', k === Math.max(0, at) ? 0 : -1);
    });
    this.cross.setAttribute('d', at < 0 ? '' : this.crossOf(this.points[at]));
    this.ring.setAttribute('visibility', at < 0 ? 'hidden' : 'visible');
    if (at < 0) return;
    for (const place of ['cx', 'cy']) this.ring.setAttribute(place, this.circles[at].getAttribute(place));
  }

  crossOf({ x, y }) {
    const { left, right, top, bottom } = this.inside;
    const [cx, cy] = [this.x(x.value), this.y(y.value)];
    const within = (value, low, high) => Math.min(high, Math.max(low, value));
    const across = (from, to) => `M${within(from, left, right)} ${cy}H${within(to, left, right)}${from < left ? tip(left, cy, 1, 0) : ''}${to > right ? tip(right, cy, -1, 0) : ''}`;
    const along = (from, to) => `M${cx} ${within(from, top, bottom)}V${within(to, top, bottom)}${from > bottom ? tip(cx, bottom, 0, -1) : ''}${to < top ? tip(cx, top, 0, 1) : ''}`;
    return (x.low === null || x.high === null ? '' : across(this.x(x.low), this.x(x.high))) + (y.low === null || y.high === null ? '' : along(this.y(y.low), this.y(y.high)));
  }
}

const plainLook = {
  classOf: ({ compared }) => (compared ? 'ok' : 'not-ok'), withIntervals: () => false,
  legend: () => element('span', {}, 'Cross: 95 % intervals of the chosen layout. Hollow: not compared.'),
};

/**
 * The two figures to begin with are the first two of `axes`. `look`: { classOf(layout), withIntervals(layout), legend(): what
 * stands beside the line's own words, why(layout) (optional): what is read of a point besides its values }.
 */
export function scatterOf(title, data, figures, axes, chosen, filter, look) {
  return section('trade', title, new Scatter(data, figures, axes, chosen, filter, look).frame);
}

/** null where there are not two figures to compare. */
export function scatterSection(data, figures, chosen, filter) {
  if (figures.length < 2) return null;
  const named = (name) => figures.find((figure) => figure.name === name);
  const has = (figure) => figure && pointsOf(data.layouts, figure, figure).length > 1;
  const across = [named('rate_g_per_s'), figures[0]].find(Boolean);
  const up = ['unevenness_cv_percent', 'raw_cv_percent', 'instability_cv_percent'].map(named).find(has) ?? figures.find((figure) => figure !== across);
  return scatterOf('One figure against another', data, figures, [across, up], chosen, filter, plainLook);
}

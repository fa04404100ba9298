// A value with its interval on a line of its own, as wide as its place.
import { element } from './dom.mjs';
import { axisScale, number } from './format.mjs';

const widest = 2;  // times the largest value: where the scale ends though an interval goes on

/** Of values none of which can be negative: from 0. `cut`: intervals go on beyond its end. */
export function scaleOf(values) {
  const highest = Math.max(...values.map(({ value, below, high }) => (below ? high : value)), 0);
  const reach = Math.max(...values.map(({ value, high }) => high ?? value), 0);
  const scale = axisScale(0, Math.min(reach, widest * highest) || 1);
  return { ...scale, cut: reach > scale.high };
}

function percent(scale, value) {
  return (100 * (Math.min(scale.high, Math.max(scale.low, value)) - scale.low)) / (scale.high - scale.low);
}

/** The scale's numbers, to be put over the tracks. */
export function trackAxis(scale) {
  return element('span', { class: 'track-axis', 'aria-hidden': 'true' },
    scale.ticks.map((tick) => element('span', { style: `left:${percent(scale, tick)}%` }, number(tick))));
}

/**
 * `wanted`: { low, high }, a line at each end, or null. `band`: { low, high }, shaded over the track's height, or null. `bar`: the value as a bar from the left, else as a point. `edge`:
 * "lower" or "upper", the end of the scale that is marked.
 */
export function intervalTrack(scale, { value, low, high, below }, { band = null, bar = false, edge = '', wanted = null } = {}) {
  const at = (x) => `left:${percent(scale, x)}%`;
  const span = (from, to) => `${at(from)};width:${percent(scale, to) - percent(scale, from)}%`;
  const hasInterval = low !== null && high !== null;
  return element('span', { class: 'track', 'aria-hidden': 'true', style: `--step:${(100 * scale.step) / (scale.high - scale.low)}%` },
    band && band.low !== null && band.high !== null ? element('span', { class: 'band', style: span(band.low, band.high) }) : null,
    bar ? element('span', { class: 'bar', style: span(0, value) }) : null,
    edge ? element('span', { class: `edge ${edge}` }) : null,
    wanted ? [wanted.low, wanted.high].filter(Number.isFinite).map((end) => element('span', { class: 'wanted-line', style: at(end) })) : null,
    hasInterval ? element('span', { class: 'whisker', style: span(low, high) }) : null,
    bar || below ? null : element('span', { class: 'point', style: at(value) }));
}

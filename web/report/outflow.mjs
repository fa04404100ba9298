// Outflow of every hole: the table, how the seeds added up over time, and how fast they came.
import { Chart, dashOf } from './chart.mjs';
import { listColour } from './colours.mjs';
import { Counters } from './counters.mjs';
import { element, section, shape, table } from './dom.mjs';
import { number } from './format.mjs';
import { outflowSentence } from './outflow_sentence.mjs';
import { axis, roundAxis } from './plot.mjs';
import { onTheme, theme } from './theme.mjs';

const points = 200;      // of a curve
const seedsOfASpan = 12;  // at least, in the mean of the holes, so that the rate is not noise alone
const spans = [10, 40];  // how many the run is cut into, at least and at most

function holeTable({ hole_table: { columns, rows } }) {
  const used = columns.map((_, k) => k).filter((k) => k === 0 || rows.some((row) => row[k]));
  return table('Table of the outflow per hole', used.map((k) => columns[k]), rows.map((row) => used.map((k) => row[k])));
}

const styleOf = (k, shade) => `stroke:${listColour(k, shade)};stroke-dasharray:${dashOf(k)}`;

// The seeds of each hole until each time.
function cumulative(data, counters) {
  const times = Array.from({ length: points + 1 }, (_, k) => (k * data.end_time_s) / points);
  return { times, values: data.holes.map(({ hole }) => times.map((time) => counters.until(hole, time))) };
}

/** The seeds a second of each hole in equal spans of the run: { times (of their middles, s), span_s, values }. */
export function ratesOver(data, counters) {
  const all = data.holes.reduce((sum, { hole }) => sum + counters.until(hole, Infinity), 0);
  const count = Math.min(spans[1], Math.max(spans[0], Math.floor(all / Math.max(1, data.holes.length) / seedsOfASpan)));
  const span = data.end_time_s / count;
  const ends = Array.from({ length: count + 1 }, (_, k) => k * span);
  const values = data.holes.map(({ hole }) => ends.slice(1).map((end, k) => (counters.until(hole, end) - (k === 0 ? 0 : counters.until(hole, ends[k]))) / span));
  return { times: ends.slice(1).map((end) => end - span / 2), span_s: span, values };
}

// A line for each hole.
function lineChart(data, { name, file, title, unit, columns, series: { times, values } }, seek) {
  const top = Math.max(1, ...values.flat());
  return new Chart(name, file, (shade) => ({
    x: axis('time, s', 0, data.end_time_s || 1), y: roundAxis(title, 0, top),
    layers: [{ kind: 'shade', from: data.window_s[0], to: data.window_s[1] }, ...values.map((of, k) => ({ kind: 'line', style: styleOf(k, shade), points: of.map((value, i) => [times[i], value]) }))],
    marks: times.map((time, i) => ({ x: time, text: `${number(time)} s: ${data.holes.map(({ hole }, k) => `hole ${hole} ${number(values[k][i])}`).join(', ')} ${unit}` })),
    table: { columns, rows: times.map((time, i) => [time, ...values.map((of) => of[i])]) },
  }), { height: 300, seek });
}

function charts(data, player) {
  const counters = new Counters(data.events, data.holes);
  const seek = player && ((time) => {
    player.pause();
    player.showTime(time);
  });
  const rates = ratesOver(data, counters);
  const holes = data.holes.map(({ hole }) => `hole ${hole}`);
  const both = [
    lineChart(data, { name: `Seeds that each hole has let out, from 0 to ${number(data.end_time_s)} s`, file: 'outflow', title: 'seeds so far', unit: 'seeds', columns: ['time_s', ...holes],
      series: cumulative(data, counters) }, seek),
    lineChart(data, { name: `Seeds a second of each hole, in spans of ${number(rates.span_s)} s`, file: 'rates', title: `seeds/s, in ${number(rates.span_s)} s`, unit: 'seeds/s', columns: ['middle_of_span_s', ...holes], series: rates }, seek),
  ];
  player?.onChange(() => both.forEach((chart) => chart.showTime(player.moment)));
  if (player) both.forEach((chart) => chart.showTime(player.moment));
  return element('div', { class: 'charts-beside' }, both.map(({ frame }) => frame));
}

function legend(data) {
  const frame = element('p', { class: 'legend' });
  const stroke = (k) => shape('svg', { class: 'stroke', viewBox: '0 0 30 6', 'aria-hidden': 'true' }, shape('path', { class: 'line', d: 'M0 3H30', style: styleOf(k, theme()) }));
  const fill = () => frame.replaceChildren(
    ...data.holes.map((hole, k) => element('span', { class: 'legend-item' }, stroke(k), `hole ${hole.hole}`)),
    element('span', { class: 'legend-item' }, element('span', { class: 'swatch window' }), 'measured'));
  onTheme(fill);
  fill();
  return frame;
}

export function outflowSection(data, player) {
  const figure = element('figure', { class: 'card' }, charts(data, player), legend(data), element('figcaption', {}, outflowSentence(data)));
  return section('outflow', 'Outflow per hole', holeTable(data), figure);
}

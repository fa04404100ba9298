// Outflow of every hole: the table, and how the seeds added up over time.
import { Chart } from './chart.mjs';
import { listColour, listColours } from './colours.mjs';
import { Counters } from './counters.mjs';
import { element, section, table } from './dom.mjs';
import { number } from './format.mjs';
import { outflowSentence } from './outflow_sentence.mjs';
import { onTheme, theme, themeColour } from './theme.mjs';

const points = 400;
const dashes = [[], [6, 4], [2, 3], [10, 4, 2, 4]];

function holeTable({ hole_table: { columns, rows } }) {
  const used = columns.map((_, k) => k).filter((k) => k === 0 || rows.some((row) => row[k]));
  return table('Table of the outflow per hole', used.map((k) => columns[k]), rows.map((row) => used.map((k) => row[k])));
}

function cumulative(data) {
  const counters = new Counters(data.events, data.holes);
  const times = Array.from({ length: points + 1 }, (_, k) => (k * data.end_time_s) / points);
  return [times, ...data.holes.map((hole) => times.map((time) => counters.until(hole.hole, time)))];
}

function shadeWindow(plot, [from, to]) {
  const { ctx, bbox } = plot;
  const [left, right] = [plot.valToPos(from, 'x', true), plot.valToPos(to, 'x', true)];
  ctx.save();
  ctx.fillStyle = themeColour('window');
  ctx.fillRect(left, bbox.top, right - left, bbox.height);
  ctx.restore();
}

function dash(hole) {
  return dashes[Math.floor(hole / listColours) % dashes.length];
}

function cumulativeChart(data, player) {
  const name = `Seeds that each hole has let out, from 0 to ${number(data.end_time_s)} s`;
  const chart = new Chart(name, (axis, shade) => ({
    scales: { x: { time: false, range: [0, data.end_time_s || 1] } },
    cursor: { drag: { x: false, y: false }, y: false, points: { show: false } },
    axes: [axis('time, s'), axis('seeds so far', { size: 58 })],
    series: [{}, ...data.holes.map((_, k) => ({ stroke: listColour(k, shade), width: 2, dash: dash(k), points: { show: false } }))],
    hooks: { drawClear: [(plot) => shadeWindow(plot, data.window_s)] },
  }), cumulative(data), 320);
  if (player) bindTime(chart, player);
  return chart.frame;
}

// The replay's time as a line; a press on the chart, or a stroke over it, moves the replay.
function bindTime(chart, player) {
  const line = element('div', { class: 'time-line' });
  const put = () => {
    if (chart.plot) line.style.transform = `translateX(${chart.plot.valToPos(player.moment, 'x')}px)`;
  };
  chart.afterDraw = (plot) => {
    plot.over.append(line);
    put();
    if (plot.timeBound) return;
    plot.timeBound = true;
    const seek = (event) => {
      player.pause();
      player.showTime(plot.posToVal(event.clientX - plot.over.getBoundingClientRect().left, 'x'));
    };
    plot.over.addEventListener('pointerdown', seek);
    plot.over.addEventListener('pointermove', (event) => { if (event.buttons === 1) seek(event); });
  };
  player.onChange(put);
}

function legend(data) {
  const frame = element('p', { class: 'legend' });
  const fill = () => frame.replaceChildren(
    ...data.holes.map((hole, k) => element('span', { class: 'legend-item' },
      element('span', { class: 'stroke', style: `border-top:3px ${dash(k).length ? 'dashed' : 'solid'} ${listColour(k, theme())}` }), `hole ${hole.hole}`)),
    element('span', { class: 'legend-item' }, element('span', { class: 'swatch window' }), 'measured'));
  onTheme(fill);
  fill();
  return frame;
}

export function outflowSection(data, player) {
  const figure = element('figure', { class: 'card' }, cumulativeChart(data, player), legend(data), element('figcaption', {}, outflowSentence(data)));
  return section('outflow', 'Outflow per hole', holeTable(data), figure);
}

// How alike the holes are, and the rows of a drill: bars with their intervals.
import { Chart } from './chart.mjs';
import { element, section } from './dom.mjs';
import { number, sentence } from './format.mjs';
import { axis, roundAxis } from './plot.mjs';

function meanOf(bars) {
  const values = bars.map((bar) => bar.value).filter(Number.isFinite);
  return values.reduce((sum, value) => sum + value, 0) / values.length;
}

function words(bar, one, unit) {
  const range = typeof one.low === 'number' && typeof one.high === 'number' ? ` (${number(one.low)} to ${number(one.high)})` : '';
  return `${bar} ${one.label}: ${number(one.value)}${range} ${unit}`;
}

function barChart(id, title, bars, unit, bar, mean) {
  const top = Math.max(...bars.map(({ value, high }) => Math.max(value ?? 0, high ?? 0)), 0);
  return new Chart(`${title}: ${bars.map((one) => `${bar} ${one.label} ${number(one.value)}`).join(', ')} ${unit}`, id, () => ({
    x: axis(bar, -0.6, bars.length - 0.4, { bare: true, ticks: bars.map(({ label }, k) => ({ at: k, text: label })) }), y: roundAxis(unit, 0, top),
    layers: [{ kind: 'bars', half: 0.31, bars: bars.map((one, k) => ({ x: k, ...one })) }, ...(Number.isFinite(mean) ? [{ kind: 'rule', from: [-0.6, mean], to: [bars.length - 0.4, mean] }] : [])],
    marks: bars.map((one, k) => ({ x: k, y: one.value ?? 0, text: words(bar, one, unit) })),
    table: { columns: [bar, unit, 'low', 'high'], rows: bars.map(({ label, value, low, high }) => [label, value, low, high]) },
  }), { height: 260 });
}

function barSection(id, title, bars, unit, bar, said) {
  const mean = meanOf(bars);
  const whiskers = bars.some((one) => typeof one.low === 'number') ? 'Whiskers: 95 % intervals, by blocks of the run. ' : '';
  return section(id, title, element('figure', { class: 'card' }, barChart(id, title, bars, unit, bar, mean).frame,
    element('figcaption', {}, said ? `${sentence(said)} ` : '', element('span', { class: 'muted' }, `${whiskers}Dashed: the mean, ${number(mean)} ${unit}.`))));
}

/** null where the data say nothing of unevenness. */
export function unevennessSection(data) {
  if (!data.unevenness || data.holes.length === 0) return null;
  const bars = data.holes.map((hole) => ({ label: String(hole.hole), value: hole.rate, low: hole.rate_low, high: hole.rate_high }));
  return barSection('unevenness', 'Unevenness', bars, data.rate_unit, 'hole', data.unevenness.sentence);
}

/** null of a run without a drill. */
export function rowsSection(data) {
  if (!data.drill?.rows?.length) return null;
  const bars = data.drill.rows.map((row) => ({ label: String(row.row), value: row.kg_per_ha, low: row.low, high: row.high }));
  return barSection('rows', 'Rows of the drill', bars, 'kg/ha', 'row', data.drill.sentence);
}

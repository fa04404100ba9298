// How alike the holes are, and the rows of a drill: bars with their intervals.
import { intervalBars } from './chart.mjs';
import { element, section } from './dom.mjs';
import { number, sentence } from './format.mjs';

function meanOf(bars) {
  const values = bars.map((bar) => bar.value).filter(Number.isFinite);
  return values.reduce((sum, value) => sum + value, 0) / values.length;
}

function barSection(id, title, bars, unit, bar, said) {
  const mean = meanOf(bars);
  const whiskers = bars.some((one) => typeof one.low === 'number') ? 'Whiskers: 95 % intervals, by blocks of the run. ' : '';
  const chart = intervalBars(`${title}: ${bars.map((one) => `${bar} ${one.label} ${number(one.value)}`).join(', ')} ${unit}`, bars, unit, bar, mean);
  return section(id, title, element('figure', { class: 'card' }, chart.frame,
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

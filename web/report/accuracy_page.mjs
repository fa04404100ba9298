// The page of an accuracy study: the recommendation, error against cost, every setting, and where the errors come from.
import { Chart, markerOf, markerPicture } from './chart.mjs';
import { listColour } from './colours.mjs';
import { element, section, table } from './dom.mjs';
import { number, plusMinus } from './format.mjs';
import { notes } from './light.mjs';
import { logAxis } from './plot.mjs';
import { decades, pointsOf, precisionSentence } from './precision.mjs';
import { onTheme, theme } from './theme.mjs';

const least = 0.003;  // %, where the axis of errors begins: less is no difference that anybody could measure

function schemesOf(levels) {
  return [...new Set(levels.map(({ scheme }) => scheme))];
}

function wordsOf({ level, size, low, high }) {
  const band = high === null ? '' : ` (${number(low)} to ${number(high)})`;
  return `setting ${level.number}, ${level.name}: error ${number(size)}${band} %, ${number(level.cpu_s)} s of CPU${level.chosen ? ', recommended' : ''}`;
}

// Each setting a numbered point, with the interval of its error; a line at what is wanted.
function precisionChart(data, points) {
  const schemes = schemesOf(data.levels);
  const times = decades(points.map(({ level }) => level.cpu_s));
  const sizes = decades([...points.flatMap(({ size, high }) => [Math.max(size, least), high ?? size]), data.within_percent]);
  const at = ({ level, size, low, high }) => ({ x: level.cpu_s, y: Math.max(size, least), low: high === null ? NaN : Math.max(low, least), high, label: String(level.number), look: level.chosen ? 'chosen' : '', size: level.chosen ? 7 : 4.5 });
  return new Chart(`Error of the rate against the time of a run, both on logarithmic axes: ${precisionSentence(data, points)}`, 'precision', (shade) => ({
    x: logAxis('CPU time of a run on this machine, s', times), y: logAxis('error of the rate, %', sizes),
    layers: [{ kind: 'rule', from: [times[0], data.within_percent], to: [times[1], data.within_percent] },
      ...schemes.map((scheme, k) => ({ kind: 'points', marker: markerOf(k), style: `--colour:${listColour(k, shade)}`, points: points.filter(({ level }) => level.scheme === scheme).map(at) }))],
    marks: points.map((point) => ({ x: point.level.cpu_s, y: Math.max(point.size, least), text: wordsOf(point) })),
    table: { columns: ['setting', 'name', 'cpu_s', 'error_percent', 'low', 'high'], rows: points.map(({ level, size, low, high }) => [level.number, level.name, level.cpu_s, size, low, high]) },
  }), { height: 380 }).frame;
}

function legend(data, points) {
  const frame = element('p', { class: 'legend' });
  const fill = () => frame.replaceChildren(...[
    ...schemesOf(data.levels).map((scheme, k) => element('span', { class: 'legend-item' }, markerPicture(markerOf(k), `fill:${listColour(k, theme())}`), scheme)),
    points.some(({ level }) => level.chosen) ? element('span', { class: 'legend-item' }, element('span', { class: 'dot chosen-dot' }), 'recommended') : null,
    element('span', {}, `Lines: 95 % bands; those that reach the bottom hold 0. Dashed: ${number(data.within_percent)} %. Numbers: as in the table.`),
  ].filter(Boolean));
  onTheme(fill);
  fill();
  return frame;
}

function precisionSection(data) {
  const points = [...pointsOf(data.levels)].sort((a, b) => a.level.cpu_s - b.level.cpu_s);
  const said = element('p', { id: 'precision-sentence', class: 'lead' }, precisionSentence(data, points));
  if (points.length === 0) return section('precision', 'Error against cost', said);
  return section('precision', 'Error against cost', said, element('figure', { class: 'card' }, precisionChart(data, points), element('figcaption', {}, legend(data, points))));
}

function markOf(level) {
  return [level.chosen ? 'recommended' : '', level.finest ? 'finest' : '', level.on_front && !level.chosen ? 'no cheaper one errs less' : '', level.note].filter(Boolean).join('; ');
}

function levelsSection(data) {
  const columns = [
    { name: 'setting' }, { name: 'what it is' }, { name: 'remark' }, { name: 'error', unit: '%' }, { name: 'CPU time', unit: 's' }, { name: 'rate', unit: 'g/s' }, { name: 'runs' },
    { name: 'cost of the finest' }, { name: 'step', unit: 'µs' },
  ];
  const rows = data.levels.map((level) => [
    String(level.number), level.name, markOf(level), level.error ? plusMinus(level.error.percent, level.error.band ?? NaN) : '', level.cpu_s ? number(level.cpu_s) : '',
    level.rate_g_per_s ? plusMinus(level.rate_g_per_s.mean, level.rate_g_per_s.half_width ?? NaN) : '', String(level.runs), level.cost_ratio ? number(level.cost_ratio) : '', number(1e6 * level.dt_s),
  ]);
  return section('levels', 'Settings', element('p', { class: 'muted' }, `Errors are against ${data.against}.`), table('Table of the settings', columns, rows));
}

function errorsSentence(errors) {
  const known = errors.filter(({ band }) => band !== null);
  const largest = known.reduce((most, one) => (most && Math.abs(most.percent) >= Math.abs(one.percent) ? most : one), null);
  if (!largest) return 'The runs were too few to tell the sources of errors apart.';
  const sure = Math.abs(largest.percent) > largest.band ? '' : ', which may be chance';
  return `Most is done by ${largest.source}: ${plusMinus(largest.percent, largest.band)} % from its finest to its coarsest level${sure}.`;
}

function errorsSection(data) {
  if (data.errors.length === 0) return null;
  const rows = data.errors.map(({ source, from, to, percent, band }) => [source, from, to, band === null ? number(percent) : plusMinus(percent, band)]);
  return section('errors', 'Where errors come from', element('p', { class: 'lead' }, errorsSentence(data.errors)),
    table('Table of the sources of errors', [{ name: 'source' }, { name: 'from' }, { name: 'to' }, { name: 'change of the rate', unit: '%' }], rows));
}

/** What main.mjs lays out of an accuracy study. */
export function accuracyPage(data) {
  const refused = data.levels.filter(({ rate_g_per_s }) => !rate_g_per_s).map(({ number: n }) => n);
  return {
    kicker: `Accuracy ${data.space === 'plane' ? 'in 2D' : 'in 3D'}`,
    title: data.title || 'What accuracy costs',
    headlines: data.headlines,
    remarks: [...data.remarks, ...notes(refused.length ? [`${refused.length === 1 ? 'Setting' : 'Settings'} ${refused.join(', ')} gave no rate; the table says why`] : [])],
    tray: { name: 'The tray', vessels: data.vessels, scene: data.scene, space: data.space },
    whole: 'Every setting',
    sections: async () => [precisionSection(data), levelsSection(data), errorsSection(data)].filter(Boolean),
  };
}

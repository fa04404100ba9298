// The page of a calibration: the fitted values, measured against fitted, residuals, and which values cannot be told apart.
import { Chart, markerPicture } from './chart.mjs';
import { element, listChoice, section, table } from './dom.mjs';
import { fitSentence, residualSentence, residualsOf, seriesName } from './fit.mjs';
import { axisScale, number } from './format.mjs';
import { intervalTrack, trackAxis } from './interval_track.mjs';
import { titleOf } from './layout_figures.mjs';
import { wordsOf } from './layout_words.mjs';
import { axis, roundAxis } from './plot.mjs';

function text(value) {
  return number(value, 3);
}

function withUnit(value, unit) {
  return unit ? `${value} ${unit}` : value;
}

// The range that was allowed is the whole of a track; what has none begins at 0.
function parameterRow({ name, unit, prior_low, prior_high, mean, low, high, contraction_percent, not_told_apart_from, edge }) {
  const ends = [prior_low ?? Math.min(0, low), prior_high ?? 1.2 * high];
  const scale = { ...axisScale(...ends), low: ends[0], high: ends[1] };
  const ticks = [ends[0], ends[1]];
  const apart = not_told_apart_from ? `not told apart from ${not_told_apart_from.replaceAll(';', ', ')}` : '';
  const beyond = edge ? `at the ${edge} end of its range: it may lie beyond` : '';
  const notes = [prior_low === null ? 'no range' : '', beyond, apart].filter(Boolean);
  return element('li', {}, element('span', {}, name, element('span', { class: 'rank-note' }, notes.join('; '))),
    element('span', { class: 'parameter-track' }, intervalTrack(scale, { value: mean, low, high, below: false }, { edge }), trackAxis({ ...scale, ticks })),
    element('span', { class: 'number' }, withUnit(text(mean), unit), element('span', { class: 'rank-note' }, `${text(low)} to ${text(high)}${prior_low === null ? '' : `; ${Math.round(contraction_percent)} % narrower`}`)));
}

function parametersSentence(parameters) {
  const known = parameters.filter(({ prior_low: from }) => from !== null).sort((a, b) => b.contraction_percent - a.contraction_percent);
  if (known.length === 0) return 'No value with a range was fitted.';
  const [most] = known, least = known[known.length - 1];
  const lead = `The table says most of ${most.name}, whose spread is ${Math.round(most.contraction_percent)} % below that of its range`;
  return known.length === 1 ? `${lead}.` : `${lead}, and least of ${least.name} (${Math.round(least.contraction_percent)} %).`;
}

function parametersSection({ parameters }) {
  return section('parameters', 'What is known of each value', element('p', { class: 'lead' }, parametersSentence(parameters)),
    element('figure', { class: 'card' }, element('ul', { class: 'hole-bars parameters' }, parameters.map(parameterRow)),
      element('figcaption', {}, element('p', { class: 'legend' }, 'Point: the mean. Line: its 95 % interval, in the range that was allowed. Narrower: the standard deviation against that of the range.'))));
}

function heldOutFrom(values, end) {
  const times = values.filter(({ held_out: one }) => one).map(({ time_s: time }) => time);
  return times.length ? [{ kind: 'shade', from: Math.min(...times), to: end }] : [];
}

function wordsOfValue({ time_s: time, conditions, measured, predicted, low, high, held_out: heldOut }) {
  const where = time === null || time === undefined ? conditions : `${text(time)} s`;
  return `${where ? `${where}: ` : ''}measured ${text(measured)}, predicted ${text(predicted)} (${text(low)} to ${text(high)})${heldOut ? ', held out' : ''}`;
}

const columns = ['time_s', 'conditions', 'measured', 'predicted', 'low', 'high', 'held_out'];
const tableOf = (values) => ({ columns, rows: values.map((value) => columns.map((name) => value[name])) });

function curveChart(name, values, quantity) {
  const [first, last] = [Math.min(...values.map(({ time_s: time }) => time)), Math.max(...values.map(({ time_s: time }) => time))];
  const all = values.flatMap(({ low, high, measured }) => [low, high, measured]);
  return new Chart(name, 'fit', () => ({
    x: axis('time, s', first, last), y: roundAxis(titleOf(wordsOf(quantity)), Math.min(0, ...all), Math.max(...all)),
    layers: [...heldOutFrom(values, last), { kind: 'band', points: values.map(({ time_s: time, low, high }) => [time, low, high]) },
      { kind: 'line', style: 'stroke:var(--accent)', points: values.map(({ time_s: time, predicted }) => [time, predicted]) },
      { kind: 'points', style: '--colour:var(--ink)', points: values.map(({ time_s: time, measured }) => ({ x: time, y: measured, size: 2.5 })) }],
    marks: values.map((value) => ({ x: value.time_s, y: value.measured, text: wordsOfValue(value) })), table: tableOf(values),
  }), { height: 340 });
}

// A point for every measured rate, with the interval of its prediction; on the diagonal the two agree.
function rateChart(name, values, quantity) {
  const title = titleOf(wordsOf(quantity));
  const top = 1.05 * Math.max(...values.flatMap(({ measured, high }) => [measured, high])), least = Math.min(...values.flatMap(({ measured, low }) => [measured, low]));
  const bottom = least > 0.5 * top ? 0.95 * least : 0;
  const sorted = [...values].sort((a, b) => a.measured - b.measured);
  const ofKind = (wanted) => sorted.filter(({ held_out: one }) => Boolean(one) === wanted).map(({ measured, predicted, low, high }) => ({ x: measured, y: predicted, low, high }));
  return new Chart(name, 'fit', () => ({
    x: axis(`measured ${title}`, bottom, top), y: axis(`predicted ${title}`, bottom, top),
    layers: [{ kind: 'rule', from: [bottom, bottom], to: [top, top] }, { kind: 'points', style: '--colour:var(--accent)', plain: true, points: ofKind(false) },
      { kind: 'points', marker: 'diamond', style: '--colour:var(--card)', plain: true, points: ofKind(true).map((point) => ({ ...point, look: 'hollow' })) }],
    marks: sorted.map((value) => ({ x: value.measured, y: value.predicted, text: wordsOfValue(value) })), table: tableOf(sorted),
  }), { height: 380 });
}

function residualChart(name, residuals, ofCurves) {
  const at = (value, k) => (ofCurves ? value.time_s : k + 1);
  const places = residuals.map(at), all = residuals.flatMap(({ low, high, residual }) => [low, high, residual]);
  const [first, last] = ofCurves ? [Math.min(...places), Math.max(...places)] : [0, residuals.length + 1];
  const shades = ofCurves ? heldOutFrom(residuals, last) : residuals.flatMap((value, k) => (value.held_out ? [{ kind: 'shade', from: k + 0.75, to: k + 1.25 }] : []));
  const band = ofCurves ? [{ kind: 'band', points: residuals.map((value, k) => [places[k], value.low, value.high]) }] : [];
  const words = (value, k) => `${ofCurves ? `${text(value.time_s)} s` : `value ${k + 1}`}: ${text(value.residual)} % (95 %: ${text(value.low)} to ${text(value.high)})`;
  return new Chart(name, 'residuals', () => ({
    x: axis(ofCurves ? 'time, s' : 'measured value, in the order of the table', first, last), y: roundAxis('difference, %', Math.min(...all), Math.max(...all)),
    layers: [...shades, ...band, { kind: 'rule', from: [first, 0], to: [last, 0] },
      { kind: 'points', style: '--colour:var(--ink)', points: residuals.map((value, k) => ({ x: places[k], y: value.residual, size: 2.5, ...(ofCurves ? {} : { low: value.low, high: value.high }) })) }],
    marks: residuals.map((value, k) => ({ x: places[k], y: value.residual, text: words(value, k) })),
    table: { columns: [ofCurves ? 'time_s' : 'value', 'residual_percent', 'low', 'high'], rows: residuals.map((value, k) => [places[k], value.residual, value.low, value.high]) },
  }), { height: 220 });
}

const legend = (ofCurves) => element('p', { class: 'legend' },
  ...(ofCurves ? [element('span', { class: 'legend-item' }, element('span', { class: 'stroke', style: 'border-top:3px solid var(--accent)' }), 'fitted'), element('span', { class: 'legend-item' }, element('span', { class: 'dot measured-dot' }), 'measured'),
    element('span', { class: 'legend-item' }, element('span', { class: 'swatch window' }), 'held out: predicted, not fitted')]
    : [element('span', { class: 'legend-item' }, element('span', { class: 'dot on-front' }), 'fitted'), element('span', { class: 'legend-item' }, markerPicture('diamond', 'fill:var(--card);stroke:var(--ink)'), 'held out: predicted, not fitted'), element('span', {}, 'Dashed: where the two agree.')]),
  element('span', {}, '95 % intervals are of such a measurement.'));

// A curve is shown by itself, rates all together.
function fitSection(data) {
  const filled = data.series.filter(({ values }) => values.length > 0);
  const said = element('p', { id: 'fit-sentence', class: 'lead', 'aria-live': 'polite' });
  const place = element('figure', { class: 'card' });
  const show = (chosen) => {
    const values = chosen.flatMap((one) => one.values.map((value) => ({ ...value, conditions: one.conditions }))), residuals = chosen.flatMap((one) => residualsOf(one, data.of_curves));
    said.textContent = fitSentence(values);
    const name = `Measured and fitted ${wordsOf(data.quantity).words}: ${said.textContent}`, more = residualSentence(residuals, data.of_curves);
    const chart = data.of_curves ? curveChart(name, values, data.quantity) : rateChart(name, values, data.quantity);
    place.replaceChildren(chart.frame, residualChart(`Residuals: ${more}`, residuals, data.of_curves).frame, element('figcaption', {}, more, legend(data.of_curves)));
  };
  if (filled.length === 0) return null;
  const several = data.of_curves && filled.length > 1;
  show(data.of_curves ? [filled[0]] : filled);
  const options = filled.map((one) => ({ value: one, text: seriesName(one, filled) }));
  return section('fit', 'Measured against fitted', several ? element('div', { class: 'choices' }, listChoice('Curve', options, filled[0], (one) => show([one]))) : '', said, place);
}

function pairChart({ a, b, points }) {
  const sorted = [...points].sort((one, other) => one[0] - other[0]);
  const ends = (k) => [Math.min(...points.map((point) => point[k])), Math.max(...points.map((point) => point[k]))];
  return new Chart(`${b} against ${a}, points of what is known of them`, 'pair', () => ({
    x: roundAxis(a, ...ends(0)), y: roundAxis(b, ...ends(1)), layers: [{ kind: 'points', style: '--colour:var(--bar)', points: sorted.map(([x, y]) => ({ x, y, size: 2 })) }],
    marks: sorted.map(([x, y]) => ({ x, y, text: `${a} ${text(x)}, ${b} ${text(y)}` })), table: { columns: [a, b], rows: sorted },
  })).frame;
}

function pairsSection({ pairs }) {
  if (pairs.length === 0) return null;
  const joined = pairs.filter(({ told_apart: one }) => !one);
  const lead = joined.length === 0 ? 'No two of them are so correlated that the table could not tell them apart.' : `${joined.length} of ${pairs.length} pairs ${joined.length === 1 ? 'is' : 'are'} not told apart: only together do they say something.`;
  return section('pairs', 'Which values trade for each other', element('p', { class: 'lead' }, lead),
    joined.map((pair) => element('figure', { class: 'card pair' }, pairChart(pair), element('figcaption', {}, `${pair.a} and ${pair.b}: correlation ${pair.correlation.toFixed(2)}.`))),
    table('Table of correlations', [{ name: 'value' }, { name: 'with' }, { name: 'correlation' }], pairs.map(({ a, b, correlation }) => [a, b, correlation.toFixed(2)])));
}

/** What main.mjs lays out of a calibration. */
export function calibrationPage(data) {
  return {
    kicker: `Calibration ${data.space === 'plane' ? 'in 2D' : 'in 3D'}`,
    title: data.title || 'A calibration',
    headlines: [data.headline],
    remarks: data.doubts,
    tray: { name: 'The tray', vessels: data.vessels, scene: data.scene, space: data.space },
    whole: 'The whole calibration',
    sections: async () => [fitSection(data), parametersSection(data), pairsSection(data), section('account', 'What it took', data.account.map((one) => element('p', {}, one)))].filter(Boolean),
  };
}

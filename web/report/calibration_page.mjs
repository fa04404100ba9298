// The page of a calibration: the fitted values, measured against fitted, residuals, and which values cannot be told apart.
import { Chart, dashOf, markerOf, markerPicture } from './chart.mjs';
import { listColour, listColours } from './colours.mjs';
import { element, listChoice, section, table } from './dom.mjs';
import { fitSentence, residualSentence, residualsOf, seriesName } from './fit.mjs';
import { axisScale, number } from './format.mjs';
import { intervalTrack, trackAxis } from './interval_track.mjs';
import { titleOf } from './layout_figures.mjs';
import { wordsOf } from './layout_words.mjs';
import { axis, roundAxis } from './plot.mjs';
import { onTheme, theme } from './theme.mjs';

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
    element('span', { class: 'number' }, withUnit(text(mean), unit), element('span', { class: 'rank-note' }, `${text(low)} to ${text(high)}${prior_low === null ? '' : `; ${number(contraction_percent, 2)} % narrower`}`)));
}

function parametersSentence(parameters) {
  const known = parameters.filter(({ prior_low: from }) => from !== null).sort((a, b) => b.contraction_percent - a.contraction_percent);
  if (known.length === 0) return 'No value with a range was fitted.';
  const [most] = known, least = known[known.length - 1];
  const lead = `The table says most of ${most.name}, whose spread is ${number(most.contraction_percent, 2)} % below that of its range`;
  return known.length === 1 ? `${lead}.` : `${lead}, and least of ${least.name} (${number(least.contraction_percent, 2)} %).`;
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

// Each curve a line with its measured points on it, one curve by itself also with the interval of what is predicted.
function curveChart(name, curves, quantity) {
  const values = curves.flatMap((one) => one.values), times = values.map(({ time_s: time }) => time);
  const [first, last] = [Math.min(...times), Math.max(...times)], alone = curves.length === 1;
  const all = values.flatMap(({ low, high, measured, predicted }) => (alone ? [low, high, measured] : [predicted, measured]));
  const said = curves.flatMap((one) => one.values.map((value) => ({ value, words: `${alone ? '' : `${one.title}, `}${wordsOfValue({ ...value, conditions: '' })}` }))).sort((x, y) => x.value.time_s - y.value.time_s);
  return new Chart(name, 'fit', (shade) => ({
    x: axis('time, s', first, last), y: roundAxis(titleOf(wordsOf(quantity)), Math.min(0, ...all), Math.max(...all)),
    layers: [...heldOutFrom(values, last), ...curves.flatMap((one, k) => [
      alone ? { kind: 'band', points: one.values.map(({ time_s: time, low, high }) => [time, low, high]) } : null,
      { kind: 'line', style: curveStyle(k, alone, shade), points: one.values.map(({ time_s: time, predicted }) => [time, predicted]) },
      { kind: 'points', marker: markerOf(k), style: `--colour:${alone ? 'var(--ink)' : listColour(k, shade)}`, points: one.values.map(({ time_s: time, measured }) => ({ x: time, y: measured, size: 2.5 })) },
    ].filter(Boolean))],
    marks: said.map(({ value, words }) => ({ x: value.time_s, y: value.measured, text: words })), table: tableOf(curves.flatMap((one) => one.values.map((value) => ({ ...value, conditions: one.title })))),
  }), { height: 340 });
}

const curveStyle = (k, alone, shade) => (alone ? 'stroke:var(--accent)' : `stroke:${listColour(k, shade)};stroke-dasharray:${dashOf(k)}`);

const aside = 0.12;  // of a place, from the middle to what is measured and to what is fitted

// A place for every measured value; so many that their numbers would touch have none.
function tableAxis(count) {
  return axis('measured values, in the order of the table', 0.5, count + 0.5, { bare: true, ticks: count > 20 ? [] : Array.from({ length: count }, (_, k) => ({ at: k + 1, text: String(k + 1) })) });
}

// Of every measured rate what was measured and, with its interval, what is fitted, in the order of the table.
function rateChart(name, values, quantity) {
  const all = values.flatMap(({ measured, low, high }) => [measured, low, high]);
  const top = Math.max(...all, 0), least = Math.min(...all);
  const place = (value, k) => ({ x: k + 1, ...value });
  const fitted = values.map(place).filter(({ held_out: one }) => !one), heldOut = values.map(place).filter(({ held_out: one }) => one);
  const predicted = (of, look) => of.map(({ x, predicted: y, low, high }) => ({ x: x + aside, y, low, high, look }));
  return new Chart(name, 'fit', () => ({
    x: tableAxis(values.length),
    y: roundAxis(titleOf(wordsOf(quantity)), least > 0.5 * top ? least : 0, top),
    layers: [...heldOut.map(({ x }) => ({ kind: 'shade', from: x - 0.45, to: x + 0.45 })), { kind: 'points', style: '--colour:var(--accent)', plain: true, points: predicted(fitted) },
      { kind: 'points', marker: 'diamond', style: '--colour:var(--card)', plain: true, points: predicted(heldOut, 'hollow') },
      { kind: 'points', marker: 'square', style: '--colour:var(--ink)', points: values.map((value, k) => ({ x: k + 1 - aside, y: value.measured, size: 4 })) }],
    marks: values.map((value, k) => ({ x: k + 1, y: value.measured, text: wordsOfValue(value) })), table: tableOf(values),
  }), { height: 380 });
}

function residualChart(name, residuals, ofCurves) {
  const at = (value, k) => (ofCurves ? value.time_s : k + 1);
  const places = residuals.map(at), all = residuals.flatMap(({ low, high, residual }) => [low, high, residual]);
  const [first, last] = ofCurves ? [Math.min(...places), Math.max(...places)] : [0.5, residuals.length + 0.5];
  const shades = ofCurves ? heldOutFrom(residuals, last) : residuals.flatMap((value, k) => (value.held_out ? [{ kind: 'shade', from: k + 0.55, to: k + 1.45 }] : []));
  const band = ofCurves ? [{ kind: 'band', points: residuals.map((value, k) => [places[k], value.low, value.high]) }] : [];
  const words = (value, k) => `${ofCurves ? `${text(value.time_s)} s` : `value ${k + 1}`}: ${text(value.residual)} % (95 %: ${text(value.low)} to ${text(value.high)})`;
  return new Chart(name, 'residuals', () => ({
    x: ofCurves ? axis('time, s', first, last) : tableAxis(residuals.length), y: roundAxis('difference, %', Math.min(...all), Math.max(...all)),
    layers: [...shades, ...band, { kind: 'rule', from: [first, 0], to: [last, 0] },
      { kind: 'points', style: '--colour:var(--ink)', points: residuals.map((value, k) => ({ x: places[k], y: value.residual, size: 2.5, ...(ofCurves ? {} : { low: value.low, high: value.high }) })) }],
    marks: residuals.map((value, k) => ({ x: places[k], y: value.residual, text: words(value, k) })),
    table: { columns: [ofCurves ? 'time_s' : 'value', 'residual_percent', 'low', 'high'], rows: residuals.map((value, k) => [places[k], value.residual, value.low, value.high]) },
  }), { height: 220 });
}

const heldOutItem = () => element('span', { class: 'legend-item' }, element('span', { class: 'swatch window' }), 'held out: predicted, not fitted');

function curveItems(curves) {
  if (curves.length === 1) {
    return [element('span', { class: 'legend-item' }, element('span', { class: 'stroke', style: 'border-top:3px solid var(--accent)' }), 'fitted'), element('span', { class: 'legend-item' }, element('span', { class: 'dot measured-dot' }), 'measured')];
  }
  return [...curves.map(({ title }, k) => element('span', { class: 'legend-item' }, markerPicture(markerOf(k), `fill:${listColour(k, theme())}`), title)), element('span', {}, 'Points: measured. Lines: fitted.')];
}

function legend(ofCurves, curves) {
  const frame = element('p', { class: 'legend' });
  const fill = () => frame.replaceChildren(...(ofCurves ? [...curveItems(curves), heldOutItem()]
    : [element('span', { class: 'legend-item' }, markerPicture('square', 'fill:var(--ink)'), 'measured'), element('span', { class: 'legend-item' }, element('span', { class: 'dot on-front' }), 'fitted'), element('span', { class: 'legend-item' }, markerPicture('diamond', 'fill:var(--card);stroke:var(--ink)'), 'held out: predicted, not fitted')]),
  element('span', {}, '95 % intervals are of such a measurement.'));
  onTheme(fill);
  fill();
  return frame;
}

// Curves, so few that they are told apart, and rates are shown all together; a curve also by itself.
function fitSection(data) {
  const filled = data.series.filter(({ values }) => values.length > 0);
  const said = element('p', { id: 'fit-sentence', class: 'lead', 'aria-live': 'polite' });
  const place = element('figure', { class: 'card' });
  const show = (chosen) => {
    const values = chosen.flatMap((one) => one.values.map((value) => ({ ...value, conditions: one.conditions }))), residuals = chosen.flatMap((one) => residualsOf(one, data.of_curves));
    said.textContent = fitSentence(values);
    const name = `Measured and fitted ${wordsOf(data.quantity).words}: ${said.textContent}`, more = residualSentence(residuals, data.of_curves);
    const curves = chosen.map((one) => ({ ...one, title: seriesName(one, filled) }));
    const chart = data.of_curves ? curveChart(name, curves, data.quantity) : rateChart(name, values, data.quantity);
    place.replaceChildren(chart.frame, residualChart(`Residuals: ${more}`, residuals, data.of_curves).frame, element('figcaption', {}, more, legend(data.of_curves, curves)));
  };
  if (filled.length === 0) return null;
  const several = data.of_curves && filled.length > 1;
  const together = !data.of_curves || filled.length <= listColours;
  const options = [...(together ? [{ value: filled, text: 'all' }] : []), ...filled.map((one) => ({ value: [one], text: seriesName(one, filled) }))];
  show(options[0].value);
  return section('fit', 'Measured against fitted', several ? element('div', { class: 'choices' }, listChoice('Curve', options, options[0].value, show)) : '', said, place);
}

// The ends of the ranges of both values, where they lie in the chart: a pair that runs against one may go on beyond.
function rangeEnds(parameters, [a, b], [xs, ys]) {
  const ends = (name, [low, high]) => {
    const of = parameters.find((one) => one.name === name);
    return [of?.prior_low, of?.prior_high].filter((end) => typeof end === 'number' && end >= low && end <= high);
  };
  return [...ends(a, xs).map((x) => ({ kind: 'rule', from: [x, ys[0]], to: [x, ys[1]] })), ...ends(b, ys).map((y) => ({ kind: 'rule', from: [xs[0], y], to: [xs[1], y] }))];
}

function pairChart({ a, b, points }, parameters) {
  const sorted = [...points].sort((one, other) => one[0] - other[0]);
  const [x, y] = [a, b].map((name, k) => roundAxis(name, Math.min(...points.map((point) => point[k])), Math.max(...points.map((point) => point[k]))));
  return new Chart(`${b} against ${a}, points of what is known of them`, 'pair', () => ({
    x, y, layers: [...rangeEnds(parameters, [a, b], [[x.low, x.high], [y.low, y.high]]), { kind: 'points', style: '--colour:var(--bar)', points: sorted.map(([px, py]) => ({ x: px, y: py, size: 2 })) }],
    marks: sorted.map(([px, py]) => ({ x: px, y: py, text: `${a} ${text(px)}, ${b} ${text(py)}` })), table: { columns: [a, b], rows: sorted },
  })).frame;
}

function pairsSection({ pairs, parameters }) {
  if (pairs.length === 0) return null;
  const joined = pairs.filter(({ told_apart: one }) => !one);
  const lead = joined.length === 0 ? 'No two of them are so correlated that the table could not tell them apart.' : `${joined.length} of ${pairs.length} pairs ${joined.length === 1 ? 'is' : 'are'} not told apart: only together do they say something.`;
  return section('pairs', 'Which values trade for each other', element('p', { class: 'lead' }, lead),
    joined.map((pair) => element('figure', { class: 'card pair' }, pairChart(pair, parameters), element('figcaption', {}, `${pair.a} and ${pair.b}: correlation ${number(pair.correlation, 2)}. Dashed: ends of the ranges that were allowed.`))),
    table('Table of correlations', [{ name: 'value' }, { name: 'with' }, { name: 'correlation' }], pairs.map(({ a, b, correlation }) => [a, b, number(correlation, 2)])));
}

/** What main.mjs lays out of a calibration. */
export function calibrationPage(data) {
  return {
    kicker: `Calibration ${data.space === 'plane' ? 'in 2D' : 'in 3D'}`,
    title: data.title || 'A calibration',
    headlines: [data.headline],
    remarks: data.remarks,
    tray: { name: 'The tray', vessels: data.vessels, scene: data.scene, space: data.space },
    whole: 'The whole calibration',
    sections: async () => [fitSection(data), parametersSection(data), pairsSection(data), section('account', 'What it took', data.account.map((one) => element('p', {}, one)))].filter(Boolean),
  };
}

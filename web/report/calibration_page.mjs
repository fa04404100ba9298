// The page of a calibration: the fitted values, measured against fitted, residuals, and which values cannot be told apart.
import { Chart } from './chart.mjs';
import { element, listChoice, section, table } from './dom.mjs';
import { fitSentence, residualSentence, residualsOf, seriesName } from './fit.mjs';
import { axisScale, number, sentence } from './format.mjs';
import { intervalTrack, trackAxis } from './interval_track.mjs';
import { titleOf } from './layout_figures.mjs';
import { wordsOf } from './layout_words.mjs';
import { themeColour } from './theme.mjs';

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

function shadeHeldOut(plot, values) {
  const times = values.filter(({ held_out: one }) => one).map(({ time_s: time }) => time);
  if (times.length === 0) return;
  const { ctx, bbox } = plot;
  const left = plot.valToPos(Math.min(...times), 'x', true);
  ctx.save();
  ctx.fillStyle = themeColour('window');
  ctx.fillRect(left, bbox.top, bbox.left + bbox.width - left, bbox.height);
  ctx.restore();
}

const dots = (colour) => ({ stroke: themeColour(colour), paths: () => null, points: { show: true, size: 5, fill: themeColour(colour), stroke: themeColour(colour) } });
const line = (colour, more = {}) => ({ stroke: themeColour(colour), width: 2, points: { show: false }, ...more });

function curveChart(name, values, quantity) {
  const columns = ['time_s', 'low', 'high', 'predicted', 'measured'].map((part) => values.map((value) => value[part]));
  return new Chart(name, (axis) => ({
    scales: { x: { time: false } }, cursor: { show: false }, axes: [axis('time, s'), axis(titleOf(wordsOf(quantity)), { size: 62 })],
    series: [{}, line('line', { width: 1 }), line('line', { width: 1 }), line('accent'), dots('ink')],
    bands: [{ series: [2, 1], fill: themeColour('line') }], hooks: { drawClear: [(plot) => shadeHeldOut(plot, values)] },
  }), columns, 340);
}

// A point for every measured rate, with the interval of its prediction; on the diagonal the two agree.
function rateChart(name, values, quantity) {
  const title = titleOf(wordsOf(quantity));
  const top = 1.05 * Math.max(...values.flatMap(({ measured, high }) => [measured, high])), least = Math.min(...values.flatMap(({ measured, low }) => [measured, low]));
  const bottom = least > 0.5 * top ? 0.95 * least : 0;
  const sorted = [...values].sort((a, b) => a.measured - b.measured);
  const draw = (plot) => {
    const { ctx } = plot, px = devicePixelRatio;
    const at = (x, y) => [plot.valToPos(x, 'x', true), plot.valToPos(y, 'y', true)];
    ctx.save();
    ctx.lineWidth = px;
    ctx.strokeStyle = themeColour('edge');
    ctx.setLineDash([5 * px, 4 * px]);
    ctx.beginPath();
    ctx.moveTo(...at(bottom, bottom));
    ctx.lineTo(...at(top, top));
    ctx.stroke();
    ctx.setLineDash([]);
    for (const { measured, predicted, low, high, held_out: heldOut } of sorted) {
      ctx.strokeStyle = themeColour('ink');
      ctx.beginPath();
      ctx.moveTo(...at(measured, low));
      ctx.lineTo(...at(measured, high));
      ctx.stroke();
      ctx.beginPath();
      ctx.arc(...at(measured, predicted), 4.5 * px, 0, 2 * Math.PI);
      ctx.fillStyle = themeColour(heldOut ? 'card' : 'accent');
      ctx.fill();
      ctx.stroke();
    }
    ctx.restore();
  };
  return new Chart(name, (axis) => ({
    scales: { x: { time: false, range: [bottom, top] }, y: { range: [bottom, top] } }, cursor: { show: false }, axes: [axis(`measured ${title}`), axis(`predicted ${title}`, { size: 62 })],
    series: [{}, { paths: () => null, points: { show: false } }], hooks: { draw: [draw] },
  }), [sorted.map(({ measured }) => measured), sorted.map(({ predicted }) => predicted)], 380);
}

function residualChart(name, residuals, ofCurves) {
  const at = (value, k) => (ofCurves ? value.time_s : k + 1);
  const columns = [residuals.map(at), ...['low', 'high', 'residual'].map((part) => residuals.map((value) => value[part]))];
  const shade = (plot) => {
    if (ofCurves) return shadeHeldOut(plot, residuals);
    const { ctx, bbox } = plot, half = bbox.width / (residuals.length + 1) / 2;
    ctx.save();
    ctx.fillStyle = themeColour('window');
    residuals.forEach((value, k) => { if (value.held_out) ctx.fillRect(plot.valToPos(k + 1, 'x', true) - half, bbox.top, 2 * half, bbox.height); });
    ctx.restore();
  };
  return new Chart(name, (axis) => ({
    scales: { x: { time: false, ...(ofCurves ? {} : { range: [0, residuals.length + 1] }) } }, cursor: { show: false },
    axes: [ofCurves ? axis('time, s') : axis('measured value, in the order of the table', { incrs: [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000] }), axis('difference, %', { size: 62 })],
    series: [{}, line('line', { width: 1 }), line('line', { width: 1 }), dots('ink')],
    bands: [{ series: [2, 1], fill: themeColour('line') }], hooks: { drawClear: [shade] },
  }), columns, 220);
}

const legend = (ofCurves) => element('p', { class: 'legend' },
  ...(ofCurves ? [element('span', { class: 'legend-item' }, element('span', { class: 'stroke', style: 'border-top:3px solid var(--accent)' }), 'fitted'), element('span', { class: 'legend-item' }, element('span', { class: 'dot measured-dot' }), 'measured'),
    element('span', { class: 'legend-item' }, element('span', { class: 'swatch window' }), 'held out: predicted, not fitted')]
    : [element('span', { class: 'legend-item' }, element('span', { class: 'dot on-front' }), 'fitted'), element('span', { class: 'legend-item' }, element('span', { class: 'dot' }), 'held out: predicted, not fitted'), element('span', {}, 'Dashed: where the two agree.')]),
  element('span', {}, '95 % intervals are of such a measurement.'));

// A curve is shown by itself, rates all together.
function fitSection(data) {
  const filled = data.series.filter(({ values }) => values.length > 0);
  const said = element('p', { id: 'fit-sentence', class: 'lead', 'aria-live': 'polite' });
  const place = element('figure', { class: 'card' });
  const show = (chosen) => {
    const values = chosen.flatMap((one) => one.values), residuals = chosen.flatMap((one) => residualsOf(one, data.of_curves));
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
  return new Chart(`${b} against ${a}, points of what is known of them`, (axis) => ({
    scales: { x: { time: false } }, cursor: { show: false }, axes: [axis(a), axis(b, { size: 62 })],
    series: [{}, { ...dots('bar'), points: { show: true, size: 4, fill: themeColour('bar'), stroke: themeColour('bar') } }],
  }), [sorted.map(([x]) => x), sorted.map(([, y]) => y)], 300).frame;
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
    remarks: data.doubts.map(sentence),
    whole: 'The whole calibration',
    sections: async () => [fitSection(data), parametersSection(data), pairsSection(data), section('account', 'What it took', data.account.map((one) => element('p', {}, one)))].filter(Boolean),
  };
}

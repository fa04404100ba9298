// Measured against fitted: residuals and what they say.
import { list, number } from './format.mjs';

/** "tray.motion.frequency = 9 Hz, hole 2": what tells a series from the others. */
export function seriesName(series, all) {
  const tells = (part) => new Set(all.map((one) => one[part])).size > 1;
  const parts = [series.conditions, tells('hole') ? `hole ${series.hole}` : '', tells('lot') ? series.lot : ''].filter(Boolean);
  return parts.join(', ') || 'all holes';
}

/** Of a curve in percent of its largest value, of a rate in percent of what is predicted; { residual, band } of each value. */
export function residualsOf(series, ofCurves) {
  const largest = Math.max(...series.values.map(({ measured }) => measured));
  return series.values.map((value) => {
    const whole = (ofCurves ? largest : value.predicted) || 1;
    return { ...value, residual: (100 * (value.measured - value.predicted)) / whole, low: (100 * (value.low - value.predicted)) / whole, high: (100 * (value.high - value.predicted)) / whole };
  });
}

function inside(values) {
  return values.filter(({ measured, low, high }) => measured >= low && measured <= high).length;
}

/** How many measured values lie within their 95 % intervals, those that were fitted and those that were held out. */
export function fitSentence(values) {
  const parts = [['fitted', false], ['held out', true]].map(([words, heldOut]) => [words, values.filter(({ held_out: one }) => one === heldOut)]).filter(([, of]) => of.length > 0);
  return `Within their 95 % intervals lie ${list(parts.map(([words, of]) => `${inside(of)} of ${of.length} ${words} values`))}.`;
}

/** The largest residual, and where it is. */
export function residualSentence(residuals, ofCurves) {
  if (residuals.length === 0) return '';
  const most = residuals.reduce((a, b) => (Math.abs(b.residual) > Math.abs(a.residual) ? b : a));
  const where = ofCurves ? ` at ${number(most.time_s)} s` : '';
  return `Measured and predicted differ by ${number(Math.abs(most.residual))} % ${ofCurves ? 'of the largest value ' : ''}at most${where}${most.held_out ? ', where nothing was fitted' : ''}.`;
}

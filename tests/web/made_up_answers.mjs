// An accuracy study and a calibration, made up.
import { madeUpRun } from './made_up_run.mjs';

const program = { name: 'vibrosow', version: '0.2.0' };

const { vessels, scene } = madeUpRun('plane').data;

function level(number, scheme, percent, cpu, more = {}) {
  return {
    number, name: `${scheme}, ${number} steps a contact`, scheme, dt_s: 1e-5 / number, runs: 3, rate_g_per_s: { mean: 12 + percent / 10, half_width: 0.1 }, error: { percent, band: 0.4 },
    cpu_s: cpu, cost_ratio: cpu / 8, on_front: false, finest: false, chosen: false, note: '', ...more,
  };
}

/** `names`: { title, name } may replace texts. */
export function madeUpAccuracy(names = {}) {
  const levels = [
    level(1, 'velocity-verlet', 6, 0.2), level(2, 'velocity-verlet', -0.3, 0.9, { chosen: true, on_front: true }), level(3, 'rk2-midpoint', 2.4, 0.5), level(4, 'rk2-midpoint', 0.05, 8, { finest: true }),
    level(5, 'velocity-verlet', 0, 1, { rate_g_per_s: null, error: null, cpu_s: null, cost_ratio: null, note: 'the step is too long' }),
  ].map((one) => ({ ...one, name: names.name ?? one.name }));
  return {
    data: {
      kind: 'accuracy', program, vessels, scene, title: names.title ?? 'A made-up tray', space: 'plane', headlines: ['The cheapest setting shown to be within 1 % is setting 2.'], remarks: [{ serious: false, text: 'The tray is run as a plane.' }],
      against: 'the limit of step 0 and rigid grains', within_percent: 1, levels,
      errors: [{ source: 'softness', from: 'eps/r 0.0001', to: 'eps/r 0.01', percent: 5.1, band: 0.7 }, { source: 'chance of one run', from: '', to: '', percent: 0.9, band: null }],
    },
    recording: null,
  };
}

function curve(hole) {
  const values = Array.from({ length: 20 }, (_, k) => {
    const time = 0.25 * (k + 1), predicted = 100 * (1 - Math.exp(-time / (1 + hole)));
    return { time_s: time, held_out: k >= 15, measured: predicted + (k === 18 ? 7 : Math.sin(3 * k)), predicted, low: predicted - 3, high: predicted + 3 };
  });
  return { conditions: 'tray.motion.frequency = 9 Hz', hole: String(hole), lot: 'all', values };
}

function rates() {
  return [7, 8, 9, 10].map((frequency, k) => ({
    conditions: `tray.motion.frequency = ${frequency} Hz`, hole: 'all', lot: 'all',
    values: [{ time_s: null, held_out: k === 3, measured: 2 + k, predicted: 2.1 + 0.95 * k, low: 1.7 + 0.95 * k, high: 2.5 + 0.95 * k }],
  }));
}

/** `names`: { title, name } may replace texts. */
export function madeUpCalibration(ofCurves, names = {}) {
  const friction = names.name ?? 'contact.friction';
  const parameter = (name, mean, more = {}) => ({ name, unit: '', prior_low: 0.1, prior_high: 0.9, mean, low: mean - 0.1, high: mean + 0.1, contraction_percent: 60, not_told_apart_from: '', ...more });
  const points = Array.from({ length: 60 }, (_, k) => [0.3 + 0.003 * k, 0.6 - 0.003 * k + 0.02 * Math.sin(k)]);
  return {
    data: {
      kind: 'calibration', program, vessels, scene, title: names.title ?? 'A made-up slot', space: 'three_dimensional', headline: `Fitted to table.csv: ${friction} 0.4 (0.3 to 0.5).`, remarks: [{ serious: false, text: 'contact.friction and contact.rolling_friction cannot be told apart by this table' }],
      quantity: ofCurves ? 'discharged_percent' : 'rate_g_per_s', of_curves: ofCurves, series: ofCurves ? [curve(1), curve(2)] : rates(),
      parameters: [parameter(friction, 0.4, { not_told_apart_from: 'contact.rolling_friction' }), parameter('contact.rolling_friction', 0.8, { contraction_percent: 12, edge: 'upper' }), parameter('depth_factor', 20, { prior_low: null, prior_high: null, low: 18, high: 22 })],
      pairs: [{ a: friction, b: 'contact.rolling_friction', correlation: -0.93, told_apart: false, points }, { a: friction, b: 'depth_factor', correlation: 0.2, told_apart: true, points: [] }],
      account: ['150 runs at 100 points of the fitted values were simulated; 148 of them count.', 'Noise of one measurement: 3 % (of the repeats).'],
    },
    recording: null,
  };
}

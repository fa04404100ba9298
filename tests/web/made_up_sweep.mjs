// Sweeps made up for tests of the page: trays with more or fewer holes, shaken faster or slower.
import { madeUpRun, sceneOf } from './made_up_run.mjs';

const program = { name: 'vibrosow', version: '0.2.0' };
const length = 300, height = 60, depth = 60;  // mm, of the tray
const half = 6;                               // mm, of a hole

const figures = [
  ['rate_g_per_s', 'g/s', 'g/s', 'mass flow through all holes, in the window', true],
  ['seeds_per_s', 'seeds/s', '1/s', 'seeds through all holes, in the window', true],
  ['unevenness_cv_percent', 'unevenness CV %', '%', "coefficient of variation of the holes' rates, chance taken out", false],
  ['unevenness_cv_percent_low', 'low', '%', 'lower end of its 95 % interval', false],
  ['unevenness_cv_percent_high', 'high', '%', 'upper end', false],
  ['longest_pause_s', 'pause s', 's', 'longest time in the window in which no seed came from any hole', true],
].map(([name, heading, unit, description, has_interval]) => ({ name, heading, unit, description, has_interval }));

const mean = (value, half_width = null) => ({ mean: value, half_width });

function holePlaces(count) {
  return Array.from({ length: count }, (_, k) => (length * (k + 1)) / (count + 1));
}

function vesselsOf(count, tilt, inSpace) {
  const rims = [0, ...holePlaces(count).flatMap((x) => [x - half, x + half]), length];
  const floor = rims.flatMap((x, k) => (k % 2 ? [] : [{ points_mm: [[x, 0], [rims[k + 1], 0]] }]));
  const holes = holePlaces(count).map((x, k) => ({ number: k + 1, x_mm: x, z_mm: inSpace ? depth / 2 : 0, half_x_mm: half, half_z_mm: inSpace && k % 2 ? 2 * half : half, round: inSpace && k % 2 === 0 }));
  return [
    { name: 'tray', at_mm: [0, 0, 0], tilt_rad: tilt, length_mm: length, height_mm: height, depth_mm: depth, holes,
      lines: [...[0, length].map((x) => ({ points_mm: [[x, 0], [x, height]] })), ...floor] },
    { name: 'hopper', at_mm: [length / 2 - 30, 40, 10], tilt_rad: 0, length_mm: 60, height_mm: 70, depth_mm: inSpace ? depth - 20 : null, holes: [],
      lines: [{ points_mm: [[0, 70], [0, 15], [20, 0]] }, { points_mm: [[60, 70], [60, 15], [40, 0]] }, { points_mm: [[20, 0], [40, 0]], opens_at_s: 0.2 }] },
  ];
}

const doubts = new Map([[4, ['invalid', 'hole 3 lies beyond the rim']], [9, ['stopped', 'random seed 2: the energy grew by 31 %']], [13, ['outside the model', 'overlap of 9 %; the limit is 5 %']], [14, ['outside the model', 'overlap of 9 %; the limit is 5 %']]]);

function layoutOf(number, inSpace, name) {
  const count = 2 + (number % 5), frequency = 6 + (number % 7), tilt = 0.01 * (number % 4);
  const [status, note] = doubts.get(number) ?? ['ok', ''];
  const rate = 4 * count + 0.3 * ((number * 7919) % 11) + 0.2 * frequency;
  const noise = 0.6 + 0.1 * ((number * 31) % 7);
  const cv = number % 6 === 0 ? null : 2 + ((number * 13) % 17);
  const ran = status !== 'invalid';
  const values = {
    rate_g_per_s: mean(rate, noise), seeds_per_s: mean(30 * rate, 30 * noise), unevenness_cv_percent: cv === null ? null : mean(cv),
    unevenness_cv_percent_low: mean(cv === null ? 0 : 0.7 * cv), unevenness_cv_percent_high: mean(cv === null ? 5 : 1.5 * cv), longest_pause_s: mean(0.3 / count, 0.02),
  };
  return {
    number, name, values: [String(count), String(frequency), String((100 * tilt).toFixed(0))], status, note, replicates: ran ? 5 : 0,
    means: ran ? values : Object.fromEntries(figures.map((figure) => [figure.name, null])), misfit_percent: null,
    ...(inSpace && status === 'ok' ? { expected: `${rate.toPrecision(2)} g/s, expect ${(rate / 2).toPrecision(2)} to ${(2 * rate).toPrecision(2)} g/s until you weigh (95 %); of it chance 5 %, model 54 %` } : {}),
    holes: ran ? holePlaces(count).map((_, k) => ({ hole: String(k + 1), lot: 'wheat', seeds_per_s: mean((30 * rate) / count + 3 * k, 4), g_per_s: mean(rate / count + 0.1 * k, 0.13), longest_pause_s: mean(0.1 + 0.02 * k, null) })) : [],
    vessels: ran ? vesselsOf(count, tilt, inSpace) : [], ...(ran ? { scene: sceneOf('A tray', ['wheat', 'oat'], 100 + number) } : {}),
  };
}

// The layout as that of a made-up run, and its replay; `lots` may replace their names.
function withReplay(layout, space, lots) {
  const { data, recording } = madeUpRun(space, { lots });
  const { lots: all, holes, events, end_time_s, window_s: [from], vessels } = data;
  return { ...layout, vessels, replay: { random_seed: 7, end_time_s, measure_from_s: from, lots: all, holes: holes.map(({ hole, counted_all }) => ({ hole, counted_all })), events, recording: recording.toString('base64') } };
}

/** data and (no) recording of a sweep; `names`: { title, layout, command, lots } may replace texts; `replayed`: numbers of layouts. */
export function madeUpSweep(space, count = 40, names = {}, replayed = []) {
  const layouts = Array.from({ length: count }, (_, k) => layoutOf(k + 1, space !== 'plane', names.layout ?? ''))
    .map((layout) => (replayed.includes(layout.number) ? withReplay(layout, space, names.lots) : layout))
    .map((layout) => (layout.status === 'invalid' ? layout : { ...layout, command: names.command ?? `vibrosow run 'tray.toml' --set 'tray.holes.count=${layout.values[0]}' --html` }));
  const data = {
    kind: 'sweep', program, title: names.title ?? 'Made-up trays: how many holes, how fast', space, headline: `${count} layouts let out 9 to 31 g/s.`,
    ...(space === 'plane' ? {} : { expected: 'Until you weigh, expect 0.5 to 2 times these rates (95 %); of it chance 2 to 9 %, model 54 %.' }),
    keys: ['tray.holes.count', 'tray.motion.frequency_Hz', 'tray.tilt_degree'], figures, layouts, remarks: [{ serious: false, text: 'layout 4 cannot be built: hole 3 lies beyond the rim' }],
  };
  return { data, recording: null };
}

// What the first screen says of a tray, without a browser: its dimensions and its inputs in words.
import assert from 'node:assert/strict';
import test from 'node:test';
import { chainOf, widthsOf } from '../../web/report/dimensions.mjs';
import { holeWords, inputRows, shakingWords, tiltWords } from '../../web/report/inputs.mjs';
import { cssString } from '../../web/report/paper.mjs';
import { madeUpRun } from './made_up_run.mjs';

const texts = (places, length) => chainOf(places, length).map(({ text }) => text);
const hole = (x_mm, half_x_mm, more = {}) => ({ x_mm, z_mm: 0, half_x_mm, half_z_mm: 0, round: false, ...more });

test('a chain of dimensions goes over all places to the end', () => {
  assert.deepEqual(texts([70, 160, 250, 340, 430], 500), ['70', '4 × 90', '70']);
  assert.deepEqual(texts([250], 500), ['250', '250']);
  assert.deepEqual(texts([60, 150, 400], 500), ['60', '90', '250', '100']);
  assert.deepEqual(texts([60, 60.01, 60], 200), ['60', '140']);  // rows one behind the other
  assert.deepEqual(texts([1, 3, 6, 10, 15, 21, 28], 100), ['1', '27', '72']);
  assert.deepEqual(texts([0, 100], 100), ['100']);
  assert.deepEqual(texts([42.857, 85.714, 128.571], 300), ['42.9', '2 × 42.9', '171.4']);
  assert.deepEqual(texts([], 100), []);
  for (const places of [[70, 160, 250], [60, 150, 400]]) {
    const chain = chainOf(places, 500);
    chain.slice(1).forEach(({ from }, k) => assert.equal(from, chain[k].to));
    assert.deepEqual([chain[0].from, chain[chain.length - 1].to], [0, 500]);
  }
});

test('each width of holes once', () => {
  assert.deepEqual(widthsOf([hole(1, 6), hole(2, 6), hole(3, 7, { round: true })]).map(({ text, hole: of }) => [text, of.x_mm]), [['12', 1], ['⌀ 14', 3]]);
});

test('holes in words', () => {
  assert.equal(holeWords([70, 160, 250].map((x) => hole(x, 6)), 'plane'), '3 slots of 12 mm, 90 mm apart');
  assert.equal(holeWords([hole(19, 7, { round: true, half_z_mm: 7 })], 'three_dimensional'), '1 round hole of 14 mm, at 19 mm');
  assert.equal(holeWords([hole(10, 6, { z_mm: 5, half_z_mm: 12 }), hole(30, 7, { z_mm: 25, round: true })], 'three_dimensional'), '1 slot of 12 × 24 mm and 1 round hole of 14 mm, at 10 and 30 mm, in 2 rows');
  assert.equal(holeWords([1, 3, 6, 10, 15, 21, 28].map((x) => hole(x, 0.5)), 'plane'), '7 slots of 1 mm, from 1 to 28 mm');
  assert.equal(holeWords([], 'plane'), 'none');
});

test('tilt and shaking in words', () => {
  assert.deepEqual([0, 0.0523599, -0.0523599].map(tiltWords), ['level', '3° steep, its left end lower', '3° steep, its right end lower']);
  const harmonic = { kind: 'harmonic', direction_rad: 0, amplitude_m: 0.01, frequency_hz: 9 };
  assert.equal(shakingWords(harmonic), '9 Hz, 10 mm to either side, to and fro: 3.26 g at most');  // 0.01 (2 pi 9)^2 / 9.80665
  assert.match(shakingWords({ ...harmonic, direction_rad: Math.PI / 2 }), /, up and down: /);
  assert.match(shakingWords({ ...harmonic, direction_rad: -Math.PI }), /, to and fro: /);
  assert.match(shakingWords({ ...harmonic, direction_rad: 0.5235988 }), /, 30° over the level: /);
  assert.match(shakingWords({ ...harmonic, across_rad: 0.2 }), /, askew across the tray: /);
  assert.match(shakingWords({ kind: 'sum', components: [harmonic, { ...harmonic, frequency_hz: 4 }] }), /^9 Hz, .* and 4 Hz, 10 mm/);
  assert.equal(shakingWords({ kind: 'rocking', frequency_hz: 5, angle_rad: 0.0174533 }), 'rocked at 5 Hz, 1° to either side');
  assert.equal(shakingWords({ kind: 'table', time_s: [0, 1, 2, 3] }), 'moved as a table of 3 s says');
  assert.equal(shakingWords({ kind: 'turning', angular_velocity_rad_per_s: -Math.PI }), 'turned at 30 rpm');
  assert.equal(shakingWords(null), 'not shaken');
});

test('the inputs of a run, and of what has no scene', () => {
  const { data } = madeUpRun('plane');
  assert.deepEqual(inputRows(data), [
    { name: 'Mixture', text: 'wheat: balls of 4.4 mm, 40 mg, 66.7 % of the seeds; wild oat: 3 joined balls within 4.8 mm, 25 mg, 33.3 % of the seeds' },
    { name: 'Holes', text: '3 slots of 12 mm, 90 mm apart' },
    { name: 'Shaking', text: '5 Hz, 8 mm to either side, to and fro: 0.805 g at most' },
    { name: 'Level of seeds', text: '354 seeds; in the hopper 90 seeds, kept topped up' },
    { name: 'Tray', text: '300 mm long, 60 mm high; level; simulated in 2D, as a slice one seed thick' },
  ]);
  assert.deepEqual(inputRows({ ...data, scene: {} }).map(({ name }) => name), ['Holes', 'Tray']);
  assert.deepEqual(inputRows({ vessels: [], scene: {}, space: 'plane' }), []);
});

test('a title at the head of a sheet ends no string of CSS', () => {
  assert.equal(cssString('Tray 5'), '"Tray 5"');
  assert.equal(cssString('a"b\\c\n</style>'), '"a\\22 b\\5c c\\a \\3c /style\\3e "');
});

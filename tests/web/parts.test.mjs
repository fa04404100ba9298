// Numbers, scales, counters and places, without a browser.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import test from 'node:test';
import { layerScale, listColour, mix, speedScale } from '../../web/report/colours.mjs';
import { Counters } from '../../web/report/counters.mjs';
import { axisScale, duration, force, list, niceAbove, number, plusMinus, sentence } from '../../web/report/format.mjs';
import { floorAt, toLab, toOwn, wallsSeenFrom } from '../../web/report/geometry.mjs';
import { lightOf, notes } from '../../web/report/light.mjs';
import { mapSentence, packingSentence, velocitySentence } from '../../web/report/map_sentences.mjs';
import { outflowSentence } from '../../web/report/outflow_sentence.mjs';
import { readPageData } from '../../web/report/page_data.mjs';
import { frameAt, Player } from '../../web/report/player.mjs';

// The same cases as the terminal's (tests/report/test_number_text.cpp).
const cases = JSON.parse(readFileSync(new URL('../report/numbers.json', import.meta.url)));

test('numbers have three digits, their thousands apart and no exponent', () => {
  for (const { value, text } of cases.numbers) assert.equal(number(value), text);
  assert.equal(number(1.23456, 5), '1.2346');
  assert.deepEqual([null, undefined, NaN, Infinity].map((value) => number(value)), ['–', '–', '–', '–']);
});

test('an interval tells the last place of its mean', () => {
  for (const { mean, half_width, text } of cases.intervals) assert.equal(plusMinus(mean, half_width), text);
});

test('a time has the unit that suits it', () => {
  for (const { seconds, text } of cases.times) assert.equal(duration(seconds), text);
});

test('scales have round steps and hold their ends', () => {
  assert.deepEqual(axisScale(0, 47).ticks, [0, 10, 20, 30, 40, 50]);
  assert.deepEqual(axisScale(11.3, 20.6).ticks, [10, 12, 14, 16, 18, 20, 22]);
  assert.deepEqual(axisScale(0, 0).ticks.length, 2);
});

test('durations change to milliseconds', () => {
  assert.deepEqual([0.024, 0.5, 3, 0, null].map(duration), ['24 ms', '0.5 s', '3 s', '0 s', '–']);
});

test('sentences begin and end as such', () => {
  assert.deepEqual(['', 'ab 2', 'Ab.', 'why?'].map(sentence), ['', 'Ab 2.', 'Ab.', 'Why?']);
});

test('lists and ends of scales', () => {
  assert.deepEqual([[], ['a'], ['a', 'b'], ['a', 'b', 'c']].map(list), ['', 'a', 'a and b', 'a, b and c']);
  assert.deepEqual([0.31, 1, 1.01, 7, 0].map(niceAbove).map((value) => value.toPrecision(3)), ['0.500', '1.00', '2.00', '10.0', '1.00']);
});

const lightness = (colour) => [1, 3, 5].reduce((sum, k, i) => sum + parseInt(colour.slice(k, k + 2), 16) * [0.299, 0.587, 0.114][i], 0);

test('scales grow lighter step by step, in both themes', () => {
  for (const scale of [speedScale, layerScale]) {
    for (const theme of ['light', 'dark']) {
      const steps = scale(10, theme).map(lightness);
      assert.equal(steps.length, 10);
      steps.slice(1).forEach((step, k) => assert.ok(step > steps[k], `${scale.name} ${theme} ${k}`));
    }
  }
  assert.equal(mix('#000000', '#ffffff', 0.5), '#808080');
  assert.notEqual(listColour(0, 'light'), listColour(1, 'light'));
});

test('counters count a moment with what happens in it', () => {
  const counters = new Counters({ time_s: [0.1, 0.2, 0.2, 0.3], hole: [1, 2, 1, 0] }, [{ hole: 1 }, { hole: 2 }]);
  assert.deepEqual([0, 0.1, 0.2, Infinity].map((time) => counters.until(1, time)), [0, 1, 2, 2]);
  assert.equal(counters.until(0, Infinity), 1);
  assert.equal(counters.until(7, Infinity), 0);
});

test('the frame of a time', () => {
  assert.deepEqual([-1, 0, 0.49, 0.5, 9].map((time) => frameAt([0, 0.5, 1], time)), [0, 0, 0, 1, 2]);
});

test('vessel to lab and back', () => {
  const pose = { x: 0.1, y: -0.02, z: 0, angle: Math.PI / 2 };
  const [x, y] = toLab(pose, 10, 0);
  assert.ok(Math.abs(x - 100) < 1e-9 && Math.abs(y + 10) < 1e-9);
  const [a, b] = toOwn(pose, x, y);
  assert.ok(Math.abs(a - 10) < 1e-9 && Math.abs(b) < 1e-9);
});

test('the floor at a hole is where a line ends at its rim', () => {
  const vessel = { lines: [{ points_mm: [[0, 3], [40, 2.5]] }, { points_mm: [[60, 2], [100, 1]] }] };
  assert.equal(floorAt(vessel, { x_mm: 50, half_x_mm: 10 }), 2);
  assert.equal(floorAt(vessel, { x_mm: 50, half_x_mm: 5 }), 0);
});

test('the sentence under the chart', () => {
  const hole = (number_, rate, pause) => ({ hole: number_, rate, longest_pause_s: pause });
  const data = (holes) => ({ window_s: [1, 4], rate_unit: 'seeds/s', holes });
  assert.equal(outflowSentence(data([hole(1, 10, 0.02), hole(2, 12, 0.5)])),
    'From 1 to 4 s hole 2 let out most, 12 seeds/s, and hole 1 least, 10 seeds/s; the longest time without a seed was 0.5 s, at hole 2.');
  assert.equal(outflowSentence(data([hole(1, 10, null)])), 'From 1 to 4 s hole 1 let out 10 seeds/s.');
  assert.equal(outflowSentence(data([])), 'No hole has let out anything in the measured time.');
});

test('forces have the unit that suits them', () => {
  assert.deepEqual([0, 2.5, 0.0123, 4e-5, 3e-8].map(force), ['0 N', '2.5 N', '12.3 mN', '40 µN', '30 nN']);
});

test('sentences of maps', () => {
  const tray = { name: 'tray', holes: [{ number: 1, x_mm: 5, half_x_mm: 2 }, { number: 2, x_mm: 5, half_x_mm: 2 }, { number: 3, x_mm: 55, half_x_mm: 2 }] };
  const map = { cell: 0.01, columns: 6, rows: 2, looks: 211, from: 1, to: 3, view: 'slice',
    packing: [0.4, 0.6, 0.8, 0.6, 0.6, 0.04, 0, 0, 0.2, 0, 0, 0], vx: [0.01, 0, 0.02, 0, 0, 9, NaN, NaN, 0.02, NaN, NaN, NaN], vy: [-0.2, 0, 0, 0, 0, 9, NaN, NaN, 0, NaN, NaN, NaN] };
  assert.equal(packingSentence(map, tray), 'Densest, 0.8, 25 mm from the left end and 5 mm over the floor; 0.6 in the mean of the cells that are at least half as dense.');
  assert.equal(velocitySentence(map, tray), 'Fastest, 0.2 m/s down, at holes 1 and 2; cells that seeds fill to less than 0.05 are left out.');
  assert.equal(mapSentence(map, 'three_dimensional', tray),
    'The mean of 211 looks from 1 to 3 s, in the tray’s own frame, in cells of 10 mm, of a slice through the middle of the depth.');
  const hopper = { name: 'hopper' };
  assert.match(mapSentence(map, 'plane', tray, { beside: [hopper], isInHopper: true }),
    /in the tray’s own frame, .* Seeds in the hopper are left out; they have maps of their own\. The hopper is drawn where it stands while nothing shakes\.$/);
  assert.match(mapSentence(map, 'plane', tray, { beside: [hopper] }), /cells of 10 mm\. The hopper is drawn where it stands while nothing shakes\.$/);
  assert.match(mapSentence(map, 'plane', hopper, { isInHopper: true }), /in the hopper’s own frame, .* Of the seeds in the hopper alone\.$/);
  const empty = { ...map, packing: map.packing.map(() => 0) };
  assert.equal(packingSentence(empty, tray), 'The tray was empty.');
  assert.match(velocitySentence(empty, tray), /^No cell/);
});

test('the walls of a hopper in the frame of a tray that leans', () => {
  const tray = { at_mm: [100, 20, 0], tilt_rad: Math.PI / 2 };
  const hopper = { at_mm: [100, 50, 0], lines: [{ points_mm: [[0, 0], [10, 0]] }, { points_mm: [[0, 0], [0, 5]], opens_at_s: 1 }] };
  const walls = wallsSeenFrom(tray, hopper).map((wall) => wall.map((point) => point.map(Math.round)));
  assert.deepEqual(walls, [[[30, 0], [30, -10]]]);
  assert.deepEqual(wallsSeenFrom({}, {}), []);
});

test('what is missing or null in the data is empty', () => {
  const data = readPageData('{"title": "a", "remarks": null, "drill": null, "end_time_s": 3}');
  assert.deepEqual([data.title, data.remarks, data.drill, data.window_s], ['a', [], null, [0, 3]]);
  const sweep = readPageData('{"kind": "sweep", "layouts": [{"number": 3, "means": null}]}');
  assert.deepEqual([sweep.keys, sweep.layouts[0].means, sweep.layouts[0].vessels], [[], {}, []]);
  assert.throws(() => readPageData('{"kind": "letter"}'), /of the kind "letter"/);
});

test('one light gathers all doubts, the serious ones first', () => {
  assert.deepEqual(lightOf([]), { level: 'none', words: 'No doubt is known', all: [] });
  assert.deepEqual(lightOf(notes(['That is no guarantee.', 'that is no guarantee'])), { level: 'mild', words: 'No serious doubt, but 1 note', all: notes(['That is no guarantee.']) });
  const both = lightOf([...notes(['few seeds']), { serious: true, text: 'ran dry' }, ...notes(['layout 4 failed'])]);
  assert.deepEqual([both.level, both.words, both.all[0].text], ['serious', 'Doubtful: 1 serious doubt and 2 notes', 'ran dry']);
});

test('a replay stands still while its tab is hidden, and goes on from there', () => {
  const due = [];
  globalThis.requestAnimationFrame = (tick) => due.push(tick);
  const player = new Player([0, 1, 2, 3, 4, 5, 6, 7, 8, 9]);
  player.smooth = true;
  player.play();
  const frame = (now) => due.shift()(now);
  frame(1000);
  frame(1500);
  frame(2000);
  assert.equal(player.moment, 1);
  frame(60000);  // no frames are drawn in a hidden tab
  assert.equal(player.moment, 1);
  frame(60500);
  assert.equal(player.moment, 1.5);
  delete globalThis.requestAnimationFrame;
});

// What a sweep's page says of layouts, without a browser.
import assert from 'node:assert/strict';
import test from 'node:test';
import { figuresOf, textOf, valueOf } from '../../web/report/layout_figures.mjs';
import { keyWords, layoutName, wordsOf } from '../../web/report/layout_words.mjs';
import { scaleOf } from '../../web/report/interval_track.mjs';
import { ranked, rankingSentence } from '../../web/report/ranking.mjs';
import { pointsOf, tradeSentence, unbeaten } from '../../web/report/trade.mjs';

const rate = { name: 'rate_g_per_s', words: 'rate', unit: 'g/s', wanted_low: false };
const pause = { name: 'longest_pause_s', words: 'longest pause', unit: 's', wanted_low: true };

function layout(number, mean, half_width, more = {}) {
  return { number, name: '', values: [], status: 'ok', note: '', means: { rate_g_per_s: mean === null ? null : { mean, half_width } }, compared: (more.status ?? 'ok') === 'ok', ...more };
}

function toldOf(layouts, leastFirst = false) {
  return ranked(layouts, rate, leastFirst).map((row) => [row.layout.number, row.told]);
}

test('words of keys and figures', () => {
  assert.deepEqual(['tray.holes.span_mm', 'tray.motion.frequency_Hz', 'tray.holes.count', 'unevenness_cv_percent', 'tray_rate_g_per_min', 'lots.mass_g'].map(wordsOf), [
    { words: 'span', unit: 'mm' }, { words: 'frequency', unit: 'Hz' }, { words: 'count', unit: '' }, { words: 'unevenness CV', unit: '%' },
    { words: 'tray rate', unit: 'g/min' }, { words: 'mass', unit: 'g' }]);
  assert.deepEqual(keyWords(['tray.length_mm', 'hopper.length_mm', 'tray.tilt_degree']).map(({ words }) => words), ['tray length', 'hopper length', 'tilt']);
  const data = { keys: ['tray.holes.count', 'tray.length_mm', 'tray.tilt_degree'] };
  assert.equal(layoutName(data, { name: '', values: ['5', '', '3'] }), '5 · – · 3°');
  assert.equal(layoutName(data, { name: 'wide', values: ['5', '', '3'] }), 'wide');
});

test("a pooled figure's interval comes from its ends; what is not resolved lies below its upper one", () => {
  const data = { layouts: [], figures: ['unevenness_cv_percent', 'unevenness_cv_percent_low', 'unevenness_cv_percent_high', 'rate_g_per_s'].map((name) => ({ name, unit: '%' })) };
  const figures = figuresOf(data);
  assert.deepEqual(figures.map(({ name }) => name), ['unevenness_cv_percent', 'rate_g_per_s']);
  const means = (value, low, high) => ({ means: { unevenness_cv_percent: value === null ? null : { mean: value }, unevenness_cv_percent_low: { mean: low }, unevenness_cv_percent_high: { mean: high } } });
  assert.equal(textOf(valueOf(means(12, 9, 15), figures[0])), '12 (9 to 15)');
  assert.equal(textOf(valueOf(means(null, 0, 4.2), figures[0])), 'below 4.2');
  assert.equal(valueOf({ means: {} }, figures[0]), null);
  assert.equal(textOf(null), '–');
  const ends = { layouts: [], figures: data.figures.filter(({ name }) => name !== 'unevenness_cv_percent') };
  assert.deepEqual(figuresOf(ends).map(({ name, with_ends }) => [name, with_ends]), [['unevenness_cv_percent', true], ['rate_g_per_s', false]]);
});

test('layouts in order, and which overlap the first', () => {
  const layouts = [layout(1, 5, 1), layout(2, 9, 1), layout(3, 7.5, 0.6), layout(4, null), layout(5, 7.3, 0.6), layout(6, 11, 1, { status: 'stopped' }), layout(7, 6, null)];
  assert.deepEqual(toldOf(layouts), [[2, 'first'], [3, 'alike'], [5, 'apart'], [7, 'no interval'], [1, 'apart'], [6, 'not compared']]);
  assert.deepEqual(toldOf(layouts, true).slice(0, 2), [[1, 'first'], [7, 'no interval']]);
});

test('an interval that touches overlaps, and equal values keep the order of their numbers', () => {
  assert.deepEqual(toldOf([layout(3, 4, 1), layout(2, 6, 1), layout(1, 6, 0.5)]), [[1, 'first'], [2, 'alike'], [3, 'apart']]);
  assert.deepEqual(toldOf([layout(1, 6, 1), layout(2, 4, 1)]), [[1, 'first'], [2, 'alike']]);
});

test('the sentence over the order', () => {
  const say = (layouts, leastFirst = false) => rankingSentence({ keys: [], layouts }, ranked(layouts, rate, leastFirst), rate, leastFirst);
  assert.equal(say([layout(1, 5, 1), layout(2, 9, 1), layout(3, 8, 1), layout(4, null)]),
    'By rate layout 2 has the most: 9.0 ± 1.0 g/s; 1 other is not told apart from it. 1 layout has no value of it.');
  assert.equal(say([layout(1, 5, 1), layout(2, 9, 1)], true), 'By rate layout 1 has the least: 5.0 ± 1.0 g/s; no other interval overlaps its own.');
  assert.equal(say([layout(1, 5, null), layout(2, 9, null)]), 'By rate layout 2 has the most: 9 g/s; without intervals nothing says which layouts differ from it.');
  assert.equal(say([layout(1, 5, 1, { status: 'stopped' })]), 'No layout that can be compared has a value of rate.');
});

test('a scale is not ruled by one wide interval', () => {
  const value = (mean, half) => ({ value: mean, low: mean - half, high: mean + half, below: false });
  assert.deepEqual([scaleOf([value(10, 1)]).high, scaleOf([value(10, 1)]).cut], [15, false]);
  assert.deepEqual([scaleOf([value(10, 500)]).high, scaleOf([value(10, 500)]).cut], [20, true]);
});

test('layouts that no other beats in both figures', () => {
  const both = (number, x, y, status = 'ok') => ({ number, status, compared: status === 'ok', means: { rate_g_per_s: { mean: x }, longest_pause_s: y === null ? null : { mean: y } } });
  const layouts = [both(1, 10, 3), both(2, 8, 2), both(3, 8, 4), both(4, 12, 5), both(5, 20, 1, 'stopped'), both(6, 3, null), both(7, 8, 2)];
  const points = pointsOf(layouts, rate, pause);
  const front = unbeaten(points, rate, pause);
  assert.deepEqual(front.map((point) => point.layout.number), [2, 7, 1, 4]);
  assert.equal(tradeSentence({ layouts }, points, front, rate, pause),
    'For a high rate and a low longest pause, no layout beats layouts 1, 2, 4 and 7 in both, by their means. 1 layout has no value of one of the two and is not shown.');
});

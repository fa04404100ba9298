// What a study of combinations says, which layouts are the same or shown, and why a layout is on a front or not; without a browser.
import assert from 'node:assert/strict';
import test from 'node:test';
import { cellsOf, factorialOf, factorsOf, mainEffects } from '../../web/report/factorial.mjs';
import { filtered } from '../../web/report/filter.mjs';
import { frontReason } from '../../web/report/front_reasons.mjs';
import { effectsSentence } from '../../web/report/heat_map.mjs';
import { readPageData } from '../../web/report/page_data.mjs';
import { numbersOf, withoutTwins } from '../../web/report/same_layouts.mjs';
import { Wanted } from '../../web/report/wanted.mjs';

const rate = { name: 'rate_g_per_s', words: 'rate', unit: 'g/s', wanted_low: false };
const power = { name: 'power_W_per_kg', words: 'power', unit: 'W/kg', wanted_low: true };
const keys = ['tray.holes.count', 'tray.holes.span_mm', 'tray.motion.frequency_Hz'];

function layoutOf(number, values, mean, more = {}) {
  return { number, name: '', values: values.map(String), status: 'ok', compared: true, vessels: [{ holes: values[0], of: number }], means: { rate_g_per_s: { mean, half_width: 1 } }, ...more };
}

// Two counts, two spans and three frequencies: the rate is 2 a hole, and 1 more each 2 Hz.
function grid() {
  const all = [3, 5].flatMap((count) => [300, 420].flatMap((span) => [7, 9, 11].map((frequency) => [count, span, frequency])));
  return { keys, layouts: all.map((values, k) => layoutOf(k + 1, values, 2 * values[0] + (values[2] - 7) / 2)) };
}

test('a study of every combination is seen as one, and one that lacks a combination is not', () => {
  const data = grid();
  assert.deepEqual(factorialOf(data).map(({ name, levels }) => [name, levels]), [['count', ['3', '5']], ['span', ['300 mm', '420 mm']], ['frequency', ['7 Hz', '9 Hz', '11 Hz']]]);
  assert.deepEqual(factorialOf({ ...data, layouts: data.layouts.slice(1) }), []);
  assert.deepEqual(factorialOf({ ...data, layouts: data.layouts.slice(0, 3) }), []);  // one factor is no map
});

test('what goes with the name of a layout is no choice by itself', () => {
  const named = ['a', 'b'].flatMap((name, n) => [7, 9].map((frequency, k) => layoutOf(2 * n + k + 1, [3 + n, 300, frequency], 5, { name })));
  assert.deepEqual(factorsOf({ keys, layouts: named }).map(({ name }) => name), ['layout', 'frequency']);
});

test('main effects are means over all levels of the others, those first that do most', () => {
  const data = grid(), effects = mainEffects(data, factorialOf(data), rate);
  assert.deepEqual(effects.map(({ factor, size }) => [factor.name, size]), [['count', 4], ['frequency', 2], ['span', 0]]);
  assert.deepEqual(effects[0].levels.map(({ level, summary }) => [level, summary.value, summary.low, summary.high]), [['3', 7, 6, 8], ['5', 11, 10, 12]]);
  assert.equal(effectsSentence(effects, rate), 'Rate depends most on count: 7 to 11 g/s in the mean; least on span: 9 to 9 g/s in the mean.');
});

test('a cell of the map is the mean over the other choices, without layouts that are not compared', () => {
  const data = grid();
  data.layouts[0].compared = false;  // 3 holes, 300 mm, 7 Hz
  const [count, span, frequency] = factorialOf(data);
  assert.deepEqual(cellsOf(data, [count, frequency], rate).map((row) => row.map(({ summary }) => [summary.value, summary.count])), [[[6, 1], [7, 2], [8, 2]], [[10, 2], [11, 2], [12, 2]]]);
  assert.equal(cellsOf({ ...data, layouts: data.layouts.slice(0, 1) }, [count, span], rate)[0][0].summary, null);
});

test('layouts that are the same stand in one row, and are found by the values of each', () => {
  const data = grid();
  const twin = { ...data.layouts[0], number: 4, values: data.layouts[3].values };
  data.layouts[3] = twin;  // 3 holes over 420 mm at 7 Hz, as if over 300 mm
  const layouts = withoutTwins(data.layouts);
  assert.deepEqual(layouts.map(numbersOf), ['1 = 4', '2', '3', '5', '6', '7', '8', '9', '10', '11', '12']);
  const factors = factorialOf({ ...data, layouts });
  assert.equal(factors.length, 3);
  assert.deepEqual(filtered(layouts, [{ factor: factors[1], level: '420 mm' }, { factor: factors[2], level: '7 Hz' }]).map(({ number }) => number), [1, 10]);
  assert.equal(withoutTwins([layoutOf(1, [3], 5, { vessels: [] }), layoutOf(2, [3], 5, { vessels: [] })]).length, 2);  // what cannot be built is not alike
  const [one, other] = [1, 2].map((number) => layoutOf(number, [3], 5, { vessels: [] , scene: {} }));
  assert.equal(withoutTwins([{ ...one, vessels: [1] }, { ...other, vessels: [1], scene: { tray: { tilt_rad: 0.1 } } }]).length, 2);
  assert.deepEqual(readPageData(JSON.stringify({ kind: 'sweep', keys, layouts: [data.layouts[0], twin] })).layouts.map(numbersOf), ['1 = 4']);
});

test('the wanted rate filters what is compared and has it', () => {
  const { layouts } = grid(), wanted = new Wanted(null, rate);
  let told = 0;
  wanted.onChange(() => { ++told; });
  wanted.want('7', '10.5');
  layouts[1].compared = false;
  assert.deepEqual(wanted.of(rate), { low: 7, high: 10.5 });
  assert.equal(wanted.of(power), null);
  assert.deepEqual(filtered(layouts, [], rate, wanted.of(rate)).map(({ number }) => number), [3, 5, 6, 7, 10]);
  wanted.want('', '6');
  assert.deepEqual(filtered(layouts, [], rate, wanted.of(rate)).map(({ number }) => number), [1, 4]);
  wanted.want('', 'many');
  assert.equal(wanted.of(rate), null);
  assert.equal(told, 3);
  assert.deepEqual(new Wanted({ figure: power.name, low: 1, high: 2 }, rate).of(power), { low: 1, high: 2 });
});

test('why a layout is on the front, may be, or is not', () => {
  const at = (number, x, y, standing, half = 0.5) => ({ number, name: '', values: [], compared: true, standing, means: { rate_g_per_s: { mean: x, half_width: half }, power_W_per_kg: { mean: y, half_width: half } } });
  const data = { layouts: [at(1, 10, 3, 'on the front'), at(2, 8, 1, 'on the front'), at(3, 7, 5, 'dominated'), at(4, 9.8, 3.1, 'may be on the front'), at(5, 8.2, 1.2, 'may be on the front'), { ...at(6, 20, 0, 'misses the rate'), compared: false }] };
  const why = (number) => frontReason(data, data.layouts[number - 1], [rate, power]);
  assert.equal(why(1), 'No layout beats it by the means: it is the best in rate.');
  assert.equal(why(2), 'No layout beats it by the means: it is the best in power.');
  assert.equal(why(3), 'Layout 1 beats it by the means, rate 10.00 ± 0.50 g/s against 7.00 ± 0.50 g/s and power 3.00 ± 0.50 W/kg against 5.00 ± 0.50 W/kg; so do 3 more.');
  assert.equal(why(4), 'Layout 1 beats it by the means, rate 10.00 ± 0.50 g/s against 9.80 ± 0.50 g/s and power 3.00 ± 0.50 W/kg against 3.10 ± 0.50 W/kg; but the intervals of rate and power overlap.');
  assert.equal(why(5), 'No layout beats it by the means; but its intervals overlap those of layout 2.');
  assert.equal(why(6), '');
  assert.equal(frontReason(data, { ...data.layouts[0], means: {} }, [rate, power]), '');
});

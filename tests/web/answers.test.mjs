// The pages of made-up accuracy studies and calibrations, in a browser; and what they say, without one.
import assert from 'node:assert/strict';
import test from 'node:test';
import { fitSentence, residualSentence, residualsOf, seriesName } from '../../web/report/fit.mjs';
import { decades, pointsOf, precisionSentence } from '../../web/report/precision.mjs';
import * as in_ from './browser.mjs';
import { madeUpAccuracy, madeUpCalibration } from './made_up_answers.mjs';
import { hostile, withPage } from './made_up_pages.mjs';

async function assertDrawn(open, selector) {
  await open.locator(`${selector} .chart svg[role="slider"]`).first().waitFor();
  const broken = await open.$$eval(`${selector} .chart svg[role="slider"] *`, (parts) => parts.filter((part) => /NaN|Infinity/.test(part.outerHTML)).map((part) => part.outerHTML));
  assert.deepEqual(broken, []);
  assert.ok(await open.locator(`${selector} .chart :is(.line, .point-mark)`).count() > 2);
}

test('the ends of errors, and decades that hold them', () => {
  const level = (percent, band, cpu_s = 1) => ({ number: 1, error: percent === null ? null : { percent, band }, cpu_s });
  assert.deepEqual(pointsOf([level(-2, 0.5), level(0.2, 0.5), level(3, null), level(null), level(1, 1, null)]).map(({ size, low, high }) => [size, low, high]),
    [[2, 1.5, 2.5], [0.2, 0, 0.7], [3, null, null]]);
  assert.deepEqual(decades([0.02, 0, 30]), [0.01, 100]);
  assert.deepEqual(decades([1]), [1, 10]);
  assert.deepEqual(decades([0]), [0.1, 10]);
});

test('the sentence over error against cost', () => {
  const { data } = madeUpAccuracy();
  assert.equal(precisionSentence(data, pointsOf(data.levels)),
    '2 of 4 settings are shown to err by less than 1 % of the limit of step 0 and rigid grains; the quickest, setting 2, takes 0.9 s a run, the slowest of all 8 s.');
  assert.match(precisionSentence({ ...data, within_percent: 0.1 }, pointsOf(data.levels)), /^None of 4 settings is shown/);
  assert.equal(precisionSentence(data, []), 'No setting has both an error and a time.');
});

test('residuals of curves are of the largest value, of rates of the predicted one', () => {
  const series = { values: [{ measured: 10, predicted: 8, low: 6, high: 10 }, { measured: 40, predicted: 42, low: 38, high: 46, held_out: true, time_s: 2 }] };
  assert.deepEqual(residualsOf(series, true).map(({ residual, low, high }) => [residual, low, high]), [[5, -5, 5], [-5, -10, 10]]);
  assert.equal(residualsOf(series, false)[0].residual, 25);
  assert.equal(residualSentence(residualsOf(series, false), false), 'Measured and predicted differ by 25 % at most.');
  const { data } = madeUpCalibration(true);
  assert.match(residualSentence(residualsOf(data.series[0], true), true), /of the largest value at most at 4.75 s, where nothing was fitted\.$/);
  assert.equal(fitSentence(data.series[0].values), 'Within their 95 % intervals lie 15 of 15 fitted values and 4 of 5 held out values.');
  assert.equal(seriesName(data.series[1], data.series), 'tray.motion.frequency = 9 Hz, hole 2');
});

test('an accuracy study: the recommendation, the diagram and the settings', () => withPage(madeUpAccuracy(), { bypass: true }, async (open) => {
  assert.equal(await open.locator('.headline').textContent(), 'The cheapest setting shown to be within 1 % is setting 2.');
  assert.match(await open.locator('.remarks').textContent(), /as a plane\..*Setting 5 gave no rate/);
  await assertDrawn(open, '#precision');
  assert.match(await open.locator('.tray-card + .inputs').textContent(), /Shaking5 Hz/);
  assert.match(await open.locator('#precision .chart').getAttribute('aria-label'), /the quickest, setting 2/);
  const cells = await open.locator('#levels tbody tr').nth(1).locator('td').allTextContents();
  assert.deepEqual(cells.slice(1, 5), ['recommended', '-0.30 ± 0.40', '0.9', '11.97 ± 0.10']);
  assert.match(await open.locator('#levels tbody tr').nth(4).textContent(), /the step is too long/);
  assert.equal(await open.locator('#errors .lead').textContent(), 'Most is done by softness: 5.10 ± 0.70 % from its finest to its coarsest level.');
  await in_.assertReadsWell(open);
}));

test('a calibration by curves: all in one chart or one at a time, with residuals', () => withPage(madeUpCalibration(true), { bypass: true }, async (open) => {
  await assertDrawn(open, '#fit');
  assert.equal(await open.locator('#fit .chart').count(), 2);
  assert.match(await open.locator('.tray-card + .inputs').textContent(), /Shaking5 Hz/);
  assert.match(await open.locator('#fit-sentence').textContent(), /30 of 30 fitted values and 8 of 10 held out values/);
  assert.equal(await open.locator('#fit .chart').first().locator('.line').count(), 2);
  assert.deepEqual(await open.locator('#fit .legend-item:has(.marker)').allTextContents(), ['tray.motion.frequency = 9 Hz, hole 1', 'tray.motion.frequency = 9 Hz, hole 2']);
  assert.equal(await open.locator('#fit .chart').first().locator('.point-mark').count(), 40);
  await open.getByRole('combobox', { name: 'Curve' }).selectOption('tray.motion.frequency = 9 Hz, hole 2');
  await assertDrawn(open, '#fit');
  assert.equal(await open.locator('#parameters li').count(), 3);
  assert.match(await open.locator('#parameters .lead').textContent(), /^The table says most of contact.friction.* least of contact.rolling_friction \(12 %\)/);
  assert.match(await open.locator('#parameters li').first().textContent(), /not told apart from contact.rolling_friction/);
  assert.match(await open.locator('#parameters li').nth(1).textContent(), /at the upper end of its range: it may lie beyond/);
  assert.equal(await open.locator('#parameters .edge').count(), 1);
  assert.match(await open.locator('#fit-sentence').textContent(), /4 of 5 held out values/);
  assert.equal(await open.locator('#fit .chart').first().locator('.line').count(), 1);
  await assertDrawn(open, '#pairs');
  assert.match(await open.locator('#pairs figcaption').textContent(), /ends of the ranges/);
  assert.match(await open.locator('#pairs .lead').textContent(), /^1 of 2 pairs is not told apart/);
  await in_.assertReadsWell(open);
}));

test('a calibration by rates: all of them in one chart', () => withPage(madeUpCalibration(false), { bypass: true }, async (open) => {
  await assertDrawn(open, '#fit');
  assert.equal(await open.getByRole('combobox', { name: 'Curve' }).count(), 0);
  assert.equal(await open.locator('#fit .chart').first().locator('.point-mark').count(), 8);  // of 4 values what is measured and what is fitted
  assert.equal(await open.locator('#fit-sentence').textContent(), 'Within their 95 % intervals lie 3 of 3 fitted values and 1 of 1 held out values.');
  await in_.assertAccessible(open);
}));

test('data without figures are shown all the same', async () => {
  const accuracy = madeUpAccuracy(), calibration = madeUpCalibration(true);
  await withPage({ ...accuracy, data: { ...accuracy.data, levels: [], errors: [] } }, {}, async (open) => {
    assert.equal(await open.locator('#precision-sentence').textContent(), 'No setting has both an error and a time.');
  });
  await withPage({ ...calibration, data: { ...calibration.data, series: [], pairs: [], parameters: [] } }, {}, async (open) => {
    assert.equal(await open.locator('#fit, #pairs').count(), 0);
  });
});

for (const [name, made] of [['accuracy study', madeUpAccuracy({ title: hostile, name: hostile })], ['calibration', madeUpCalibration(true, { title: hostile, name: hostile })]]) {
  test(`hostile names in a ${name} stay text`, () => withPage(made, {}, async (open) => {
    assert.equal(await open.locator('h1').textContent(), hostile);
    assert.ok((await open.locator('main').textContent()).includes(hostile));
    assert.equal(await open.locator('img').count(), 0);
  }));
}

// Charts of all pages: their values by pointer and by keys, and their files.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import test from 'node:test';
import { csvOf } from '../../web/report/chart_files.mjs';
import { Counters } from '../../web/report/counters.mjs';
import { ratesOver } from '../../web/report/outflow.mjs';
import * as in_ from './browser.mjs';
import { madeUpAccuracy, madeUpCalibration } from './made_up_answers.mjs';
import { withPage } from './made_up_pages.mjs';
import { madeUpRun } from './made_up_run.mjs';
import { madeUpFront } from './made_up_studies.mjs';
import { madeUpSweep } from './made_up_sweep.mjs';

const charts = (page) => page.locator('.chart');
const values = (chart) => chart.locator('svg[role="slider"]');
const read = (chart) => chart.locator('.chart-reading').textContent();

async function saved(page, button) {
  const [download] = await Promise.all([page.waitForEvent('download'), button.click()]);
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
}

const rowsOf = (bytes) => bytes.toString().trim().split('\n').map((line) => line.split(','));

test('rates over time hold every seed, in spans that are no noise alone', () => {
  const { data } = madeUpRun('plane');
  const counters = new Counters(data.events, data.holes);
  const { times, span_s: span, values: rates } = ratesOver(data, counters);
  data.holes.forEach(({ hole, counted_all: all }, k) => {
    assert.ok(Math.abs(rates[k].reduce((sum, rate) => sum + rate * span, 0) - all) < 1e-9, `hole ${hole}`);
  });
  assert.ok(times.length >= 10 && times.length <= 40);
  assert.deepEqual(ratesOver({ ...data, events: { time_s: [], hole: [] } }, new Counters({ time_s: [], hole: [] }, data.holes)).values.flat().filter((rate) => rate !== 0), []);
});

test('CSV keeps every digit, and names that have commas', () => {
  assert.equal(csvOf({ columns: ['a', 'b'], rows: [['x, "y"', 1 / 3], [null, undefined]] }), 'a,b\n"x, ""y""",0.3333333333333333\n,\n');
});

test('a chart is read by keys, and the replay stays where it is', () => withPage(madeUpRun('plane'), {}, async (page) => {
  const { data } = madeUpRun('plane');
  const [outflow] = await charts(page).all();
  const frame = await in_.shownFrame(page);
  await values(outflow).focus();
  await page.keyboard.press('End');
  const total = data.holes.map(({ hole, counted_all: count }) => `hole ${hole} ${count}`).join(', ');
  assert.equal(await read(outflow), `2 s: ${total} seeds`);
  assert.equal(await values(outflow).getAttribute('aria-valuetext'), `2 s: ${total} seeds`);
  await page.keyboard.press('ArrowLeft');
  assert.match(await read(outflow), /^1\.99 s: /);
  await page.keyboard.press('Home');
  assert.equal(await read(outflow), '0 s: hole 1 0, hole 2 0, hole 3 0 seeds');
  assert.equal(await in_.shownFrame(page), frame);
}));

test('a chart is read under the pointer, and says nothing once it has left', () => withPage(madeUpRun('plane'), {}, async (page) => {
  const { data } = madeUpRun('plane');
  const bars = page.locator('#unevenness .chart');
  await bars.scrollIntoViewIfNeeded();
  const box = await bars.locator('.bar').nth(1).boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + 5);
  const { rate } = data.holes[1];
  assert.ok((await read(bars)).startsWith(`hole 2: ${Number(rate.toPrecision(3))} (`), await read(bars));
  await page.mouse.move(2, 2);
  assert.equal(await read(bars), '');
}));

test('lines are told apart without their colours', () => withPage(madeUpRun('plane'), {}, async (page) => {
  const dashes = await charts(page).first().locator('.line').evaluateAll((lines) => lines.map((line) => getComputedStyle(line).strokeDasharray));
  assert.equal(new Set(dashes).size, 3);
}));

test('a chart is saved with its numbers, and as pictures that stand by themselves', () => withPage(madeUpRun('plane'), {}, async (page) => {
  const { data } = madeUpRun('plane');
  const [outflow, rates] = await charts(page).all();
  const csv = await saved(page, outflow.getByRole('button', { name: 'as CSV' }));
  assert.equal(csv.name, 'outflow.csv');
  assert.deepEqual(rowsOf(csv.bytes)[0], ['time_s', 'hole 1', 'hole 2', 'hole 3']);
  assert.deepEqual(rowsOf(csv.bytes).at(-1).map(Number), [2, ...data.holes.map(({ counted_all: count }) => count)]);
  assert.equal((await saved(page, rates.getByRole('button', { name: 'as CSV' }))).name, 'rates.csv');
  const svg = (await saved(page, outflow.getByRole('button', { name: 'as SVG' }))).bytes.toString();
  assert.match(svg, /^<svg [^>]*xmlns="http:\/\/www\.w3\.org\/2000\/svg"/);
  assert.doesNotMatch(svg, /var\(--(?!card)/);
  assert.match(svg, /stroke:rgb\(178, 125, 14\)/);
  const png = (await saved(page, outflow.getByRole('button', { name: 'as PNG' }))).bytes;
  assert.equal(png.subarray(1, 4).toString(), 'PNG');
  const width = await values(outflow).evaluate((one) => one.clientWidth);
  assert.equal(png.readUInt32BE(16), Math.round(2 * width));
  const colours = await page.evaluate(async (base64) => {
    const picture = new Image();
    picture.src = `data:image/png;base64,${base64}`;
    await picture.decode();
    const canvas = Object.assign(document.createElement('canvas'), { width: picture.width, height: picture.height });
    const context = canvas.getContext('2d');
    context.drawImage(picture, 0, 0);
    return new Set(new Uint32Array(context.getImageData(0, 0, canvas.width, canvas.height).data.buffer)).size;
  }, png.toString('base64'));
  assert.ok(colours > 50, `${colours} colours`);
}));

for (const [name, made, least] of [
  ['run', madeUpRun('three_dimensional'), 4], ['accuracy study', madeUpAccuracy(), 1], ['calibration by curves', madeUpCalibration(true), 3], ['calibration by rates', madeUpCalibration(false), 3],
]) {
  test(`every chart of: ${name}, is drawn, read and saved`, () => withPage(made, {}, async (page) => {
    const all = await charts(page).all();
    assert.ok(all.length >= least, `${all.length} charts`);
    for (const chart of all) {
      await values(chart).focus();
      await page.keyboard.press('End');
      assert.match(await read(chart), /\d/);
      assert.doesNotMatch(await chart.innerHTML(), /NaN|Infinity|undefined/);
      const { bytes } = await saved(page, chart.getByRole('button', { name: 'as CSV' }));
      assert.ok(rowsOf(bytes).length > 1);
      assert.doesNotMatch(bytes.toString(), /NaN|undefined/);
    }
  }));
}

for (const [name, made] of [['sweep', madeUpSweep('plane')], ['search for a front', madeUpFront('plane')]]) {
  test(`the points of a ${name} are read under the pointer, and saved with their intervals`, () => withPage(made, {}, async (page) => {
    const point = page.locator('#trade circle[data-layout="7"]');
    await point.scrollIntoViewIfNeeded();
    const box = await point.boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    assert.match(await page.locator('#trade .chart-reading').textContent(), /^Layout 7, .*g\/s/);
    const { name: file, bytes } = await saved(page, page.locator('#trade').getByRole('button', { name: 'as CSV' }));
    assert.equal(file, 'layouts.csv');
    const [head, ...rows] = rowsOf(bytes);
    const own = rows.find(([number]) => number === '7'), { mean, half_width: half } = made.data.layouts[6].means.rate_g_per_s;
    assert.deepEqual(['rate_g_per_s', 'rate_g_per_s_low', 'rate_g_per_s_high'].map((column) => Number(own[head.indexOf(column)])), [mean, mean - half, mean + half]);
    assert.match((await saved(page, page.locator('#trade').getByRole('button', { name: 'as SVG' }))).bytes.toString(), /<circle/);
  }));
}

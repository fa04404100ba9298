// The page of made-up sweeps, in a browser.
import assert from 'node:assert/strict';
import { statSync } from 'node:fs';
import test from 'node:test';
import * as in_ from './browser.mjs';
import { fileOf, hostile, openMade, withPage } from './made_up_pages.mjs';
import { madeUpSweep } from './made_up_sweep.mjs';

const plane = madeUpSweep('plane');
const page = await openMade(plane);

function numbersIn(open, selector) {
  return open.$$eval(selector, (nodes) => nodes.map((node) => Number(node.dataset.layout)));
}

function rateOf(number) {
  return plane.data.layouts[number - 1].means.rate_g_per_s;
}

function isOk(number) {
  return plane.data.layouts[number - 1].status === 'ok';
}

async function assertShown(open, number) {
  await open.getByRole('heading', { name: `Layout ${number}`, exact: true }).waitFor();
  const layout = plane.data.layouts[number - 1];
  const label = await open.locator('#layout .drawing').first().getAttribute('aria-label');
  assert.ok(label.startsWith(`Layout ${number} from the side`), label);
  assert.deepEqual(await open.locator('#layout .drawing > text').allTextContents(), layout.holes.map(({ hole }) => hole));
  assert.equal(await open.locator('#layout .hole-bars .track').count(), layout.holes.length);
}


test('the layouts stand in the order of the rate, those that are not ok last and not compared', async () => {
  await page.getByRole('button', { name: 'Show all 39' }).click();
  const shown = await numbersIn(page, '#ranking .ranks button');
  assert.equal(shown.length, 39);
  assert.deepEqual(shown.map(isOk), [...Array(36).fill(true), ...Array(3).fill(false)]);
  for (const part of [shown.slice(0, 36), shown.slice(36)]) part.slice(1).forEach((number, k) => assert.ok(rateOf(number).mean <= rateOf(part[k]).mean));
  const low = ({ mean, half_width }) => mean - half_width, high = ({ mean, half_width }) => mean + half_width;
  const alike = shown.slice(1, 36).filter((number) => high(rateOf(number)) >= low(rateOf(shown[0])));
  assert.ok(alike.length > 0);
  assert.deepEqual(await numbersIn(page, '#ranking .ranks .alike'), alike);
  assert.match(await page.locator('#ranking-sentence').textContent(), new RegExp(`^By rate layout ${shown[0]} .* ${alike.length} others are not told apart from it`));
  await page.getByRole('button', { name: 'Show the first 30' }).click();
  assert.equal((await numbersIn(page, '#ranking .ranks button')).length, 30);
});

test('the first screen has the layout that is first, drawn and in words', async () => {
  const [first] = await numbersIn(page, '#ranking .ranks button');
  const card = page.locator('.tray-card');
  assert.match(await card.locator('h2').textContent(), new RegExp(`^Layout ${first} \\(.*\\): the highest rate$`));
  assert.ok((await card.locator('.drawing').getAttribute('aria-label')).startsWith(`Layout ${first} `));
  assert.match(await page.locator('.inputs').textContent(), new RegExp(`Mixture.*Shaking5 Hz, 8 mm.*Level of seeds${100 + first} seeds`));
});

test('least first, and another figure', async () => {
  await page.getByRole('radio', { name: 'Least first' }).check();
  const least = plane.data.layouts.filter(({ status }) => status === 'ok').reduce((a, b) => (b.means.rate_g_per_s.mean < a.means.rate_g_per_s.mean ? b : a));
  assert.equal((await numbersIn(page, '#ranking .ranks button'))[0], least.number);
  await page.getByRole('combobox', { name: 'Figure', exact: true }).selectOption('unevenness CV, %');
  assert.equal(await page.getByRole('radio', { name: 'Least first' }).isChecked(), true);
  assert.match(await page.locator('#ranking .ranks button').first().textContent(), /below 5/);
  await page.getByRole('combobox', { name: 'Figure', exact: true }).selectOption('rate, g/s');
  assert.equal(await page.getByRole('radio', { name: 'Most first' }).isChecked(), true);
});

test('a press on a row, on a point, and the enter key choose a layout; the address keeps it', async () => {
  await page.locator('#layouts tr[data-layout="7"] td').first().click();
  await assertShown(page, 7);
  assert.match(page.url(), /#layout=7$/);
  await page.locator('#ranking .ranks button').nth(2).click();
  await assertShown(page, (await numbersIn(page, '#ranking .ranks button'))[2]);
  await page.getByRole('button', { name: 'Show layout 12', exact: true }).focus();
  await page.keyboard.press('Enter');
  await assertShown(page, 12);
  assert.deepEqual(await numbersIn(page, '#layouts tr[data-chosen]'), [12]);
  await page.goBack();
  await page.waitForFunction(() => !/Layout 12$/.test(document.querySelector('#layout-title').textContent));
});

test("a layout's figures and its drawing are those of the data", async () => {
  await page.getByRole('button', { name: 'Show layout 8', exact: true }).click();
  await assertShown(page, 8);
  assert.deepEqual(await page.locator('#layout .dimension text').allTextContents(), ['50', '4 × 50', '50', '300', '60', '12', '40']);  // 5 holes, and a closed hopper 40 mm over the floor
  const { means } = plane.data.layouts[7];
  const values = await page.locator('#layout .figures .value').allTextContents();
  assert.equal(values[0], `${means.rate_g_per_s.mean.toFixed(2)} ± ${means.rate_g_per_s.half_width.toFixed(2)} g/s`);
  assert.equal(values.length, 4);
  const eight = await page.locator('#layout .drawing').innerHTML();
  await page.getByRole('button', { name: 'Show layout 9', exact: true }).click();
  await assertShown(page, 9);
  assert.notEqual(await page.locator('#layout .drawing').innerHTML(), eight);
  assert.match(await page.locator('#layout .doubt').textContent(), /guard stopped.*the energy grew by 31 %/);
  await page.getByRole('button', { name: 'Show layout 4', exact: true }).click();
  await page.getByText('there is nothing to draw').waitFor();
});

test('a heading sorts, by the mouse and by the keyboard', async () => {
  const rates = async () => (await numbersIn(page, '#layouts tbody tr')).filter((number) => rateOf(number)).map((number) => rateOf(number).mean);
  const heading = page.locator('#layouts th button[data-column="rate_g_per_s"]');
  await heading.click();
  const rising = await rates();
  assert.deepEqual(rising, [...rising].sort((a, b) => a - b));
  assert.equal((await numbersIn(page, '#layouts tbody tr')).pop(), 4);
  await page.keyboard.press('Enter');
  assert.deepEqual(await rates(), [...rising].reverse());
  assert.equal((await numbersIn(page, '#layouts tbody tr')).pop(), 4);
  assert.equal(await page.locator('#layouts th[aria-sort="descending"]').textContent(), 'rate g/s ▼');
});

test('figures come into the table and leave it', async () => {
  await page.getByText('Figures in the table').click();
  await page.getByRole('checkbox', { name: 'seeds, 1/s' }).check();
  await page.getByRole('columnheader', { name: 'seeds' }).waitFor();
  await page.getByRole('checkbox', { name: 'rate, g/s' }).uncheck();
  assert.equal(await page.getByRole('columnheader', { name: 'rate' }).count(), 0);
});

test('the points of two figures: the mouse and the keyboard choose', async () => {
  assert.equal(await page.locator('#trade circle[role]').count(), 39);
  assert.match(await page.locator('#trade-sentence').textContent(), /^For a high rate and a low unevenness CV, no layout beats .*1 layout has no value/);
  const point = page.locator('#trade circle[data-layout="11"]');
  await point.scrollIntoViewIfNeeded();
  const box = await point.boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  await assertShown(page, 11);
  await point.focus();
  await page.keyboard.press('ArrowRight');
  const next = await page.evaluate(() => Number(document.activeElement.dataset.layout));
  assert.notEqual(next, 11);
  await page.keyboard.press('Enter');
  await assertShown(page, next);
  await page.getByRole('combobox', { name: 'Up', exact: true }).selectOption('longest pause, s');
  assert.match(await page.locator('#trade-sentence').textContent(), /low longest pause/);
});

test('the address opens with its layout, and a foreign one with the first of the order', async () => {
  await withPage(plane, { hash: '#layout=21' }, (open) => assertShown(open, 21));
  await withPage(plane, { hash: '#layout=999' }, async (open) => assertShown(open, (await numbersIn(open, '#ranking .ranks button'))[0]));
});

test('in space it is told what to expect until one weighs, of all layouts and of the chosen one', () => withPage(madeUpSweep('three_dimensional'), { hash: '#layout=5', bypass: true }, async (open) => {
  const { data } = madeUpSweep('three_dimensional');
  assert.deepEqual(await open.locator('.headline').allTextContents(), [data.headline, data.expected]);
  assert.equal(await open.locator('#layout .expected').textContent(), `${data.layouts[4].expected}.`);
}));

test('in the plane it is not', async () => {
  assert.equal(await page.locator('.headline').count(), 1);
  assert.equal(await page.locator('#layout .expected').count(), 0);
});

test('in space a layout is drawn from above too, holes round or slots', () => withPage(madeUpSweep('three_dimensional'), { hash: '#layout=5', bypass: true }, async (open) => {
  const { holes } = madeUpSweep('three_dimensional').data.layouts[4].vessels[0];
  assert.equal(await open.locator('#layout .drawing').count(), 2);
  const corners = await open.$$eval('#layout .drawing .hole', (paths) => paths.map((path) => path.getAttribute('d').split('L').length));
  assert.deepEqual(corners, holes.map(({ round }) => (round ? 48 : 4)));
  await in_.assertReadsWell(open);
  await open.getByRole('button', { name: 'Show layout 6', exact: true }).click();
  await open.getByRole('heading', { name: 'Layout 6', exact: true }).waitFor();
  await open.waitForFunction(() => Math.abs(document.querySelector('#layout').getBoundingClientRect().top - 12) < 5);
}));

test('300 layouts: less than 10 MB, thirty shown first, and all when asked for', () => withPage(madeUpSweep('plane', 300), {}, async (open) => {
  assert.ok(statSync(fileOf(madeUpSweep('plane', 300))).size < 10e6);
  assert.equal(await open.locator('#ranking .ranks button').count(), 30);
  assert.equal(await open.locator('#layouts tbody tr').count(), 300);
  await open.locator('#ranking button', { hasText: /^Show all/ }).click();
  assert.equal(await open.locator('#ranking .ranks button').count(), 299);
}));

test('hostile names stay text', () => withPage(madeUpSweep('plane', 6, { title: hostile, layout: hostile }), {}, async (open) => {
  assert.equal(await open.locator('h1').textContent(), hostile);
  assert.equal(await open.locator('#layouts td', { hasText: hostile }).count(), 6);
  assert.match(await open.locator('#layout-title').textContent(), /onerror=alert\(1\)>$/);
  assert.equal(await open.locator('img').count(), 0);
}));

test('a sweep without figures still shows its table', () => withPage({ data: { ...plane.data, figures: [], layouts: plane.data.layouts.slice(0, 2).map((layout) => ({ ...layout, means: {} })) }, recording: null }, {}, async (open) => {
  assert.equal(await open.locator('#layouts tbody tr').count(), 2);
  assert.equal(await open.locator('#ranking').count(), 0);
  await open.getByText('It has no figures.').waitFor();
}));

// Every combination of two counts, two frequencies and two tilts, and a ninth layout that is the first once more.
function factorial() {
  const made = madeUpSweep('plane', 8);
  const layouts = made.data.layouts.map((layout, k) => ({ ...layout, number: k + 1, status: 'ok', note: '', values: [k < 4 ? '3' : '5', k % 4 < 2 ? '7' : '9', String(k % 2)], vessels: made.data.layouts[0].vessels,
    means: { ...made.data.layouts[0].means, rate_g_per_s: { mean: 10 + k, half_width: 0.5 } } }));
  return { ...made, data: { ...made.data, layouts: [...layouts, { ...layouts[0], number: 9, values: ['3', '7', '2'] }] } };
}

test('a study of every combination: the map, what each choice does, the wanted rate and the filter', () => {
  const made = factorial();
  made.data.layouts.pop();
  return withPage(made, { bypass: true }, async (open) => {
    assert.equal(await open.locator('#effects-sentence').textContent(), 'Rate depends most on count: 11.5 to 15.5 g/s in the mean; least on tilt: 13 to 14 g/s in the mean.');
    assert.deepEqual(await open.locator('.heat-map td').allTextContents(), ['10.5', '12.5', '14.5', '16.5']);
    assert.deepEqual(await open.locator('.effect-bars li:not(.hole-head) > :first-child').allTextContents(), ['count 3', 'count 5', 'frequency 7 Hz', 'frequency 9 Hz', 'tilt 0°', 'tilt 1°']);
    const shades = await open.locator('.heat-map td').evaluateAll((cells) => cells.map((cell) => getComputedStyle(cell).backgroundColor));
    assert.equal(new Set(shades).size, 4);
    await open.getByRole('textbox', { name: 'Wanted rate from, g/s' }).fill('12');
    await open.getByRole('textbox', { name: 'Wanted rate to, g/s' }).fill('15');
    assert.deepEqual(await open.locator('.heat-map .as-wanted').allTextContents(), ['12.5', '14.5']);
    assert.equal(await open.locator('#ranking .ranks li').first().locator('.wanted-line').count(), 2);
    assert.equal((await open.locator('#trade .wanted-line').getAttribute('d')).match(/M/g).length, 2);
    await open.getByRole('checkbox', { name: 'Only layouts with it' }).check();
    assert.equal(await open.locator('#filter-sentence').textContent(), '4 of 8 layouts are shown.');
    assert.deepEqual((await numbersIn(open, '#layouts tbody tr')).sort(), [3, 4, 5, 6]);
    await open.getByRole('combobox', { name: 'Only count' }).selectOption('5');
    assert.deepEqual((await numbersIn(open, '#layouts tbody tr')).sort(), [5, 6]);
    assert.deepEqual((await numbersIn(open, '#trade circle[role]')).sort(), [5, 6]);
    await open.getByRole('combobox', { name: 'Only frequency' }).selectOption('9 Hz');
    assert.equal(await open.locator('#layouts tbody tr').count(), 0);
    await in_.assertAccessible(open);
    for (const name of ['Only count', 'Only frequency']) await open.getByRole('combobox', { name }).selectOption('any');
    await open.getByRole('checkbox', { name: 'Only layouts with it' }).uncheck();
    await open.getByRole('combobox', { name: 'Down' }).selectOption('tilt');
    assert.equal(await open.locator('.heat-map caption').textContent(), 'rate, g/s by tilt and frequency');
    await in_.assertReadsWell(open);
  });
});

test('layouts that are the same have one row, which the address of each opens', () => withPage(factorial(), { hash: '#layout=9' }, async (open) => {
  await open.getByRole('heading', { name: 'Layout 1 = 9', exact: true }).waitFor();
  assert.equal(await open.locator('#layouts tbody tr').count(), 8);
  assert.equal(await open.locator('#layouts tr[data-chosen] th').textContent(), '1 = 9');
}));

test('nothing of all that was complained of', () => assert.deepEqual(page.complaints, []));

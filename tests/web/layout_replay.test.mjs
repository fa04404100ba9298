// Replays in the page of a sweep, in a browser: of layouts that have one, and what is said of the others.
import assert from 'node:assert/strict';
import test from 'node:test';
import * as in_ from './browser.mjs';
import { hostile, withPage } from './made_up_pages.mjs';
import { madeUpSweep } from './made_up_sweep.mjs';

const replayed = [11, 12];
const sweep = madeUpSweep('plane', 20, {}, replayed);
const { replay } = sweep.data.layouts[10];

async function choose(page, number) {
  await page.getByRole('button', { name: `Show layout ${number}`, exact: true }).click();
  await page.getByRole('heading', { name: `Layout ${number}`, exact: true }).waitFor();
}

async function chooseReplayed(page, number) {
  await choose(page, number);
  await page.waitForSelector('#layout #replay-canvas[data-frame]');
}

test('a click shows the replay of that layout, its counters end at its counts, and it stops when another is chosen', () => withPage(sweep, {}, async (page) => {
  await chooseReplayed(page, 11);
  await page.getByText('One run of this layout, with random seed 7').waitFor();
  await page.getByRole('button', { name: 'Play', exact: true }).click();
  const before = await in_.shownFrame(page);
  await page.waitForFunction((frame) => Number(document.querySelector('#replay-canvas').dataset.frame) > frame, before);
  await in_.scrubToEnd(page);
  assert.deepEqual([...(await in_.shownCounts(page))], replay.holes.map(({ hole, counted_all }) => [hole, counted_all]));
  const all = replay.holes.reduce((sum, { counted_all }) => sum + counted_all, 0);
  await page.getByText(`${all} seeds left in`).waitFor();
  await in_.scrubTo(page, 3);
  await page.getByRole('button', { name: 'Play', exact: true }).click();
  await chooseReplayed(page, 12);
  assert.equal(await page.locator('#replay-canvas').count(), 1);
  await chooseReplayed(page, 11);
  await page.getByRole('button', { name: 'Play', exact: true }).waitFor();  // it rests
}));

test('a layout without replay says the command that makes one, and one that cannot be built says nothing', () => withPage(sweep, {}, async (page) => {
  await choose(page, 5);
  assert.equal(await page.locator('#layout .command').textContent(), sweep.data.layouts[4].command);
  assert.equal(await page.locator('#replay-canvas').count(), 0);
  await choose(page, 4);
  assert.equal(await page.locator('#layout .command').count(), 0);
}));

test('keys: inside of the replay they step and play, outside they are the page’s', () => withPage(sweep, { hash: '#layout=11' }, async (page) => {
  await page.waitForSelector('#layout #replay-canvas[data-frame]');
  const first = await in_.shownFrame(page);
  await page.getByRole('button', { name: 'One frame forward' }).focus();
  await page.keyboard.press('ArrowRight');
  await in_.waitForFrame(page, first + 1);
  await page.getByRole('slider', { name: 'Time of the replay' }).focus();
  await page.keyboard.press('ArrowRight');
  await in_.waitForFrame(page, first + 2);
  await page.keyboard.press(' ');
  await page.getByRole('button', { name: 'Pause', exact: true }).waitFor();
  await page.keyboard.press(' ');
  await page.getByRole('button', { name: 'Play', exact: true }).waitFor();
  const rests = await in_.shownFrame(page);
  await page.getByRole('button', { name: 'Show layout 5', exact: true }).focus();
  await page.keyboard.press('ArrowRight');
  assert.equal(await in_.shownFrame(page), rests);
}));

for (const space of ['plane', 'three_dimensional']) {
  test(`nothing bars a reader, light and dark, wide and on a phone: ${space}`, () => withPage(madeUpSweep(space, 12, {}, [11]), { hash: '#layout=11', bypass: true }, async (page) => {
    await page.waitForSelector('#layout #replay-canvas[data-frame]');
    await in_.assertReadsWell(page);
    await choose(page, 5);
    await in_.assertAccessible(page);
    await in_.assertNoSidewaysScrolling(page);
  }));
}

test('hostile names of lots and a hostile command stay text', () => withPage(madeUpSweep('plane', 12, { command: hostile, lots: [hostile, hostile] }, [11]), { hash: '#layout=11' }, async (page) => {
  await page.waitForSelector('#layout #replay-canvas[data-frame]');
  assert.ok((await page.locator('#replay-legend').textContent()).includes(hostile));
  await choose(page, 5);
  assert.equal(await page.locator('#layout .command').textContent(), hostile);
  assert.equal(await page.locator('img').count(), 0);
}));

test('a damaged recording is told, and the rest of the layout is shown', () => {
  const layouts = sweep.data.layouts.map((layout) => (layout.replay ? { ...layout, replay: { ...layout.replay, recording: btoa('no recording') } } : layout));
  return withPage({ data: { ...sweep.data, layouts }, recording: null }, { hash: '#layout=11' }, async (page) => {
    await page.getByText('The recording of this layout cannot be replayed: it does not begin with VBSWREC1.').waitFor();
    assert.ok(await page.locator('#layout .figures .value').count() > 0);
  });
});

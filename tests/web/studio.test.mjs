// The studio in a browser, with a simulator that is made up.
import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import path from 'node:path';
import test, { after } from 'node:test';
import { deflateRawSync } from 'node:zlib';
import { layoutOf, moveHole } from '../../web/studio/layout.mjs';
import { fragmentOf } from '../../web/studio/link.mjs';
import * as in_ from './browser.mjs';
import { fillStudio, madeUpStudio, studioTemplate, whyNot3d } from './made_up_studio.mjs';

const { parse } = createRequire(new URL('../../web/package.json', import.meta.url))('smol-toml');
const hostile = '</script><img src=x onerror=alert(1)>';
const template = await studioTemplate();
const folder = mkdtempSync(path.join(tmpdir(), 'vibrosow-studio-'));
const file = path.join(folder, 'studio.html');
const browser = await in_.startBrowser();

after(async () => {
  await browser.close();
  rmSync(folder, { recursive: true });
});

async function withStudio(options, check, data = madeUpStudio()) {
  writeFileSync(file, fillStudio(template, data));
  const page = await in_.openPage(browser, file, options);
  try {
    await check(page);
    assert.deepEqual(page.complaints, []);
  } finally {
    await page.context().close();
  }
}

const bench = (page, name = 'A') => page.getByRole('region', { name: `Layout ${name}`, exact: true });
const handle = (place, k) => place.getByRole('slider', { name: `Hole ${k}`, exact: true });
const status = (place, ...wanted) => place.and(place.page().locator(wanted.map((one) => `[data-status="${one}"]`).join(','))).waitFor();
const opened = (place) => status(place, 'ready', 'playing', 'paused', 'ended');
const valueText = (place, k) => handle(place, k).getAttribute('aria-valuetext');

function withLateMeasuring() {
  const data = madeUpStudio();
  Object.assign(data.seeders[0].scene.run, { duration_s: 40, measure_from_s: 30 });
  return data;
}

async function countsAtTheEnd(place) {
  await opened(place);
  await place.getByRole('button', { name: 'To the end' }).evaluate((button) => button.click());  // which does nothing where it has ended
  await status(place, 'ended');
  return place.locator('canvas').evaluate((canvas) => new Promise((painted) => {
    requestAnimationFrame(() => requestAnimationFrame(() => painted(canvas.dataset.counts)));
  }));
}

test('the template is small and keeps the licence of what is in it', () => {
  assert.ok(template.length < 250e3);
  assert.match(template, /smol-toml 1\.9\.1[\s\S]*Redistribution and use in source and binary forms/);
});

test('it opens playing, counts at the holes, and says plainly what it is', () => withStudio({}, async (page) => {
  const place = bench(page);
  await page.waitForFunction(() => JSON.parse(document.querySelector('canvas').dataset.counts ?? '[0]')[0] > 3);
  assert.match(await page.locator('#head').textContent(), /A 2D slice one seed thick: use it to compare layouts; it is no sowing rate\./);
  assert.match(await page.locator('#head').textContent(), /holes and shake change while it runs/);
  assert.ok(await place.getByRole('radio', { name: 'Draft' }).isChecked());
  await place.getByText('In real time').waitFor();
  await place.getByText(/^Measured from 1 to/).waitFor();
  await place.getByText('The holes differ by more than chance.').waitFor();
  assert.equal(await place.locator('.hole-bars .track').count(), 5);
  assert.doesNotMatch(await page.locator('body').innerText(), /kg\/ha|g\/min/);
  await place.getByRole('button', { name: 'Restart' }).click();  // on a slow machine it may have come to its end by now
  await place.getByRole('button', { name: 'Pause' }).click();
  await status(place, 'paused');
  const time = await place.locator('canvas').getAttribute('data-time');
  await place.getByRole('button', { name: 'Play' }).click();
  await page.waitForFunction((then) => document.querySelector('canvas').dataset.time > then, time);
  assert.match(await countsAtTheEnd(place), /^\[\d+,\d+,\d+,\d+,\d+\]$/);
  await place.getByText('4.00 s of 4 s').waitFor();
  await page.evaluate(() => {  // however slow the machine: no time that was shown is missed
    const canvas = document.querySelector('canvas');
    window.leastTime = Infinity;
    new MutationObserver(() => { window.leastTime = Math.min(window.leastTime, Number(canvas.dataset.time)); }).observe(canvas, { attributeFilter: ['data-time'] });
  });
  await place.getByRole('button', { name: 'Restart' }).click();
  await page.waitForFunction(() => window.leastTime < 1);
}));

test('before the measuring begins the rate of the last shakes is told', () => withStudio({}, async (page) => {
  const place = bench(page);
  await place.locator('dt', { hasText: /^Last (shake|[0-9]+ shakes)$/ }).waitFor();
  await place.getByRole('button', { name: 'Pause' }).click();
  await status(place, 'paused');
  const told = await place.locator('.figures .value').textContent();
  const [rate, low, high] = /^([0-9.]+) seeds\/s, ([0-9.]+) to ([0-9.]+)$/.exec(told).slice(1).map(Number);
  assert.ok(low < rate && rate < high, told);
  assert.equal(await place.locator('.hole-bars .track').count(), 5);
  assert.equal(await place.getByText('All holes').count(), 0);
  await place.getByText('Measuring begins at 30 s.').waitFor();
}, withLateMeasuring()));

test('doubts stand on top of the picture and the rates', () => withStudio({}, async (page) => {
  const place = bench(page);
  const width = place.getByRole('spinbutton', { name: 'Width of hole 1 in mm' });
  await width.fill('3');
  await width.press('Enter');
  const doubts = place.getByRole('list', { name: 'What to know about this layout' });
  await doubts.getByText('tray.holes.width: seeds cannot pass.').waitFor();
  const [bottom, top] = [await doubts.boundingBox(), await place.locator('canvas').boundingBox()].map((box, k) => box.y + (k === 0 ? box.height : 0));
  assert.ok(bottom <= top, `${bottom} ${top}`);
  await width.fill('12');
  await width.press('Enter');
  await doubts.waitFor({ state: 'hidden' });
}));

// What of `selectors`, inside the bench, is not wholly in the window, which has not been scrolled; each has to be there.
function outside(page, selectors) {
  return page.evaluate((all) => all.flatMap((selector) => {
    const found = [...document.querySelectorAll(`.bench ${selector}`)];
    const isIn = ({ left, top, right, bottom, width }) => width > 0 && left >= 0 && top >= 0 && right <= innerWidth && bottom <= innerHeight;
    return found.length ? found.filter((one) => !isIn(one.getBoundingClientRect())).map((one) => one.outerHTML.slice(0, 90)) : [`nothing is ${selector}`];
  }), selectors);
}

// With a doubt as long as that of a draft.
function withDoubt() {
  const data = madeUpStudio();
  data.seeders[0].scene.made_up_remarks = [{
    serious: true,
    text: 'the relative overlap passed 0.05 at 0.1574 s, in 1143 steps in all, and reached 0.0884: a thin shell is no longer a good model; a smaller '
      + 'contact.shell_compression is stiffer',
    what_to_do: 'make contacts stiffer or steps shorter, as it says, and run again',
  }];
  data.crops[1].title = 'Soybean, of a title so long that a list of crops is wider than all of the other choices beside it';
  return data;
}

test('bed, controls and rates are on one screen', () => withStudio({ viewport: { width: 1280, height: 720 } }, async (page) => {
  const place = bench(page);
  await place.getByText('The holes differ').waitFor();
  assert.deepEqual(await outside(page, ['canvas', '.knob', 'select', '.controls button', '.panel input', '.panel button', '.hole-bars li', '.figures dd']), []);
  assert.equal(await place.getByRole('spinbutton').count(), 15);
  assert.equal(await place.getByRole('radio', { name: 'Motion' }).isVisible(), false);
}, withDoubt()));

test('on a phone the bed stays beside each panel, a tap away', () => withStudio({ viewport: { width: 390, height: 844 } }, async (page) => {
  const place = bench(page);
  await place.getByText('The holes differ').waitFor();
  for (const [tab, inIt] of [['Holes', ['.holes input', '.holes button']], ['Motion', ['.motion input']], ['View', ['.looks input', '.looks button']], ['Rates', ['.hole-bars li', '.figures div:first-child']]]) {
    await place.getByRole('radio', { name: tab }).check();
    assert.equal(await place.locator('.panel').filter({ visible: true }).count(), 1);
    assert.deepEqual(await outside(page, ['canvas', '.knob', '.controls button', ...inIt]), []);
  }
}, withDoubt()));

test('the picture has the tray’s dimensions, a scale bar, a ruler, and the ends of the shake', () => withStudio({}, async (page) => {
  const place = bench(page);
  await place.locator('.measures .dimension', { hasText: '120 mm' }).waitFor();
  assert.deepEqual(await place.locator('.ruler text').allTextContents(), ['0', '100', '200', '300', '400', '500 mm']);
  const scale = await page.evaluate(() => document.querySelector('.rail').clientWidth / 500);
  const width = (selector) => place.locator(selector).evaluate((node) => node.getBBox().width);
  const [bar, said] = [await width('.scale-bar path'), parseFloat(await place.locator('.scale-bar text').textContent())];
  assert.ok(Math.abs(bar - said * scale) < 1, `${bar} px for ${said} mm at ${scale}`);
  // In one look, since each frame draws them anew.
  const endsAreApart = (mm) => page.waitForFunction((by) => {
    const [left, right] = [...document.querySelectorAll('.shake-end')].map((end) => end.getBBox().x);
    return Math.abs(right - left - by * document.querySelector('.rail').clientWidth / 500) < 1;
  }, mm);
  await endsAreApart(20);
  assert.equal(await place.locator('.shake text').textContent(), '9 Hz, ±10 mm');
  const amplitude = place.getByRole('spinbutton', { name: 'Amplitude in mm' });
  await amplitude.fill('15');
  await amplitude.press('Enter');
  assert.equal(await place.locator('.shake text').textContent(), '9 Hz, ±15 mm');
  await endsAreApart(30);
  await place.getByRole('checkbox', { name: 'Hold the tray still' }).check();
  assert.equal(await place.locator('.shake').count(), 0);
}));

test('a hole is dragged, and the simulation starts again with it', () => withStudio({}, async (page) => {
  const place = bench(page);
  const before = await countsAtTheEnd(place);
  await page.locator('.rail').scrollIntoViewIfNeeded();
  const box = await handle(place, 2).boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height - 20];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 15, y, { steps: 3 });
  await page.mouse.move(x + 30, y, { steps: 3 });
  await status(place, 'changed');
  await page.waitForTimeout(400);  // held still for longer than a gesture takes to settle
  await status(place, 'changed');
  await page.mouse.up();
  await opened(place);
  const scale = await page.evaluate(() => document.querySelector('.rail').clientWidth / 500);
  const mm = Math.round(160 + 30 / scale);
  assert.equal(await valueText(place, 2), `hole 2 at ${mm} mm, 12 mm wide`);
  assert.equal(await place.getByRole('spinbutton', { name: 'Place of hole 2 in mm' }).inputValue(), String(mm));
  await status(place, 'ended');  // as fast as it can, as before
  assert.notEqual(await place.locator('canvas').getAttribute('data-counts'), before);
}));

test('holes and shake change while it runs: clock and picture go on, rates begin anew', () => withStudio({}, async (page) => {
  const place = bench(page);
  await page.waitForFunction(() => Number(document.querySelector('canvas').dataset.time) > 0.6);
  const seen = await page.evaluateHandle(() => {
    const canvas = document.querySelector('canvas'), times = [];
    new MutationObserver(() => times.push(Number(canvas.dataset.time))).observe(canvas, { attributeFilter: ['data-time'] });
    return times;
  });
  const frequency = place.getByRole('spinbutton', { name: 'Frequency in Hz' });
  await frequency.fill('12');
  await frequency.press('Enter');
  const words = place.getByText(/^Changed at /);
  await words.waitFor();
  const [since, from] = /^Changed at ([0-9.]+) s\. Measuring begins at ([0-9.]+) s\.$/.exec(await words.textContent()).slice(1).map(Number);
  assert.ok(since > 0.6 && Math.abs(from - since - 1) < 0.02, `${since} ${from}`);
  await page.waitForFunction((then) => Number(document.querySelector('canvas').dataset.time) > then, since + 0.2);
  await handle(place, 2).press('Shift+ArrowRight');
  await page.waitForFunction((then) => Number(/^Changed at ([0-9.]+) s/.exec(document.querySelector('.panel-head .hint').textContent)?.[1]) > then, since + 0.1);
  await place.getByText(/^Measured from/).waitFor({ state: 'detached' });
  const times = await seen.jsonValue();
  assert.ok(times.every((time, k) => k === 0 || time >= times[k - 1]), JSON.stringify(times));
  assert.ok(!(await place.getByText(/Starts again/).count()));
}));

test('a run follows a slider, and a hole, that is still held', () => withStudio({}, async (page) => {
  const place = bench(page);
  await page.waitForFunction(() => Number(document.querySelector('canvas').dataset.time) > 0.5);
  const changedAfter = (then) => page.waitForFunction((time) => Number(/^Changed at ([0-9.]+) s/.exec(document.querySelector('.panel-head .hint').textContent)?.[1]) > time, then);
  const held = async (target, x, y) => {
    const time = Number(await place.locator('canvas').getAttribute('data-time'));
    await target.scrollIntoViewIfNeeded();
    const box = await target.boundingBox();
    await page.mouse.move(box.x + x(box.width), box.y + y(box.height));
    await page.mouse.down();
    await page.mouse.move(box.x + x(box.width) + 12, box.y + y(box.height), { steps: 3 });
    await changedAfter(time);
    await page.mouse.up();
    await status(place, 'playing');
  };
  await held(place.getByRole('slider', { name: 'Frequency, Hz' }), (width) => width / 2, (height) => height / 2);
  await held(handle(place, 2), (width) => width / 2, (height) => height - 20);
  assert.ok(!(await place.getByText(/Starts again/).count()));
}));

// However slow the machine: no time that is shown is missed. Call what is given to wait until a time is less than one before.
async function restarts(page) {
  await page.evaluate(() => {
    const canvas = document.querySelector('canvas');
    let last = 0;
    window.restarts = 0;
    new MutationObserver(() => {
      if (Number(canvas.dataset.time) < last) ++window.restarts;
      last = Number(canvas.dataset.time);
    }).observe(canvas, { attributeFilter: ['data-time'] });
  });
  let waited = 0;
  return () => page.waitForFunction((most) => window.restarts > most, waited++);
}

test('where a run cannot go on it says that it starts again, and why', () => withStudio({}, async (page) => {
  const place = bench(page);
  await page.waitForFunction(() => Number(document.querySelector('canvas').dataset.time) > 0.5);
  const startsAgain = await restarts(page);
  await place.getByRole('button', { name: 'Remove hole 5' }).click();
  const says = (words) => place.locator('.speed', { hasText: words }).waitFor();
  await says('Starts again: more or fewer holes');
  await startsAgain();
  await handle(place, 4).press('End');  // further than it finds room
  await says('Waits: seeds are in the way');
  await says('Starts again: seeds stay in the way of a hole');
  await startsAgain();
  await says(/real time/i);  // once that has been said for long enough
}));

test('a press on a handle that does not move it changes nothing', () => withStudio({}, async (page) => {
  const place = bench(page);
  await countsAtTheEnd(place);
  await handle(place, 3).click();
  await page.waitForTimeout(300);
  await status(place, 'ended');
}));

test('keys move, widen and remove a hole, and a button adds one', () => withStudio({}, async (page) => {
  const place = bench(page);
  await handle(place, 2).focus();
  for (const [key, text] of [
    ['ArrowRight', 'hole 2 at 161 mm, 12 mm wide'], ['Shift+ArrowRight', 'hole 2 at 171 mm, 12 mm wide'], ['ArrowLeft', 'hole 2 at 170 mm, 12 mm wide'],
    ['+', 'hole 2 at 170 mm, 12.5 mm wide'], ['-', 'hole 2 at 170 mm, 12 mm wide'], ['-', 'hole 2 at 170 mm, 11.5 mm wide'], ['End', 'hole 2 at 237.2 mm, 11.5 mm wide'],
  ]) {
    await page.keyboard.press(key);
    assert.equal(await valueText(place, 2), text);
  }
  await page.keyboard.press('Delete');
  assert.equal(await place.locator('.handle').count(), 4);
  assert.equal(await page.evaluate(() => document.activeElement.getAttribute('aria-valuetext')), 'hole 2 at 250 mm, 12 mm wide');
  await place.getByRole('button', { name: 'Add a hole' }).click();
  assert.equal(await page.evaluate(() => document.activeElement.getAttribute('aria-valuetext')), 'hole 2 at 160 mm, 12 mm wide');
  await place.getByRole('button', { name: 'Remove hole 5' }).click();
  assert.equal(await place.locator('.handle').count(), 4);
  assert.equal(JSON.parse(await countsAtTheEnd(place)).length, 4);
}));

test('numbers are entered, and what is too much is held back', () => withStudio({}, async (page) => {
  const place = bench(page);
  const enter = async (name, value) => {
    const field = place.getByRole('spinbutton', { name });
    await field.fill(value);
    await field.press('Enter');
    return field.inputValue();
  };
  assert.equal(await enter('Place of hole 1 in mm', '65.5'), '65.5');
  assert.equal(await enter('Place of hole 1 in mm', '400'), '147');
  assert.equal(await enter('Width of hole 5 in mm', '400'), '140');
  assert.equal(await place.getByRole('spinbutton', { name: 'Width of all in mm' }).getAttribute('placeholder'), 'various');
  assert.equal(await enter('Width of all in mm', '11'), '11');
  assert.equal(await enter('Number of holes', '3'), '3');
  assert.equal(await enter('Frequency in Hz', '11.5'), '11.5');
  assert.equal(await enter('Amplitude in mm', '99'), '30');
  const slider = place.getByRole('slider', { name: 'Direction, °' });
  await slider.focus();
  await slider.press('ArrowRight');
  assert.equal(await place.getByRole('spinbutton', { name: 'Direction in °' }).inputValue(), '1');
  assert.deepEqual(await Promise.all([1, 2, 3].map((k) => valueText(place, k))), ['hole 1 at 147 mm, 11 mm wide', 'hole 2 at 288.5 mm, 11 mm wide', 'hole 3 at 430 mm, 11 mm wide']);
}));

test('what the program refuses is said, and mended by a change', () => withStudio({}, async (page) => {
  const place = bench(page);
  const width = place.getByRole('spinbutton', { name: 'Width of hole 1 in mm' });
  await width.fill('70');
  await width.press('Enter');
  await place.getByRole('alert').filter({ hasText: 'as wide as this made-up simulator goes.' }).waitFor();
  assert.ok(await place.getByRole('button', { name: 'Play' }).isDisabled());
  await width.fill('12');
  await width.press('Enter');
  await opened(place);
  await place.getByRole('alert').waitFor({ state: 'hidden' });
}));

// What is on the page of a simulation: ink in the picture, counts, clock, bars, lots, handles that can be seen.
function shownOf(place) {
  return place.evaluate((frame) => {
    const canvas = frame.querySelector('canvas');
    const blank = Object.assign(document.createElement('canvas'), { width: canvas.width, height: canvas.height });
    return {
      ink: canvas.toDataURL() !== blank.toDataURL(), counts: canvas.dataset.counts ?? '', said: canvas.getAttribute('aria-label'), clock: frame.querySelector('.clock').textContent,
      part: frame.querySelector('progress').value, bars: frame.querySelectorAll('.hole-bars li').length, outflow: frame.querySelector('.outflow').innerText.trim(),
      legend: frame.querySelector('.legend').textContent, handles: [...frame.querySelectorAll('.handle')].filter((one) => one.checkVisibility()).length,
    };
  });
}

test('of a seeder that cannot be simulated nothing is shown, least of all another one’s seeds', () => {
  const data = structuredClone(madeUpStudio());
  data.seeders[1].scene.tray.holes[0].width_m = 0.07;
  return withStudio({}, async (page) => {
    const place = bench(page);
    await countsAtTheEnd(place);
    const before = await shownOf(place);
    assert.ok(before.ink && before.bars === 6 && before.clock === '4.00 s of 4 s' && before.handles === 5);
    await place.getByRole('combobox', { name: 'Seeder' }).selectOption('Two lots that rock');
    await status(place, 'failed');
    assert.deepEqual(await shownOf(place), { ink: false, counts: '', said: 'The tray', clock: '', part: 0, bars: 0, outflow: 'Outflow', legend: '', handles: 0 });
    await page.getByRole('button', { name: 'Dark' }).click();  // draws anew
    assert.equal((await shownOf(place)).ink, false);
    await place.getByRole('combobox', { name: 'Seeder' }).selectOption('Wheat tray, five holes, fed from a hopper');
    await opened(place);
    assert.equal((await shownOf(place)).handles, 5);
  }, data);
});

test('another seeder brings its own controls, another crop its seeds', () => withStudio({}, async (page) => {
  const place = bench(page);
  await place.getByRole('combobox', { name: 'Crop' }).selectOption('Soybean');
  await place.getByText('140 seeds in the tray instead of 560').waitFor();
  await place.locator('.legend', { hasText: 'soybean' }).waitFor();
  await place.getByRole('radio', { name: 'Draft' }).check();
  await place.getByText('Draft: softer seeds').waitFor();
  await place.getByRole('combobox', { name: 'Seeder' }).selectOption('Two lots that rock');
  assert.equal(await place.getByRole('slider', { name: 'Frequency, Hz' }).count(), 0);
  assert.equal(await place.getByRole('combobox', { name: 'Crop' }).locator('option:checked').textContent(), 'its own seeds');
  await place.locator('.legend', { hasText: 'stone' }).waitFor();
  assert.equal(await place.locator('.handle').count(), 2);
}));

test('seeders in space are listed with what keeps them from running', () => withStudio({}, async (page) => {
  const options = bench(page).getByRole('combobox', { name: 'Seeder' }).locator('optgroup');
  assert.deepEqual(await options.evaluateAll((groups) => groups.map((group) => [group.label, group.disabled])), [['In 3D: shown as recorded runs', true]]);
  await page.getByText('Seeders that are not simulated here').click();
  await page.getByText(whyNot3d).waitFor();
}));

test('a program that opens a seeder in space is told so', () => withStudio({}, async (page) => {
  assert.match(await page.locator('#head [role=alert]').textContent(), /^Wheat tray in space is not simulated in this page\. A tray in space takes/);
}, { ...madeUpStudio(), opened: 'wheat-tray-3d' }));

test('two layouts are compared, and a link brings both back with their counts', () => withStudio({}, async (page) => {
  await handle(bench(page), 1).press('Shift+ArrowLeft');
  await page.getByRole('button', { name: 'Compare layouts' }).click();
  const [a, b] = [bench(page, 'A'), bench(page, 'B')];
  assert.equal(await valueText(b, 1), 'hole 1 at 60 mm, 12 mm wide');
  await handle(b, 3).press('+');
  await b.getByRole('combobox', { name: 'Crop' }).selectOption('Soybean');
  await a.getByRole('button', { name: 'Restart' }).click();
  const counts = [await countsAtTheEnd(a), await countsAtTheEnd(b)];
  assert.notEqual(counts[0], counts[1]);
  await page.getByText(/^B lets out .* as A|than A, .* its holes differ/).waitFor();
  assert.equal(await page.locator('#comparison tbody tr').count(), 3);
  const address = page.url();
  await page.getByRole('button', { name: 'Share a link' }).click();
  await page.waitForFunction(() => document.querySelector('.link-field').value !== '');
  const link = await page.getByRole('textbox', { name: 'Link to what is on this page' }).inputValue();
  assert.match(link, /#s=[A-Za-z0-9_-]+$/);
  assert.notEqual(page.url(), address);
  await page.goto('about:blank');
  await page.goto(link);
  await page.waitForSelector('html[data-ready]');
  assert.deepEqual([await countsAtTheEnd(a), await countsAtTheEnd(b)], counts);
  assert.equal(await valueText(b, 3), 'hole 3 at 250 mm, 12.5 mm wide');
  await handle(b, 3).press('-');
  await page.getByRole('textbox', { name: 'Link to what is on this page' }).waitFor({ state: 'hidden' });
  await page.getByRole('button', { name: 'Remove layout B' }).click();
  assert.equal(await b.count(), 0);
  await page.locator('#comparison').waitFor({ state: 'hidden' });
}));

const withKept = (page) => page.waitForFunction(() => localStorage.length > 0);

test('what was made is undone, done again, there after a reload, and reset', () => withStudio({}, async (page) => {
  const place = bench(page);
  const press = (name) => page.getByRole('button', { name, exact: true }).click();
  const isDisabled = (name) => page.getByRole('button', { name, exact: true }).isDisabled();
  assert.deepEqual(await Promise.all(['Undo', 'Redo', 'Reset'].map(isDisabled)), [true, true, true]);
  await handle(place, 2).press('Shift+ArrowRight');
  await place.getByRole('spinbutton', { name: 'Frequency in Hz' }).fill('11');
  await place.getByRole('spinbutton', { name: 'Frequency in Hz' }).press('Enter');
  const made = async () => [await valueText(place, 2), await place.getByRole('spinbutton', { name: 'Frequency in Hz' }).inputValue()];
  await press('Undo');
  assert.deepEqual(await made(), ['hole 2 at 170 mm, 12 mm wide', '9']);
  await handle(place, 2).press('Control+z');
  assert.deepEqual(await made(), ['hole 2 at 160 mm, 12 mm wide', '9']);
  await press('Redo');
  await handle(place, 2).press('Control+Shift+Z');
  assert.deepEqual(await made(), ['hole 2 at 170 mm, 12 mm wide', '11']);
  await withKept(page);
  await page.reload();
  await page.waitForSelector('html[data-ready]');
  await page.getByText('These are the layouts that you left here').waitFor();
  assert.deepEqual(await made(), ['hole 2 at 170 mm, 12 mm wide', '11']);
  await press('Reset');
  assert.deepEqual(await made(), ['hole 2 at 160 mm, 12 mm wide', '9']);
  assert.equal(await isDisabled('Reset'), true);
  await press('Undo');
  assert.deepEqual(await made(), ['hole 2 at 170 mm, 12 mm wide', '11']);
}));

test('a change takes the link’s layouts out of the address, and is there after a reload instead of them', async () => {
  await withStudio({ hash: await fragmentOf([moveHole(layoutOf(madeUpStudio().seeders[0]), 1, 200)]) }, async (page) => {
    const place = bench(page);
    assert.equal(await valueText(place, 2), 'hole 2 at 200 mm, 12 mm wide');
    await page.getByRole('button', { name: 'Share a link' }).click();
    await handle(place, 2).press('ArrowRight');
    await page.getByRole('textbox', { name: 'Link to what is on this page' }).waitFor({ state: 'hidden' });
    assert.doesNotMatch(page.url(), /#/);
    await withKept(page);
    await page.reload();
    await page.waitForSelector('html[data-ready]');
    assert.equal(await valueText(place, 2), 'hole 2 at 201 mm, 12 mm wide');
  });
});

test('a browser that keeps nothing is said to, and all else works', () => withStudio({
  first: () => Object.defineProperty(window, 'localStorage', { get() { throw new DOMException('denied', 'SecurityError'); } }),
}, async (page) => {
  const place = bench(page);
  assert.equal(await page.locator('#head [role=alert]').isVisible(), false);
  await handle(place, 2).press('ArrowRight');
  await page.getByText('This browser keeps nothing for this page').waitFor();
  await page.getByRole('button', { name: 'Undo' }).click();
  assert.equal(await valueText(place, 2), 'hole 2 at 160 mm, 12 mm wide');
  await opened(place);
}));

test('sent as one file, it opens by itself with what was on the page, to the same counts', () => withStudio({}, async (page) => {
  await handle(bench(page), 2).press('Shift+ArrowRight');
  await page.getByRole('button', { name: 'Compare layouts' }).click();
  await handle(bench(page, 'B'), 1).press('+');
  await page.getByRole('button', { name: 'Dark' }).click();
  const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'Send as one file' }).click()]);
  assert.equal(download.suggestedFilename(), 'studio.html');
  const sent = path.join(folder, 'elsewhere', 'got this.html');
  await download.saveAs(sent);
  const text = readFileSync(sent, 'utf8');
  assert.equal(/<script>[\s\S]*<\/script>/.exec(text)[0], /<script>[\s\S]*<\/script>/.exec(template)[0]);  // which its policy lets run
  assert.match(text, /^<!doctype html>\n<html lang="en"><head>/);  // light or dark is for them to choose
  await bench(page).getByRole('button', { name: 'Restart' }).click();
  const counts = await countsAtTheEnd(bench(page));
  const theirs = await in_.openPage(browser, sent);
  assert.deepEqual([await valueText(bench(theirs), 2), await valueText(bench(theirs, 'B'), 1)], ['hole 2 at 170 mm, 12 mm wide', 'hole 1 at 70 mm, 12.5 mm wide']);
  assert.equal(await countsAtTheEnd(bench(theirs)), counts);
  await handle(bench(theirs), 2).press('ArrowRight');  // what they make is kept for them
  await withKept(theirs);
  await theirs.reload();
  await theirs.waitForSelector('html[data-ready]');
  assert.equal(await valueText(bench(theirs), 2), 'hole 2 at 171 mm, 12 mm wide');
  assert.deepEqual(theirs.complaints, []);
  await theirs.context().close();
}));

test('a wanted rate is told in seeds a second with its doubt, and kept', () => withStudio({}, async (page) => {
  const place = bench(page);
  assert.equal(await place.getByText('Wanted').count(), 0);
  await page.getByRole('button', { name: 'Wanted rate' }).click();
  await place.getByText('203 seeds/s of the tray').waitFor();
  await place.getByText(/Doubtful: in 2D a hole is a slot/).waitFor();
  const rows = page.getByRole('spinbutton', { name: 'Rows that the tray feeds' });
  await rows.fill('3');
  await rows.press('Enter');
  await place.getByText('608 seeds/s of the tray').waitFor();
  await page.getByRole('button', { name: 'Compare layouts' }).click();
  await bench(page, 'B').getByText('608 seeds/s of the tray').waitFor({ state: 'attached' });
  await page.reload();
  await page.waitForSelector('html[data-ready]');
  await place.getByText('608 seeds/s of the tray').waitFor({ state: 'attached' });
  await page.getByRole('button', { name: 'Wanted rate' }).click();
  assert.equal(await rows.isVisible(), false);
  await place.getByText('608 seeds/s of the tray').waitFor({ state: 'detached' });
}));

test('two layouts run in step, and start and rest together', () => withStudio({ viewport: { width: 1280, height: 720 } }, async (page) => {
  await page.getByRole('button', { name: 'Compare layouts' }).click();
  const [a, b] = [bench(page, 'A'), bench(page, 'B')];
  await b.getByRole('radio', { name: 'Design' }).check();  // which this made-up simulator takes four times as long for
  await page.waitForFunction(() => document.querySelectorAll('.bench[data-status="playing"]').length === 2 && [...document.querySelectorAll('canvas')].every((canvas) => Number(canvas.dataset.time) > 0.05));
  const apart = await page.evaluate(() => new Promise((done) => {
    const gaps = [];
    const look = () => {
      const [one, other] = [...document.querySelectorAll('.bench canvas')].map((canvas) => Number(canvas.dataset.time));
      gaps.push(Math.abs(one - other));
      if (gaps.length < 30) requestAnimationFrame(look);
      else done(Math.max(...gaps));
    };
    look();
  }));
  assert.ok(apart < 0.08, `${apart} s`);
  await a.getByRole('button', { name: 'Pause' }).click();
  await status(a, 'paused');
  await status(b, 'paused');
  assert.deepEqual(await outside(page, ['canvas', '.knob', '.controls button', '.tabs label']), []);
  await b.getByRole('button', { name: 'Play' }).click();
  await status(a, 'playing');
  await page.waitForFunction(() => [...document.querySelectorAll('canvas')].every((canvas) => Number(canvas.dataset.time) > 0.5));
  await handle(a, 2).press('ArrowRight');
  await a.getByText(/^Changed at /).waitFor();
  await page.waitForFunction(() => [...document.querySelectorAll('canvas')].every((canvas) => Number(canvas.dataset.time) > 0.5));
  assert.equal(await b.getByText(/^Changed at /).count(), 0);
  await handle(a, 5).press('Delete');
  await page.waitForFunction(() => [...document.querySelectorAll('canvas')].every((canvas) => Number(canvas.dataset.time) < 0.4));
  await page.getByRole('button', { name: 'Remove layout B' }).click();
  await status(a, 'ended');
}));

// A link as a page makes it that has `seeder` as its own.
async function linkTo(seeder) {
  return fragmentOf([layoutOf({ ...seeder, own: true })]);
}

test('a link’s own seeder bears its own name', async () => {
  const theirs = { ...structuredClone(madeUpStudio().seeders[1]), name: 'wheat-tray', title: 'A tray of theirs' };
  const chosen = (page) => bench(page).getByRole('combobox', { name: 'Seeder' }).locator('option:checked').textContent();
  await withStudio({ hash: await linkTo(theirs) }, async (page) => {
    assert.equal(await chosen(page), 'A tray of theirs');
    await bench(page).locator('.legend', { hasText: 'stone' }).waitFor();
    await bench(page).getByRole('combobox', { name: 'Seeder' }).selectOption('Wheat tray, five holes, fed from a hopper');
    await bench(page).locator('.legend', { hasText: 'wheat' }).waitFor();
    await bench(page).getByRole('combobox', { name: 'Seeder' }).selectOption('A tray of theirs');  // it is still to be had
    assert.equal(await chosen(page), 'A tray of theirs');
  });
});

test('a link out of a file says that it opens where that file is', () => withStudio({}, async (page) => {
  await page.getByRole('button', { name: 'Share a link' }).click();
  const said = page.locator('.share [role=status]');
  await said.filter({ hasText: /./ }).waitFor();
  assert.match(await said.textContent(), /It leads to this file on this computer: whoever else is to open it needs the file studio\.html too, and puts what follows # in the link after its address\.$/);
}));

test('the seeder file is saved with what was changed', () => withStudio({}, async (page) => {
  await handle(bench(page), 2).press('Shift+ArrowRight');
  const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'Save the seeder file' }).click()]);
  assert.equal(download.suggestedFilename(), 'wheat-tray.toml');
  const text = readFileSync(await download.path(), 'utf8');
  assert.match(text, /^# From the studio: the seeder wheat-tray/);
  assert.deepEqual(parse(text).tray.holes.at, ['70 mm', '170 mm', '250 mm', '340 mm', '430 mm']);
}));

test('hostile names stay text', () => withStudio({}, async (page) => {
  await page.locator('.legend', { hasText: hostile }).waitFor();
  assert.equal(await bench(page).getByRole('combobox', { name: 'Seeder' }).locator('option:checked').textContent(), hostile);
  assert.equal(await page.locator('img').count(), 0);
}, madeUpStudio({ title: hostile, lot: hostile })));

for (const [what, hash, said] of [
  ['is no link', '#s=<img src=x onerror=alert(1)>', /cut off or changed/],
  ['holds something unknown', `#s=${deflateRawSync(JSON.stringify({ layouts: [], [hostile]: 1 })).toString('base64url')}`, /something unknown about the page/],
  ['unpacks without end', `#s=${deflateRawSync(Buffer.alloc(2e7)).toString('base64url')}`, /more than 256 KB/],
]) {
  test(`a link that ${what} does nothing but be said`, () => withStudio({ hash }, async (page) => {
    assert.match(await page.locator('#head [role=alert]').textContent(), said);
    assert.equal(await page.locator('img').count(), 0);
    await opened(bench(page));
    assert.equal(await valueText(bench(page), 2), 'hole 2 at 160 mm, 12 mm wide');
  }));
}

test('who wants little motion starts it by hand', () => withStudio({ reducedMotion: 'reduce' }, async (page) => {
  await status(bench(page), 'ready');
  await bench(page).getByRole('button', { name: 'Play' }).click();
  await status(bench(page), 'playing', 'ended');
}));

test('accessible in light and dark, and no wider than a phone', () => withStudio({ bypass: true }, async (page) => {
  await bench(page).getByText('The holes differ').waitFor();
  await in_.assertAccessible(page);
  await page.emulateMedia({ colorScheme: 'dark' });
  await page.waitForSelector('html[data-theme="dark"]');
  await page.setViewportSize({ width: 390, height: 844 });
  await page.getByRole('button', { name: 'Compare layouts' }).click();
  await page.getByRole('button', { name: 'Share a link' }).click();
  await bench(page, 'B').getByText('The holes differ').waitFor();
  await in_.assertAccessible(page);
  await in_.assertNoSidewaysScrolling(page);
}));

// The studio and the program itself: VIBROSOW=path node --test tests/web/studio_program.test.mjs
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import test from 'node:test';
import { fileURLToPath } from 'node:url';
import * as layouts from '../../web/studio/layout.mjs';
import { degreesOf, mmOf } from '../../web/studio/quantities.mjs';
import { sceneOf } from '../../web/studio/scene_edit.mjs';
import { seederFile } from '../../web/studio/seeder_file.mjs';
import * as in_ from './browser.mjs';

const program = process.env.VIBROSOW;

function whyNot(command, option) {
  if (!program) return 'VIBROSOW names no program';
  try {
    const help = execFileSync(program, [command, '--help'], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] });
    return help.includes(option) ? false : `${program} ${command} has no ${option}`;
  } catch {
    return `${program} has no command ${command}`;
  }
}

async function inFolder(act) {
  const folder = mkdtempSync(path.join(tmpdir(), 'vibrosow-studio-'));
  try {
    await act(folder);
  } finally {
    rmSync(folder, { recursive: true });
  }
}

function shipped(name) {
  return readFileSync(fileURLToPath(new URL(`../../seeders/${name}.toml`, import.meta.url)), 'utf8');
}

// The scene that the program makes of a seeder file; of a run so short that nothing happens in it.
function sceneOfFile(folder, text) {
  const file = path.join(folder, 'seeder.toml');
  writeFileSync(file, text);
  execFileSync(program, ['run', file, '--set', 'run.duration=1 ms', '--set', 'run.measure_from=0 s', '--html', '--quiet', '--out', path.join(folder, 'out')], { stdio: ['ignore', 'ignore', 'ignore'] });
  const html = readFileSync(path.join(folder, 'out', 'report.html'), 'utf8');
  return JSON.parse(/<script id="report-data" type="application\/json">(.*?)<\/script>/s.exec(html)[1]).scene;
}

for (const name of ['wheat-tray', 'pea-tray', 'soybean-tray']) {
  test(`a file saved of ${name} is read as the scene that the page simulates`, { skip: whyNot('run', '--html') }, () => inFolder((folder) => {
    const toml = shipped(name);
    const seeder = { name, title: name, toml, crop: '', scene: sceneOfFile(folder, toml) };
    const own = layouts.layoutOf(seeder);
    const edits = [
      own, layouts.moveHole(own, 1, mmOf(own.holes[1].centre_m) + 7.3), layouts.widenHole(own, 0, 17.9), layouts.removeHole(own, 0), layouts.addHole(own).layout,
      layouts.withMotion(own, { frequency_hz: 8.7, amplitude_mm: 7.3, direction_degree: 17.3 }), layouts.widenAll(layouts.spreadHoles(own, 2), 16.1),
    ];
    for (const layout of edits) assert.deepEqual(sceneOfFile(folder, seederFile(layout, [])), sceneOf(layout, []));
  }));
}

// The program's own number of every tenth, in one file: places of holes in a long tray, and where arcs over it begin.
test('tenths of a millimetre and of a degree are read to the last bit', { skip: whyNot('run', '--html') }, () => inFolder((folder) => {
  const seeder = { name: 'tenths', title: '', toml: shipped('wheat-tray'), crop: '' };
  const tenths = Array.from({ length: 400 }, (_, k) => 30 + 3.7 * k);
  const text = seeder.toml.replace('"50 cm"', '"2 m"').replace('count = 5\n', '').replace('"12 mm"', '"1 mm"').replace('span  = "36 cm"', `at = [${tenths.map((mm) => `"${mm.toFixed(1)} mm"`).join(', ')}]`);
  const read = sceneOfFile(folder, text).tray.holes.map((hole) => hole.centre_m);
  assert.deepEqual(read, tenths.map((mm) => Number(mm.toFixed(1)) / 1000));
  for (const degree of [-37.3, 0.7, 17.3, 45.9]) {
    const { direction_rad: radians } = sceneOfFile(folder, seeder.toml.replace('"0 degree"', `"${degree} degree"`)).tray.motion;
    assert.equal(radians, degree * (Math.PI / 180));
    assert.equal(degreesOf(radians), degree);
  }
}));

// Seeds of each hole in outflow.csv of a run: [hole 1, hole 2, ..].
function countsOf(file, holes) {
  const counts = Array(holes).fill(0);
  const [head, ...rows] = readFileSync(file, 'utf8').trim().split('\n').map((line) => line.split(','));
  for (const row of rows) {
    const hole = Number(row[head.indexOf('hole')]);
    if (hole > 0) ++counts[hole - 1];
  }
  return counts;
}

async function countsAtTheEnd(page) {
  const bench = page.locator('.bench');
  await bench.and(page.locator(['ready', 'playing', 'paused', 'ended'].map((status) => `[data-status="${status}"]`).join(','))).waitFor();
  await page.getByRole('button', { name: 'To the end' }).evaluate((button) => button.click());
  await bench.and(page.locator('[data-status="ended"]')).waitFor();
  return bench.locator('canvas').evaluate((canvas) => new Promise((painted) => {
    requestAnimationFrame(() => requestAnimationFrame(() => painted(JSON.parse(canvas.dataset.counts))));
  }));
}

test('every seeder that is offered as live plays', { skip: whyNot('studio', '--out') }, () => inFolder(async (folder) => {
  execFileSync(program, ['studio', '--out', folder]);
  const browser = await in_.startBrowser();
  try {
    const page = await in_.openPage(browser, path.join(folder, 'studio.html'));
    const list = page.getByRole('combobox', { name: 'Seeder' });
    const offered = await list.locator('> option').evaluateAll((options) => options.map(({ value }) => value));
    assert.ok(offered.length > 8);
    const bench = page.locator('.bench');
    for (const value of offered) {
      await list.selectOption(value);
      const ends = ['playing', 'ended', 'failed'].map((status) => `[data-status="${status}"]`).join(',');
      await page.waitForFunction(() => ['changed', 'opening'].includes(document.querySelector('.bench').dataset.status));
      await bench.and(page.locator(ends)).waitFor();
      assert.equal(await bench.locator('> .doubt').textContent(), '', await list.locator('option:checked').textContent());
    }
    assert.deepEqual(page.complaints, []);
  } finally {
    await browser.close();
  }
}));

test('a layout made in the page, saved and run by the program, lets out the same seeds', { skip: whyNot('studio', '--out') }, () => inFolder(async (folder) => {
  execFileSync(program, ['studio', 'wheat-tray', '--out', folder]);
  const browser = await in_.startBrowser();
  try {
    const page = await in_.openPage(browser, path.join(folder, 'studio.html'));
    await page.getByRole('radio', { name: 'Draft' }).check();
    const untouched = await countsAtTheEnd(page);
    await page.locator('.rail').scrollIntoViewIfNeeded();
    const box = await page.getByRole('slider', { name: 'Hole 2', exact: true }).boundingBox();
    const [x, y] = [box.x + box.width / 2, box.y + box.height - 20];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 40, y, { steps: 4 });
    await page.mouse.up();
    const counts = await countsAtTheEnd(page);
    assert.notDeepEqual(counts, untouched);
    const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'Save the seeder file' }).click()]);
    const saved = path.join(folder, 'saved.toml');
    await download.saveAs(saved);
    execFileSync(program, ['run', saved, '--quiet', '--out', path.join(folder, 'out')]);
    assert.deepEqual(countsOf(path.join(folder, 'out', 'outflow.csv'), counts.length), counts);
    await page.getByRole('button', { name: 'Share a link' }).click();
    await page.waitForFunction(() => document.querySelector('.link-field').value !== '');
    const link = await page.getByRole('textbox', { name: 'Link to what is on this page' }).inputValue();
    await page.goto('about:blank');
    await page.goto(link);
    await page.waitForSelector('html[data-ready]');
    assert.deepEqual(await countsAtTheEnd(page), counts);
    assert.deepEqual(page.complaints, []);
  } finally {
    await browser.close();
  }
}));

// The pages of a run and of a sweep by the program itself: VIBROSOW=path node --test tests/web/program.test.mjs
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import test from 'node:test';
import { fileURLToPath } from 'node:url';
import { list } from '../../web/report/format.mjs';
import * as in_ from './browser.mjs';

const program = process.env.VIBROSOW;

function whyNot(command) {
  if (!program) return 'VIBROSOW names no program';
  const help = execFileSync(program, [command, '--help'], { encoding: 'utf8' });
  return help.includes('--html') ? false : `${program} ${command} has no --html`;
}

// Columns of a CSV of the program, whose fields have no quotes here.
function rowsOf(file) {
  const [head, ...rows] = readFileSync(file, 'utf8').trim().split('\n').map((line) => line.split(','));
  return rows.map((row) => Object.fromEntries(head.map((name, k) => [name, row[k]])));
}

function countsOf(file) {
  const counts = new Map();
  for (const { hole } of rowsOf(file)) counts.set(hole, (counts.get(hole) ?? 0) + 1);
  return counts;
}

// Where the run ends, with its forces, and its maps.
async function forcesAndMapsAreShown(page) {
  const plain = await in_.pictureOf(page);
  await page.getByRole('radio', { name: 'Force' }).check();
  await page.getByRole('checkbox', { name: 'Force chains' }).check();
  await page.locator('#replay-forces', { hasText: /^Forces and seeds .*: [1-9]\d* contacts, [\d.]+ [mµ]?N in the mean/ }).waitFor();
  await in_.nextPicture(page, plain);
  const said = await page.locator('#map-packing figcaption').textContent();
  const densest = Number(/^Densest, ([\d.]+), /.exec(said)[1]);
  assert.ok(densest > 0.5 && densest < 0.95, said);
  assert.match(await page.locator('#map-velocity figcaption').textContent(), /^Fastest, [\d.]+ m\/s (down|up|to the (left|right)), (at holes? \d|\d)/);
  await page.getByRole('checkbox', { name: 'Force chains' }).uncheck();
  await page.getByRole('radio', { name: 'Lot' }).check();
}

test('a run of the program', { skip: whyNot('run') }, async () => {
  const out = mkdtempSync(path.join(tmpdir(), 'vibrosow-run-'));
  const browser = await in_.startBrowser();
  try {
    execFileSync(program, ['run', 'wheat-tray', '--set', 'run.duration=1 s', '--set', 'run.measure_from=0 s', '--html', '--quiet', '--out', out]);
    const file = path.join(out, 'report.html');
    const page = await in_.openPage(browser, file);
    await in_.scrubTo(page, 10);
    const early = await in_.pictureOf(page);
    await in_.scrubToEnd(page);
    assert.notEqual(await in_.pictureOf(page), early);
    const counts = await in_.shownCounts(page);
    const summary = rowsOf(path.join(out, 'summary.csv')).filter((row) => row.hole !== 'all');
    const left = countsOf(path.join(out, 'outflow.csv'));
    assert.ok(summary.length > 1);
    for (const row of summary) {
      assert.equal(counts.get(Number(row.hole)), Number(row.grains), `hole ${row.hole}`);
      assert.equal(counts.get(Number(row.hole)), left.get(row.hole) ?? 0, `hole ${row.hole}`);
    }
    assert.ok(statSync(file).size <= 5e6, `${statSync(file).size} bytes`);
    await forcesAndMapsAreShown(page);
    if (await page.locator('#rerun').count() > 0) { // where the pages were built with the simulator
      await page.getByRole('button', { name: 'Run it again' }).click();
      const all = [...counts.values()].reduce((sum, count) => sum + count, 0);
      await page.getByText(`The same ${all} seeds left by the same holes as in the file.`).waitFor();
    }
    assert.deepEqual(page.complaints, []);
    const phone = await in_.openPage(browser, file, { viewport: { width: 390, height: 844 }, colorScheme: 'dark', bypass: true });
    await in_.assertAccessible(phone);
    await in_.assertNoSidewaysScrolling(phone);
  } finally {
    await browser.close();
    rmSync(out, { recursive: true });
  }
});

// A recording in space holds some 2.5 million coordinates and the contacts of 230 000 seeds, however many seeds there are and however long they
// run. What a coordinate costs depends on how far seeds move from frame to frame. So this is a shipped seeder whose frames that budget limits, at its own
// length and motion, and only its seeds are softer, by which they move hardly otherwise and a step is three times as long.
test('a run of the program in space', { skip: whyNot('run') }, async () => {
  const out = mkdtempSync(path.join(tmpdir(), 'vibrosow-space-'));
  const browser = await in_.startBrowser();
  try {
    execFileSync(program, ['run', 'rapeseed-six-holes', '--set', 'contact.shell_compression=5e-4', '--html', '--quiet', '--out', out]);
    const file = path.join(out, 'report.html');
    assert.ok(statSync(file).size <= 7e6, `${statSync(file).size} bytes`);
    const page = await in_.openPage(browser, file, { bypass: true });
    const last = await in_.scrubToEnd(page);
    assert.ok(last < 400, `${last} frames: the budget does not limit them`);
    const recorded = await page.$eval('#recording', (script) => script.textContent.length * 3 / 4);
    assert.ok(recorded <= 4e6, `${recorded} bytes of recording`);
    const counts = await in_.shownCounts(page);
    const left = countsOf(path.join(out, 'outflow.csv'));
    for (const [hole, count] of counts) assert.equal(count, left.get(String(hole)) ?? 0, `hole ${hole}`);
    await forcesAndMapsAreShown(page);
    await in_.assertAccessible(page);
    assert.deepEqual(page.complaints, []);
  } finally {
    await browser.close();
    rmSync(out, { recursive: true });
  }
});

test('a sweep of the program', { skip: whyNot('sweep') }, async () => {
  const out = mkdtempSync(path.join(tmpdir(), 'vibrosow-sweep-'));
  const browser = await in_.startBrowser();
  try {
    const study = fileURLToPath(new URL('../../seeders/studies/wheat-demo.toml', import.meta.url));
    execFileSync(program, ['sweep', study, '--set', 'run.duration=0.4 s', '--set', 'run.measure_from=0.2 s', '--html', '--quiet', '--out', out]);
    const file = path.join(out, 'report.html');
    const layouts = rowsOf(path.join(out, 'sweep.csv'));
    const holes = rowsOf(path.join(out, 'sweep_holes.csv'));
    const most = layouts.reduce((best, row) => (Number(row.rate_g_per_s) > Number(best.rate_g_per_s) ? row : best));
    const page = await in_.openPage(browser, file, { viewport: { width: 390, height: 844 }, bypass: true });
    assert.equal(await page.locator('#ranking .ranks button').first().getAttribute('data-layout'), most.layout);
    assert.equal(await page.locator('#layouts tbody tr').count(), layouts.length);
    for (const { layout } of layouts) {
      await page.getByRole('button', { name: `Show layout ${layout}`, exact: true }).click();
      await page.getByRole('heading', { name: `Layout ${layout}`, exact: true }).waitFor();
      const own = holes.filter((row) => row.layout === layout && row.hole !== 'all');
      assert.equal(await page.locator('#layout .hole-bars .track').count(), own.length, `layout ${layout}`);
      assert.equal(await page.locator('#layout .drawing').getAttribute('aria-label'), `Layout ${layout} from the side, to scale: holes ${list(own.map((row) => row.hole))}`);
    }
    await in_.assertAccessible(page);
    await in_.assertNoSidewaysScrolling(page);
    assert.deepEqual(page.complaints, []);
  } finally {
    await browser.close();
    rmSync(out, { recursive: true });
  }
});

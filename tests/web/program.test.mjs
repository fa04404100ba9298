// The page of a run by the program itself: VIBROSOW=path node --test tests/web/program.test.mjs
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import test from 'node:test';
import * as in_ from './browser.mjs';

const program = process.env.VIBROSOW;

function whyNot() {
  if (!program) return 'VIBROSOW names no program';
  const help = execFileSync(program, ['run', '--help'], { encoding: 'utf8' });
  return help.includes('--html') ? false : `${program} run has no --html`;
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

test('a run of the program', { skip: whyNot() }, async () => {
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
    assert.deepEqual(page.complaints, []);
    const phone = await in_.openPage(browser, file, { viewport: { width: 390, height: 844 }, colorScheme: 'dark', bypass: true });
    await in_.assertAccessible(phone);
    await in_.assertNoSidewaysScrolling(phone);
  } finally {
    await browser.close();
    rmSync(out, { recursive: true });
  }
});

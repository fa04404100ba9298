#!/usr/bin/env node
// How quickly the pages open and the studio sows, in a headless Chromium on this machine, as CSV. Needs build/web (scripts/web).
//
//     node benchmarks/pages.mjs VIBROSOW > reports/performance/pages.csv
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { startBrowser } from '../tests/web/browser.mjs';

const program = process.argv[2];
if (!program) {
  console.error('usage: node benchmarks/pages.mjs VIBROSOW');
  process.exit(2);
}
const folder = mkdtempSync(path.join(tmpdir(), 'vibrosow-pages-'));
const opened = { report: '#replay-canvas[data-frame]', studio: '.bench canvas[data-time]' };
const rounds = 5;

function median(values) {
  return [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];
}

function made(name, args, file) {
  const out = path.join(folder, name);
  execFileSync(program, [...args, '--out', out], { stdio: 'ignore' });
  return path.join(out, file);
}

// Seconds from the address until the first picture stands, each time in a context of its own.
async function opening(browser, file, kind) {
  const times = [];
  for (let round = 0; round < rounds; ++round) {
    const context = await browser.newContext();
    const page = await context.newPage();
    const from = performance.now();
    await page.goto(pathToFileURL(file).href);
    await page.waitForSelector(opened[kind]);
    times.push((performance.now() - from) / 1e3);
    await context.close();
  }
  return median(times);
}

// Pictures a second, and simulated seconds a second, of the studio at an accuracy, while it sows; `pressed`: the
// button that sets its pace.
async function sowing(browser, file, accuracy, pressed) {
  const context = await browser.newContext();
  const page = await context.newPage();
  await page.goto(pathToFileURL(file).href);
  await page.getByRole('radio', { name: accuracy }).check();
  await page.locator('.bench[data-status="ready"], .bench[data-status="playing"]').waitFor();
  await page.getByRole('button', { name: pressed }).click();
  await page.locator('.bench[data-status="playing"]').waitFor();
  await page.waitForTimeout(500);
  const measured = await page.locator('.bench canvas').evaluate((canvas) => new Promise((done) => {
    const from = performance.now(), began = Number(canvas.dataset.time);
    let frames = 0, last = canvas.dataset.time;
    const look = () => {
      if (canvas.dataset.time !== last) { ++frames; last = canvas.dataset.time; }
      const passed = (performance.now() - from) / 1e3;
      if (passed < 2) requestAnimationFrame(look);
      else done({ frames: frames / passed, ratio: (Number(last) - began) / passed });
    };
    requestAnimationFrame(look);
  }));
  await context.close();
  return measured;
}

const browser = await startBrowser();
try {
  console.log('what,figure,unit');
  const row = (what, figure, unit) => console.log(`${what},${figure.toPrecision(3)},${unit}`);
  const plane = made('plane', ['run', 'wheat-tray', '--html', '--quiet'], 'report.html');
  const space = made('space', ['run', 'rapeseed-six-holes', '--html', '--quiet', '--set', 'run.duration=0.6 s'], 'report.html');
  const studio = made('studio', ['studio', 'wheat-tray'], 'studio.html');
  for (const [name, file, kind] of [['run in the plane', plane, 'report'], ['run in space of 0.6 s', space, 'report'], ['studio', studio, 'studio']]) {
    row(`size of the page of a ${name}`, statSync(file).size / 1e6, 'MB');
    row(`opening a ${name} until its first picture`, await opening(browser, file, kind), 's');
  }
  for (const accuracy of ['Draft', 'Design']) {
    for (const [pressed, pace] of [['Restart', 'at real time at most'], ['To the end', 'as fast as it can']]) {
      const { frames, ratio } = await sowing(browser, studio, accuracy, pressed);
      const what = `wheat tray sowing in the studio at ${accuracy.toLowerCase()} accuracy ${pace}`;
      row(what, ratio, 'simulated seconds a second');
      row(what, frames, 'frames/s');
    }
  }
} finally {
  await browser.close();
  rmSync(folder, { recursive: true });
}

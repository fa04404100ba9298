#!/usr/bin/env node
// What a picture of a replay in space costs, in a headless Chromium on this machine, as CSV: time of the page's script, without what the browser paints
// afterwards; time until it is painted, by WebGL in software; draw calls; bytes uploaded. Needs build/web (scripts/web).
//
//     node benchmarks/frames.mjs [BALLS] > reports/performance/frames.csv
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { openPage, scrubTo, startBrowser, template } from '../tests/web/browser.mjs';
import { betweenFrames, countGl, madeUpCrowd, playedPictures } from '../tests/web/made_up_crowd.mjs';
import { fillTemplate } from '../tests/web/made_up_run.mjs';

const balls = Number(process.argv[2] ?? 12000);
const pictures = 64;
const turns = 9;
const frames = 3, step = 60;  // s: no machine is so slow that it plays to the end

function partOf(values, part) {
  return [...values].sort((a, b) => a - b)[Math.min(values.length - 1, Math.floor(part * values.length))];
}

// Milliseconds from a press of a key until WebGL has painted it, script and all.
async function paintings(page, key) {
  const times = [];
  for (let k = 0; k < turns; ++k) {
    times.push(await page.evaluate((name) => {
      const [under, canvas] = document.querySelectorAll('.stage canvas');
      const gl = under.getContext('webgl2'), pixel = new Uint8Array(4);
      const painted = () => gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
      painted();
      const from = performance.now();
      canvas.dispatchEvent(new KeyboardEvent('keydown', { key: name, bubbles: true }));
      painted();
      return performance.now() - from;
    }, key));
  }
  return times;
}

async function measure(page) {
  await page.locator('#replay-canvas').scrollIntoViewIfNeeded();
  await page.getByRole('radio', { name: 'an eighth' }).check({ force: true });
  const played = betweenFrames(await page.evaluate(playedPictures, pictures));
  await scrubTo(page, 1);
  await page.getByRole('button', { name: 'Corner' }).click();
  const turned = await paintings(page, 'ArrowLeft'), zoomed = await paintings(page, '+');
  return { played, turned, zoomed };
}

function print({ played, turned, zoomed }) {
  console.log('what,figure,unit');
  const row = (what, figure, unit) => console.log(`${what},${Number(figure.toPrecision(3))},${unit}`);
  const of = (name, part) => partOf(played.map((picture) => picture[name]), part);
  row(`script of a picture of ${balls} balls while it plays, in the median`, of('script', 0.5), 'ms');
  row(`script of a picture of ${balls} balls while it plays, 9 of 10 below`, of('script', 0.9), 'ms');
  row(`draw calls of a picture of ${balls} balls`, of('draws', 1), '');
  row(`bytes uploaded for a picture of ${balls} balls, in the median`, of('bytes', 0.5), 'B');
  row(`bytes uploaded for a picture of ${balls} balls, at most`, of('bytes', 1), 'B');
  row(`turning ${balls} balls, script and painting in software, in the median`, partOf(turned, 0.5), 'ms');
  row(`zooming ${balls} balls, script and painting in software, in the median`, partOf(zoomed, 0.5), 'ms');
}

const folder = mkdtempSync(path.join(tmpdir(), 'vibrosow-frames-'));
const browser = await startBrowser();
try {
  const file = path.join(folder, 'report.html');
  writeFileSync(file, fillTemplate(readFileSync(template, 'utf8'), madeUpCrowd(balls, { frames, step })));
  const page = await openPage(browser, file, { first: countGl });
  print(await measure(page));
} finally {
  await browser.close();
  rmSync(folder, { recursive: true });
}

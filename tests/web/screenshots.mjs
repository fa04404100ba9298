// Pictures and films of the pages that the program writes, to be looked at (reports/pages).
// Usage: node tests/web/screenshots.mjs FOLDER, which holds NAME/report.html of each report below and studio/studio.html, and of some of
// them before.jpg, a picture of the same page as an older version made it.
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import * as in_ from './browser.mjs';
import { drawnSmaller, filmOf } from './film.mjs';

const reports = ['run', 'run-in-space', 'sweep', 'decision', 'front', 'accuracy', 'calibration'];
const jpeg = { type: 'jpeg', quality: 77, animations: 'disabled' };
const desktop = { width: 1280, height: 800 };
const older = { type: 'image/jpeg', width: 640, quality: 0.72 };
const film = { frames: 40, every: 90, frame: { type: 'image/webp', width: 720, quality: 0.6 } };  // every: ms
const phone = { width: 390, height: 844 };
const paper = { width: 720, height: 1018 };  // of A4 at 96 dpi, what is left within margins
// What is shown of a page: the first screens on a desktop, and of the first page also those on a phone, one screen in the dark, one sheet of paper.
const kinds = {
  desktop: { looks: {}, tallest: 2000 },
  phone: { looks: { viewport: phone }, tallest: 2 * phone.height },
  dark: { looks: { colorScheme: 'dark' }, tallest: desktop.height },
  print: { looks: { viewport: paper }, tallest: paper.height },
};

async function shoot(page, file, tallest) {
  const { width } = page.viewportSize();
  const height = await page.evaluate(() => document.documentElement.scrollHeight);
  await page.screenshot({ ...jpeg, path: file, fullPage: true, clip: { x: 0, y: 0, width, height: Math.min(height, tallest) } });
}

// As a browser does before it prints: the page turns light and draws anew.
async function turnToPaper(page) {
  await page.emulateMedia({ media: 'print' });
  await page.evaluate(() => dispatchEvent(new Event('beforeprint')));
}

async function settled(page) {
  await page.evaluate(() => new Promise((painted) => { requestAnimationFrame(() => requestAnimationFrame(painted)); }));
}

async function scrubToTheMiddle(page) {
  if ((await page.locator('#replay-frame').count()) === 0) return;
  await in_.scrubTo(page, Math.round(Number(await page.getAttribute('#replay-frame', 'max')) / 2));
}

async function withPage(browser, file, looks, act) {
  const page = await in_.openPage(browser, file, looks);
  try {
    await act(page);
    if (page.complaints.length > 0) throw new Error(`${file}: ${page.complaints.join('; ')}`);
  } finally {
    await page.context().close();
  }
}

async function shootReport(browser, folder, name) {
  const shown = name === reports[0] ? Object.keys(kinds) : ['desktop'];
  for (const kind of shown) {
    const { looks, tallest } = kinds[kind];
    await withPage(browser, path.join(folder, name, 'report.html'), looks, async (page) => {
      await scrubToTheMiddle(page);
      if (kind === 'print') await turnToPaper(page);
      await settled(page);
      await shoot(page, path.join(folder, `${name}-${kind}.jpg`), tallest);
    });
  }
}

const bench = (page, name) => page.getByRole('region', { name: `Layout ${name}`, exact: true });

async function toTheEnd(place) {
  await place.and(place.page().locator(['ready', 'playing', 'paused', 'ended'].map((status) => `[data-status="${status}"]`).join(','))).waitFor();
  await place.getByRole('button', { name: 'To the end' }).evaluate((button) => button.click());
  await place.and(place.page().locator('[data-status="ended"]')).waitFor();
}

async function shootStudio(browser, folder) {
  const file = path.join(folder, 'studio', 'studio.html');
  const to = (name) => path.join(folder, `studio-${name}.jpg`);
  await withPage(browser, file, {}, async (page) => {
    await page.getByRole('radio', { name: 'Draft' }).check();
    await page.waitForFunction(() => Number(document.querySelector('.bench canvas').dataset.time) > 1.6);
    await shoot(page, to('playing'), 1500);
    await toTheEnd(bench(page, 'A'));
    await settled(page);
    await shoot(page, to('ended'), 1500);
    await page.getByRole('button', { name: 'Compare layouts' }).click();
    await bench(page, 'B').getByRole('radio', { name: 'Holes', exact: true }).check();  // two have no room for all panels
    const moved = bench(page, 'B').getByRole('spinbutton', { name: 'Place of hole 2 in mm' });
    await moved.fill('190');
    await moved.press('Enter');
    await bench(page, 'B').getByRole('radio', { name: 'Rates', exact: true }).check();
    await toTheEnd(bench(page, 'A'));
    await toTheEnd(bench(page, 'B'));
    await settled(page);
    await shoot(page, to('comparing'), 1700);
  });
}

// `next(k)` brings the page to the k-th frame and gives how long that is shown, ms; null where there is none. `place`: what of the page is filmed, in its window.
async function shootFilm(browser, file, place, next) {
  const frames = [], page = await browser.newPage();
  const { width, height } = await place.boundingBox();
  let size;
  for (let k = 0; k < film.frames; ++k) {
    const duration = await next(k);
    if (duration === null) break;
    const { x, y } = await place.boundingBox();  // doubts that come stand above it
    const { bytes, ...drawn } = await drawnSmaller(page, await place.page().screenshot({ clip: { x, y, width, height }, animations: 'disabled' }), film.frame);
    frames.push({ webp: bytes, duration });
    size = drawn;
  }
  await page.close();
  writeFileSync(file, filmOf(frames, size));
}

// The replay's clock is the script's: a frame of a film takes longer to draw than it is shown.
async function shootReplayFilm(browser, folder) {
  const turnOfFrame = 4;  // px
  await withPage(browser, path.join(folder, 'run-in-space', 'report.html'), {}, async (page) => {
    const stage = page.locator('.replay .stage');
    await in_.scrubTo(page, 0);
    await page.getByRole('radio', { name: 'an eighth' }).check();
    await page.getByRole('button', { name: 'Corner' }).click();
    await stage.scrollIntoViewIfNeeded();
    const { x, y, height } = await stage.boundingBox();
    await page.clock.install();
    await page.clock.pauseAt(Date.now() + 1000);
    await page.getByRole('button', { name: 'Play' }).click();
    await page.mouse.move(x + 40, y + height / 2);
    await page.mouse.down();
    await shootFilm(browser, path.join(folder, 'run-in-space.webp'), stage, async (k) => {
      await page.clock.fastForward(film.every);
      await page.waitForFunction(() => document.querySelector('#replay-canvas').ariaLabel.includes(` at ${document.querySelector('#replay-time').textContent}. `));
      await page.mouse.move(x + 40 + turnOfFrame * k, y + height / 2);
      return film.every;
    });
    await page.mouse.up();
  });
}

// Plays on until a time of the run, s, or its end, and rests: in the page, so that it does not run away from a slow machine. Gives the time it came to.
const playUntil = (until) => new Promise((came) => {
  const place = document.querySelector('.bench'), canvas = place.querySelector('canvas'), toggle = place.querySelector('.controls .primary');
  const time = () => Number(canvas.dataset.time);
  const seen = new MutationObserver(() => {
    if (time() < until && place.dataset.status !== 'ended') return;
    seen.disconnect();
    if (place.dataset.status === 'playing') toggle.click();
    came(time());
  });
  seen.observe(place, { attributes: true, subtree: true, attributeFilter: ['data-time', 'data-status'] });
  if (['ready', 'paused'].includes(place.dataset.status)) toggle.click();
});

// The simulator's clock is its own: for each frame it goes on for a while and rests again, which the transport's words need not say.
async function shootStudioFilm(browser, folder) {
  await withPage(browser, path.join(folder, 'studio', 'studio.html'), { reducedMotion: 'reduce' }, async (page) => {
    await page.addStyleTag({ content: '.speed { visibility: hidden; }' });
    await page.locator('.bench[data-status="ready"]').waitFor();
    let time = 0;
    await shootFilm(browser, path.join(folder, 'studio.webp'), page.locator('.workbench'), async () => {
      if ((await page.locator('.bench').getAttribute('data-status')) === 'ended') return null;
      const before = time;
      time = await page.evaluate(playUntil, before + film.every / 1000);
      await settled(page);
      return 1000 * (time - before);
    });
  });
}

async function shootBefore(browser, folder) {
  const page = await browser.newPage();
  for (const name of [...reports, 'studio']) {
    const file = path.join(folder, name, 'before.jpg');
    if (!existsSync(file)) continue;
    const { bytes } = await drawnSmaller(page, readFileSync(file), older);
    writeFileSync(path.join(folder, `before-${name}.jpg`), bytes);
  }
  await page.close();
}

const folder = path.resolve(process.argv[2]);
const browser = await in_.startBrowser();
try {
  for (const name of reports) await shootReport(browser, folder, name);
  await shootStudio(browser, folder);
  await shootReplayFilm(browser, folder);
  await shootStudioFilm(browser, folder);
  await shootBefore(browser, folder);
} finally {
  await browser.close();
}

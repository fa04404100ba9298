// A headless Chromium for the tests, and what holds for every page.
import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { fileURLToPath, pathToFileURL } from 'node:url';

const require = createRequire(new URL('../../web/package.json', import.meta.url));
const { chromium } = require('playwright-core');
const axe = require.resolve('axe-core/axe.min.js');

export const template = fileURLToPath(new URL('../../build/web/report.html', import.meta.url));

const patience = 300_000; // ms, after which a page hangs: no slow machine decides a test

/** `more`: arguments of its command line. WebGL is drawn in software. */
export function startBrowser(more = []) {
  const args = ['--disable-gpu', '--enable-unsafe-swiftshader', '--disable-quic', ...more, ...(process.getuid() === 0 ? ['--no-sandbox'] : [])];
  return chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args, timeout: patience });
}

/** Opens a file; `page.complaints` gathers errors of the console, requests that are not of files, and dialogs. `first` runs before its own script. */
export async function openPage(browser, file, options = {}) {
  const { bypass = false, hash = '', first = null, ...looks } = options;
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, bypassCSP: bypass, ...looks });
  context.setDefaultTimeout(patience);
  const page = await context.newPage();
  if (first) await page.addInitScript(first);
  page.complaints = [];
  page.on('console', (message) => {
    const ofTheDriver = /GL Driver Message .*Performance/.test(message.text());  // a screen that is read back
    if (['error', 'warning'].includes(message.type()) && !ofTheDriver) page.complaints.push(message.text());
  });
  page.on('pageerror', (error) => page.complaints.push(String(error)));
  page.on('request', (request) => { if (!/^(file|blob|data):/.test(request.url())) page.complaints.push(request.url()); });
  page.on('dialog', (dialog) => { page.complaints.push(`dialog: ${dialog.message()}`); dialog.dismiss(); });
  await page.goto(`${pathToFileURL(file).href}${hash}`);
  await page.waitForSelector('html[data-ready]');
  await page.waitForSelector('#replay-canvas[data-frame], #replay code, #replay .doubt, .bench, main:not(:has(#replay)) > :is(section, h1)', { state: 'attached' });
  return page;
}

export async function shownFrame(page) {
  return Number(await page.getAttribute('#replay-canvas', 'data-frame'));
}

export async function waitForFrame(page, frame) {
  await page.waitForFunction((wanted) => Number(document.querySelector('#replay-canvas').dataset.frame) === wanted, frame);
}

/** Counts under the holes: hole -> seeds. */
export async function shownCounts(page) {
  return new Map(JSON.parse(await page.getAttribute('#replay-canvas', 'data-counts')));
}

export async function scrubTo(page, frame) {
  await page.$eval('#replay-frame', (range, value) => {
    range.value = value;
    range.dispatchEvent(new Event('input', { bubbles: true }));
  }, frame);
  await waitForFrame(page, frame);
}

export async function scrubToEnd(page) {
  const last = Number(await page.getAttribute('#replay-frame', 'max'));
  await scrubTo(page, last);
  return last;
}

// All that is drawn of the replay, of a run in space also what lies under the labels, once it is another picture than `before`; false until then.
const drawn = (before) => {
  const text = [...document.querySelectorAll('.replay canvas')].map((canvas) => canvas.toDataURL()).join();
  return text !== before && text;
};

/** The replay as a picture; equal texts are equal pictures. */
export function pictureOf(page) {
  return page.evaluate(drawn);
}

/** The replay once it is another picture than `before`. */
export async function nextPicture(page, before) {
  return (await page.waitForFunction(drawn, before)).jsonValue();
}

/** The page must have been opened with bypass: axe is a script of its own. */
export async function assertAccessible(page) {
  if (!(await page.evaluate(() => 'axe' in window))) await page.addScriptTag({ path: axe });
  const { violations } = await page.evaluate(() => window.axe.run({ resultTypes: ['violations'] }));
  assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.html).join(' ')}`), []);
}

export async function assertNoSidewaysScrolling(page) {
  const [wide, narrow] = await page.evaluate(() => [document.documentElement.scrollWidth, document.documentElement.clientWidth]);
  assert.ok(wide <= narrow, `the page is ${wide} px wide on a screen of ${narrow} px`);
}

/** Turns the page dark and narrow as a phone: accessible before and after, and no wider than the screen. */
export async function assertReadsWell(page) {
  await assertAccessible(page);
  await page.emulateMedia({ colorScheme: 'dark' });
  await page.waitForSelector('html[data-theme="dark"]');
  await page.setViewportSize({ width: 390, height: 844 });
  await assertAccessible(page);
  await assertNoSidewaysScrolling(page);
}

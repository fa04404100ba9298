// Every page as a picture and as the places of its elements, both as they were committed and as they are.
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import * as in_ from './browser.mjs';

const require = createRequire(new URL('../../web/package.json', import.meta.url));
const { default: pixelmatch } = await import(require.resolve('pixelmatch'));
const { PNG } = require('pngjs');

const committed = fileURLToPath(new URL('pictures', import.meta.url));
const seen = fileURLToPath(new URL('../../build/pictures', import.meta.url));
const half = 0.5;             // pixels of a picture to those of the page
const coarse = 0xf8;          // of a colour's bits, those that are kept: the files are half as large
const mostDifferent = 5e-4;   // of a picture's pixels
const colourThreshold = 0.1;  // pixelmatch's own: from 0, no difference, to 1
const mostMoved = 3;          // px of the page

// The page's own font would be that of the machine. Glyphs are not fitted to pixels, which is a setting of the machine too.
const font = readFileSync(require.resolve('@fontsource-variable/noto-sans/files/noto-sans-latin-wght-normal.woff2')).toString('base64');
const addFont = `document.fonts.add(new FontFace('Shipped', Uint8Array.from(atob('${font}'), (one) => one.charCodeAt(0)).buffer, { weight: '100 900' }));`;
const useFont = ':root { --font: Shipped, sans-serif; } pre, code, .link-field { font-family: Shipped, monospace !important; }';
export const sameEverywhere = ['--font-render-hinting=none', '--disable-lcd-text', '--force-color-profile=srgb'];

// The desktop shows what stands below the first screen, which the dark one shows.
const looks = {
  desktop: { size: { width: 1280, height: 800 }, media: { colorScheme: 'light' }, from: 'main' },
  dark: { size: { width: 1280, height: 800 }, media: { colorScheme: 'dark' } },
  phone: { size: { width: 390, height: 844 }, media: { colorScheme: 'light' } },
  print: { size: { width: 720, height: 1018 }, media: { colorScheme: 'light', media: 'print' } },
};

const elements = 'h1, h2, .headline, .light, .tray-card, .inputs, .drawing, main section, .stage, .controls, .legend, .chart-place, .table-frame, .ranks, .hole-bars, .figures, .panel, .actions';

/** The text of a page in the font that the tests bring; `style`: what a test changes of it. */
export function inShippedFont(html, style = '') {
  return html.replace('</head>', () => `<style>${useFont}${style}</style></head>`);
}

export async function openInShippedFont(browser, file) {
  const page = await in_.openPage(browser, file, { viewport: looks.desktop.size, deviceScaleFactor: half, reducedMotion: 'reduce', first: { content: addFont } });
  await bringToRest(page);
  return page;
}

// The studio's run at its end, by the same steps each time: it waits at its start.
async function bringToRest(page) {
  if ((await page.locator('.bench').count()) === 0) return;
  await page.locator('.bench[data-status="ready"]').waitFor();
  await page.getByRole('button', { name: 'To the end' }).click();
  await page.locator('.bench[data-status="ended"]').waitFor();
}

function painted(page) {
  return page.evaluate(() => new Promise((done) => { requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done))); }));
}

// The middle of the replay, drawn anew at this size.
async function scrubToTheMiddle(page) {
  if ((await page.locator('#replay-frame').count()) === 0) return;
  await in_.scrubTo(page, 0);
  await in_.scrubTo(page, Math.round(Number(await page.getAttribute('#replay-frame', 'max')) / 2));
}

// Name to [x, y, width, height] on the page, px.
const boxesOnPage = (selector) => {
  const times = {};
  return Object.fromEntries([...document.querySelectorAll(selector)].filter((node) => node.getClientRects().length > 0).map((node) => {
    const { x, y, width, height } = node.getBoundingClientRect();
    const name = node.id ? `#${node.id}` : node.classList.length ? `.${node.classList[0]}` : node.localName;
    times[name] = (times[name] ?? 0) + 1;
    return [times[name] > 1 ? `${name} ${times[name]}` : name, [x + scrollX, y + scrollY, width, height].map(Math.round)];
  }));
};

async function pictureOf(page) {
  const png = PNG.sync.read(await page.screenshot({ animations: 'disabled' }));
  png.data.forEach((value, k) => { png.data[k] = k % 4 === 3 ? value : value & coarse; });
  return png;
}

async function looked(page, { size, media, from }) {
  await page.setViewportSize(size);
  await page.emulateMedia({ media: 'screen', ...media });
  if (media.media === 'print') await page.evaluate(() => dispatchEvent(new Event('beforeprint')));
  await painted(page);
  await scrubToTheMiddle(page);
  await page.evaluate((selector) => (selector ? document.querySelector(selector).scrollIntoView() : scrollTo(0, 0)), from);
  await painted(page);
  return { png: await pictureOf(page), boxes: await page.evaluate(boxesOnPage, elements) };
}

/** Look -> { png, boxes } of a page that is open; `some`: of these looks alone. */
export async function looksOf(page, some = Object.keys(looks)) {
  const all = new Map();
  for (const name of some) all.set(name, await looked(page, looks[name]));
  return all;
}

const pictureFile = (folder, name, what = '') => path.join(folder, `${name}${what}.png`);

function write(file, png) {
  mkdirSync(path.dirname(file), { recursive: true });
  writeFileSync(file, PNG.sync.write(png, { colorType: 2, deflateStrategy: 0, filterType: 0 }));
}

/** What is wrong with a picture against another, in a sentence; null where nothing is. What differs is drawn in build/pictures. */
export function pictureProblem(name, png, expected) {
  const { width, height } = png;
  if (width !== expected.width || height !== expected.height) return `${name}: ${width} x ${height} pixels instead of ${expected.width} x ${expected.height}`;
  const difference = new PNG({ width, height });
  const count = pixelmatch(expected.data, png.data, difference.data, width, height, { threshold: colourThreshold });
  if (count <= mostDifferent * width * height) return null;
  write(pictureFile(seen, name), png);
  write(pictureFile(seen, name, '-difference'), difference);
  return `${name}: ${count} of ${width * height} pixels differ; look at ${path.relative(process.cwd(), pictureFile(seen, name, '-difference'))}`;
}

/** Each element that stands elsewhere, has another size, or is there in one of them alone, in a sentence. */
export function boxProblems(name, boxes, expected) {
  return [...new Set([...Object.keys(expected), ...Object.keys(boxes)])].flatMap((element) => {
    const [is, was] = [boxes[element], expected[element]];
    const near = is && was && is.every((value, k) => Math.abs(value - was[k]) <= mostMoved);
    return near ? [] : [`${name}: ${element} is at ${is ?? 'no place'}, and was at ${was ?? 'no place'}`];
  });
}

/** Of the committed pictures: { chromium: the major version that made them, boxes: name -> those of a look }. */
export function committedLooks() {
  const text = (name) => (existsSync(path.join(committed, name)) ? readFileSync(path.join(committed, name), 'utf8') : null);
  return { chromium: text('chromium')?.trim(), boxes: JSON.parse(text('boxes.json') ?? '{}') };
}

export function committedPicture(name) {
  return PNG.sync.read(readFileSync(pictureFile(committed, name)));
}

/** Puts others in the place of the committed ones. `all`: name -> { png, boxes }. */
export function writeLooks(all, chromium) {
  for (const [name, { png }] of all) write(pictureFile(committed, name), png);
  const rows = [...all].map(([name, { boxes }]) => `${JSON.stringify(name)}: ${JSON.stringify(boxes)}`);
  writeFileSync(path.join(committed, 'boxes.json'), `{\n${rows.join(',\n')}\n}\n`);
  writeFileSync(path.join(committed, 'chromium'), `${chromium}\n`);
}

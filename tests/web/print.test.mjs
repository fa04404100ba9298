// Every page printed to a PDF, as a customer gets it.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import path from 'node:path';
import test, { after } from 'node:test';
import * as in_ from './browser.mjs';
import { everyPage } from './every_page.mjs';
import { sheetsOf } from './sheets.mjs';

const { PNG } = createRequire(new URL('../../web/package.json', import.meta.url))('pngjs');
const folder = mkdtempSync(path.join(tmpdir(), 'vibrosow-print-'));
const browser = await in_.startBrowser();
const pages = await everyPage();
const leastWords = 10;      // of a sheet that is worth its paper, without those of the page's footer
const leastFilled = 1 / 3;  // of its height, but for the last sheet
const slack = 1;            // point

after(async () => {
  await browser.close();
  rmSync(folder, { recursive: true });
});

// What a line may end after: white space, and these inside a word.
const parts = (text) => text.split(/\s+|(?<=[-–—/?])/u).filter(Boolean);

// What the page says, its replay by its label; dimensions, which may be turned; headings; the footer.
const textsOnPage = () => {
  const texts = (selector) => [...document.querySelectorAll(selector)].map((node) => node.textContent.trim());
  const all = [...document.querySelectorAll('canvas')].flatMap((canvas) => (canvas.ariaLabel ?? '').split(/[.,]?(?: |$)/));
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) if (!walker.currentNode.parentElement.closest('script, style')) all.push(walker.currentNode.data);
  return { all, turned: texts('.dimension text'), headings: texts('h2, h3'), foot: texts('footer p').join(' ') };
};

async function textOf(page) {
  const { all, turned, headings, foot } = await page.evaluate(textsOnPage);
  const pieces = turned.flatMap((text) => [...text].flatMap((_, k) => [text.slice(0, k), text.slice(k)]));  // of a turned text pdftotext makes several
  return { words: new Set([...all, ...pieces].flatMap(parts)), headings: new Set(headings), foot: new Set(parts(foot)) };
}

// Whether a text is made of whole words; where two stand close a PDF has them as one.
function isWhole(text, words) {
  return text === '' || words.has(text) || [...text].some((_, k) => k > 0 && words.has(text.slice(0, k)) && isWhole(text.slice(k), words));
}

function lastLine({ lines }) {
  return lines.reduce((last, line) => (line.low > last.low ? line : last), { low: 0, text: '' });
}

/** What is wrong with printed sheets, in sentences. */
function problemsOf(sheets, { words, headings, foot }, { title, kicker, program }) {
  return sheets.flatMap((sheet, k) => {
    const of = `sheet ${k + 1} of ${sheets.length}`, last = lastLine(sheet);
    const own = sheet.words.filter(({ text }) => !foot.has(text)).length;
    const broken = sheet.words.flatMap(({ text }) => parts(text)).filter((text) => !isWhole(text, words));
    const beyond = sheet.words.filter(({ xMin, xMax }) => xMin < sheet.left - slack || xMax > sheet.right + slack);
    return [
      sheet.head === `${title} ${kicker}` ? '' : `${of} is headed "${sheet.head}"`,
      sheet.foot === `Written by ${program} ${k + 1} / ${sheets.length}` ? '' : `${of} ends in "${sheet.foot}"`,
      own >= leastWords ? '' : `${of} has ${own} words of its own`,
      last.low >= leastFilled * sheet.height || k + 1 === sheets.length ? '' : `${of} is empty below "${last.text}"`,
      headings.has(last.text) ? `${of} ends in the heading "${last.text}"` : '',
      broken.length ? `${of} breaks words: ${broken.join(', ')}` : '',
      beyond.length ? `${of} has words beyond its margins: ${beyond.map(({ text }) => text).join(', ')}` : '',
    ].filter(Boolean);
  });
}

// `style`: what a test changes of the page.
function opened(name, style = '') {
  const file = path.join(folder, `${name}.html`);
  writeFileSync(file, pages.get(name).replace('</head>', () => `<style>${style}</style></head>`));
  return in_.openPage(browser, file, { reducedMotion: 'reduce' });  // the studio rests at its start
}

async function printed(name, style) {
  const page = await opened(name, style);
  const kicker = (await page.locator('.kicker').count()) > 0 ? await page.locator('.kicker').textContent() : 'Studio';
  const told = { title: await page.locator('h1').textContent(), kicker, program: 'vibrosow 0.2.0' };
  const { pdf, sheets } = await sheetsOf(page);
  const text = await textOf(page);  // some of it is written when the page has its width
  assert.deepEqual(page.complaints, []);
  await page.context().close();
  return { pdf, sheets, problems: problemsOf(sheets, text, told) };
}

for (const name of pages.keys()) {
  test(`${name} on paper: a heading on every sheet, no broken word, no sheet without text`, async (t) => {
    const { sheets, problems } = await printed(name);
    t.diagnostic(`${sheets.length} sheets of ${sheets.map(({ words }) => words.length).join(', ')} words`);
    assert.deepEqual(problems, []);
  });
}

// How many pixels of a sheet, drawn at 50 dpi, are of a colour that is no grey.
function colouredOn(pdf, sheet) {
  const { data } = PNG.sync.read(execFileSync('pdftoppm', ['-r', '50', '-png', '-singlefile', '-f', sheet, '-l', sheet, '-'], { input: pdf, maxBuffer: 1e8 }));
  let coloured = 0;
  for (let k = 0; k < data.length; k += 4) if (Math.max(data[k], data[k + 1], data[k + 2]) - Math.min(data[k], data[k + 1], data[k + 2]) > 60) ++coloured;
  return coloured;
}

// How wide each is drawn, and how wide its place is, px.
const widths = () => [...document.querySelectorAll('.chart-place, .scatter, .stage')].filter((place) => place.clientWidth > 0).map((place) => {
  const drawing = place.querySelector('canvas') ?? place.querySelector('svg');
  return [Number(drawing.getAttribute('width')), place.clientWidth];
});

// Widths as they are drawn after an event, each that of its place.
async function drawnAfter(page, event) {
  await page.evaluate((kind) => dispatchEvent(new Event(kind)), event);
  const all = await page.evaluate(widths);
  for (const [drawn, place] of all) assert.equal(drawn, place);
  return all.map(([drawn]) => drawn);
}

for (const name of ['run', 'run-in-space', 'sweep', 'calibration', 'studio']) {
  test(`what is drawn in ${name} is drawn for the width of a sheet, and again for that of the screen`, async () => {
    const page = await opened(name);
    if (name === 'studio') await page.locator('.bench[data-status="ready"]').waitFor();
    const sheet = (182 / 25.4) * 96;
    const onScreen = (await page.evaluate(widths)).map(([drawn]) => drawn);
    const onPaper = await drawnAfter(page, 'beforeprint');
    assert.ok(Math.max(...onPaper) > 300 && Math.max(...onPaper) <= sheet, `${onPaper} px`);
    assert.notDeepEqual(onPaper, onScreen);
    assert.deepEqual(await drawnAfter(page, 'afterprint'), onScreen);
    await page.context().close();
  });
}

for (const name of ['run', 'run-in-space']) {
  test(`the seeds of ${name} are on paper`, async () => {
    const { pdf, sheets } = await printed(name);
    const withReplay = sheets.findIndex(({ lines }) => lines.some(({ text }) => text.endsWith('seeds so far') && text.startsWith('Under')));
    assert.ok(colouredOn(pdf, 1 + withReplay) > 1500, `${colouredOn(pdf, 1 + withReplay)} coloured pixels`);
  });
}

test('the columns of a long table are named on every sheet that it goes over', async () => {
  const { sheets } = await printed('sweep');
  const times = (sheet, text) => sheet.words.filter((word) => word.text === text).length;
  const withRows = sheets.filter((sheet) => times(sheet, 'ok') > 3);
  assert.ok(withRows.length > 1);
  for (const sheet of withRows) assert.equal(times(sheet, 'status'), 1, sheet.foot);
});

for (const [what, style, problem] of [
  ['a word that is broken', 'p { width: 4ch; word-break: break-all; }', /breaks words: /],
  ['a sheet with the footer alone', 'footer { display: block !important; break-before: page; }', /sheet (\d+) of \1 has 0 words of its own/],
  ['an empty sheet', '#outflow { break-before: page; } #outflow-title { break-after: page !important; }', /is empty below "Outflow/],
  ['a heading left behind', '#outflow-title { break-after: page !important; }', /ends in the heading "Outflow/],
  ['what is cut off', 'h1 { white-space: nowrap; position: relative; left: 60vw; }', /words beyond its margins: /],
  ['sheets without their headings', '@page { @top-left { content: none !important; } }', /is headed "Run in 2D"/],
]) {
  test(`${what} is told`, async () => {
    assert.match((await printed('run', style)).problems.join('\n'), problem);
  });
}

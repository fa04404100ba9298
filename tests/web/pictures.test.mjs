// Every page looks as in tests/web/pictures: pixel by pixel under the Chromium that made those, else by the places of its elements.
// node tests/web/pictures.test.mjs --make    makes them anew, to be looked at and committed
import assert from 'node:assert/strict';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import test, { after } from 'node:test';
import * as in_ from './browser.mjs';
import { everyPage } from './every_page.mjs';
import * as pictures from './pictures.mjs';

const folder = mkdtempSync(path.join(tmpdir(), 'vibrosow-pictures-'));
const browser = await in_.startBrowser(pictures.sameEverywhere);
const pages = await everyPage();
const [chromium] = browser.version().split('.');

async function close() {
  await browser.close();
  rmSync(folder, { recursive: true });
}

// "NAME-LOOK" -> { png, boxes }. `style`: what a test changes of the page; `looks`: these alone.
async function looksOf(name, { style, looks } = {}) {
  const file = path.join(folder, `${name}.html`);
  writeFileSync(file, pictures.inShippedFont(pages.get(name), style));
  const page = await pictures.openInShippedFont(browser, file);
  const all = await pictures.looksOf(page, looks);
  assert.deepEqual(page.complaints, []);
  await page.context().close();
  return new Map([...all].map(([look, made]) => [`${name}-${look}`, made]));
}

async function make() {
  const all = new Map();
  for (const name of pages.keys()) for (const entry of await looksOf(name)) all.set(...entry);
  pictures.writeLooks(all, chromium);
}

function problemsOf(all, committed) {
  return [...all].flatMap(([name, { png, boxes }]) => [
    ...(committed.chromium === chromium ? [pictures.pictureProblem(name, png, pictures.committedPicture(name))].filter(Boolean) : []),
    ...pictures.boxProblems(name, boxes, committed.boxes[name] ?? {}),
  ]);
}

function testAll() {
  after(close);
  const committed = pictures.committedLooks();
  for (const name of pages.keys()) {
    test(`${name} looks as in its pictures`, async (t) => {
      if (committed.chromium !== chromium) t.diagnostic(`the pictures are of Chromium ${committed.chromium}, this is ${chromium}: places of elements are compared, no pixels`);
      assert.deepEqual(problemsOf(await looksOf(name), committed), []);
    });
  }

  const told = async (style) => problemsOf(await looksOf('run', { style, looks: ['dark'] }), committed);

  test('another colour of one word is told by the picture', { skip: committed.chromium !== chromium && 'another Chromium' }, async () => {
    assert.match((await told('.light-words { color: #d33; }')).join('\n'), /^run-dark: \d+ of 256000 pixels differ; look at build\/pictures\/run-dark-difference\.png$/);
  });

  test('a place that has moved is told by the elements', async () => {
    assert.match((await told('.light { margin-top: 23px; }')).join('\n'), /run-dark: \.light is at \d+,\d+,\d+,\d+, and was at \d+,\d+,\d+,\d+/);
  });
}

if (process.argv.includes('--make')) await make().finally(close);
else testAll();

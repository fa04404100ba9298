// The site, with made-up pages in the place of the program's: every link leads somewhere, and it reads well. What a page can do is tried with
// made-up documents.
import assert from 'node:assert/strict';
import { existsSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import test, { after } from 'node:test';
import { buildSite } from '../../web/site/build.mjs';
import * as in_ from './browser.mjs';
import { writeDocuments } from './made_up_documents.mjs';

const folder = mkdtempSync(path.join(tmpdir(), 'vibrosow-site-'));
const [site, made, documents, small] = ['site', 'made', 'documents', 'small'].map((name) => path.join(folder, name));
for (const page of ['studio/studio.html', 'run/report.html', 'run-in-space/report.html']) {
  mkdirSync(path.join(made, path.dirname(page)), { recursive: true });
  writeFileSync(path.join(made, page), '<!doctype html><html lang="en"><title>Made up</title><main><h1>Made up</h1></main></html>');
}
const pages = await buildSite(site, made);
writeDocuments(documents);
await buildSite(small, made, documents);
const browser = await in_.startBrowser();

after(async () => {
  await browser.close();
  rmSync(folder, { recursive: true });
});

function htmlFiles(place = site) {
  return readdirSync(place, { withFileTypes: true }).flatMap((entry) => {
    const file = path.join(place, entry.name);
    return entry.isDirectory() ? htmlFiles(file) : file.endsWith('.html') ? [file] : [];
  });
}

const texts = new Map(htmlFiles().map((file) => [file, readFileSync(file, 'utf8')]));
const bodyOf = (file) => /<body>.*<\/main>.*<\/nav>/s.exec(texts.get(file))?.[0] ?? '';
const addressesIn = (html) => [...html.matchAll(/<(?:a|img)\b[^>]*?\b(?:href|src)="([^"]*)"/g)].map(([, address]) => address.replaceAll('&amp;', '&'));

test('every link leads to a file of the site, and to a place in it', () => {
  assert.equal(texts.size, pages);
  const broken = [];
  let links = 0;
  for (const file of texts.keys()) {
    for (const address of addressesIn(bodyOf(file))) {
      if (/^https:/.test(address)) continue;
      ++links;
      const [, target, anchor] = /^([^#]*)#?(.*)$/.exec(decodeURI(address));
      const wanted = target ? path.join(path.dirname(file), target) : file;
      const found = !path.isAbsolute(target) && existsSync(wanted) && wanted.startsWith(site) && (!anchor || texts.get(wanted)?.includes(` id="${anchor}"`));
      if (!found || (target && wanted.endsWith('.md'))) broken.push(`${path.relative(site, file)}: ${address}`);
    }
  }
  assert.deepEqual(broken, []);
  assert.ok(links > 1000);
});

const menuOf = (text) => /<nav id="menu".*<\/nav>/s.exec(text)[0];

test('every document has its page, and each page leads to all in the menu', () => {
  const names = readdirSync(new URL('../../docs', import.meta.url), { recursive: true }).filter((name) => name.endsWith('.md') && !name.endsWith('README.md'));
  for (const name of names) assert.ok(existsSync(path.join(site, 'docs', name.replace(/\.md$/, '.html'))), name);
  const leadsTo = (file) => addressesIn(menuOf(texts.get(file))).map((address) => path.join(path.dirname(file), address));
  const ofIndex = leadsTo(path.join(site, 'index.html'));
  for (const page of ['studio.html', 'seeders/FORMAT.html', ...names.map((name) => `docs/${name.replace(/\.md$/, '.html')}`)]) assert.ok(ofIndex.includes(path.join(site, page)), page);
  assert.deepEqual(leadsTo(path.join(site, 'reports/performance.html')), ofIndex);
});

test('a page is light, and so is the index', () => {
  const own = Buffer.byteLength(texts.get(path.join(site, 'index.html'))) - Buffer.byteLength(/<main.*<\/main>/s.exec(texts.get(path.join(site, 'index.html')))[0]);
  assert.ok(own < 60_000, `${own} bytes`);
  assert.ok(statSync(path.join(site, 'search-index.js')).size < 400_000);
});

test('what a file says stays text', () => {
  const page = texts.get(path.join(site, 'seeders/FORMAT.html'));
  assert.doesNotMatch(bodyOf(path.join(site, 'seeders/FORMAT.html')), /<script/);
  assert.match(page, /default-src 'none'.*connect-src 'none'/);
});

for (const [place, name] of [[site, 'index.html'], [site, 'seeders/FORMAT.html'], [site, 'reports/performance.html'], [small, 'docs/how-to/unclog.html'], [small, 'docs/explanation/theory.html']]) {
  test(`${name} reads well: light, dark, on a phone; it asks for nothing`, async () => {
    for (const looks of [{ viewport: { width: 1280, height: 720 } }, { colorScheme: 'dark' }, { viewport: { width: 360, height: 740 } }]) {
      const page = await in_.openPage(browser, path.join(place, name), { ...looks, bypass: true });
      await in_.assertAccessible(page);
      await in_.assertNoSidewaysScrolling(page);
      assert.deepEqual(page.complaints, []);
      await page.context().close();
    }
  });
}

test('pictures are shown, under the page\'s own policy', async () => {
  const page = await in_.openPage(browser, path.join(site, 'index.html'));
  const shown = await page.$$eval('img', (images) => Promise.all(images.map((image) => image.decode().then(() => image.naturalWidth > 0, () => false))));
  assert.ok(shown.length > 0 && shown.every(Boolean));
  assert.deepEqual(page.complaints, []);
  await page.context().close();
});

test('a phone reaches the menu, and the theme turns', async () => {
  const page = await in_.openPage(browser, path.join(site, 'ARCHITECTURE.html'), { viewport: { width: 360, height: 740 } });
  await page.getByRole('link', { name: 'Menu' }).click();
  await page.getByRole('navigation', { name: 'Menu' }).getByRole('link', { name: 'What it is' }).click();
  await page.getByRole('heading', { name: 'Vibrosow', exact: true, level: 1 }).waitFor();
  await page.getByRole('button', { name: 'Dark' }).click();
  await page.waitForSelector('html[data-theme="dark"]');
  assert.deepEqual(page.complaints, []);
  await page.context().close();
});

const readSmall = (name) => readFileSync(path.join(small, name), 'utf8');
const inMenu = (name) => [...menuOf(readSmall(name)).matchAll(/<summary>(.*?)<\/summary>|<a [^>]*>(.*?)<\/a>/g)].map(([, heading, entry]) => heading ?? `- ${entry}`);

test('the menu goes by purposes, tutorials first, in the order of docs/README.md; a purpose without a page is left out', () => {
  assert.deepEqual(inMenu('index.html'), ['- What it is', '- The studio', '- A report of a run in 2D', '- A report of a run in 3D', '- Documents',
    'Tutorials', '- Draw a tray', '- Fill a tray', '- Shake a tray', '- Weigh a tray', 'How-to', '- Unclog a hole', 'Explanation', '- Theory']);
  const open = (name) => [...menuOf(readSmall(name)).matchAll(/<details open><summary>(.*?)</g)].map(([, heading]) => heading);
  assert.deepEqual(open('index.html'), ['Tutorials', 'How-to']);
  assert.deepEqual(open('docs/explanation/theory.html'), ['Tutorials', 'Explanation']);
});

test('the front page starts with three tutorials, and opens the studio and a report', async () => {
  const page = await in_.openPage(browser, path.join(small, 'index.html'));
  const cards = await page.$$eval('.start li', (items) => items.map((item) => [item.querySelector('a').getAttribute('href'), item.querySelector('p').textContent]));
  assert.deepEqual(cards.slice(0, 3), [['docs/tutorials/b.html', 'You draw it.'], ['docs/tutorials/z.html', 'You fill a tray with wheat.'], ['docs/tutorials/a.html', 'You shake it.']]);
  assert.deepEqual(cards.slice(3).map(([address]) => address), ['studio.html', 'example-run/report.html']);
  await page.context().close();
});

test('a word is found by keyboard, a slip of the finger too, and its section opened', async () => {
  const page = await in_.openPage(browser, path.join(small, 'docs/tutorials/z.html'));
  await page.keyboard.press('/');
  await page.keyboard.type('parabolometrik');
  await page.getByRole('status').filter({ hasText: /^1 result$/ }).waitFor();
  const results = page.getByRole('list', { name: 'Results' });
  assert.match(await results.getByRole('link').innerText(), /^Arching <b>grains<\/b> *Unclog a hole\n… .*the parabolometric unevenness falls\.$/);
  assert.equal(await results.locator('mark').innerText(), 'parabolometric');
  await page.keyboard.press('ArrowDown');
  await page.keyboard.press('Enter');
  await page.waitForURL(/how-to\/unclog\.html#arching-bgrainsb$/);
  await page.getByRole('searchbox', { name: 'Search all documents' }).fill('tray');
  await results.getByRole('link').nth(2).waitFor();
  for (const key of ['ArrowDown', 'ArrowDown', 'ArrowUp', 'Escape']) await page.keyboard.press(key);
  assert.ok(await page.evaluate(() => document.activeElement.type === 'search' && document.querySelector('.results').hidden));
  await page.keyboard.type('qqqq');
  await page.getByText('Nothing found for “qqqq”').waitFor();
  assert.deepEqual(page.complaints, []);
  await page.context().close();
});

test('the results are accessible, and fit a phone', async () => {
  const page = await in_.openPage(browser, path.join(site, 'index.html'), { viewport: { width: 360, height: 740 }, bypass: true });
  await page.getByRole('searchbox').fill('unevenness of a tray');
  await page.getByRole('list', { name: 'Results' }).getByRole('link').nth(5).waitFor();
  await in_.assertAccessible(page);
  await in_.assertNoSidewaysScrolling(page);
  assert.deepEqual(page.complaints, []);
  await page.context().close();
});

test('the index leads to places that are there', () => {
  const index = JSON.parse(/indexOf\((\[\[.*\])\);\n$/s.exec(readFileSync(path.join(site, 'search-index.js'), 'utf8'))[1]);
  for (const [address, , ...sections] of index) {
    const text = texts.get(path.join(site, decodeURI(address)));
    for (const [anchor] of sections) assert.ok(text.includes(` id="${anchor}"`), `${address}#${anchor}`);
  }
  assert.ok(index.length > 20);
});

test('of a console the commands are copied, of other code all', async () => {
  const page = await in_.openPage(browser, path.join(small, 'docs/how-to/unclog.html'));
  await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
  const copied = async (k) => {
    await page.getByRole('button', { name: 'Copy' }).first().waitFor();
    await page.locator('.code').nth(k).getByRole('button').click();
    await page.locator('.code').nth(k).getByRole('button', { name: 'Copied' }).waitFor();
    return page.evaluate(() => navigator.clipboard.readText());
  };
  assert.equal(await copied(0), 'vibrosow check tray.toml\nvibrosow run tray.toml \\\n    --html');
  assert.equal(await copied(1), 'vibrosow plan --crop pea    # costs $5 and $6\necho "$HOME"');
  assert.deepEqual(page.complaints, []);
  await page.context().close();
});

test('headings lead to themselves, by the anchors of GitHub', async () => {
  const page = await in_.openPage(browser, path.join(small, 'docs/explanation/theory.html'));
  const ids = await page.$$eval('main :is(h1, h2, h3)', (headings) => headings.map(({ id }) => id));
  assert.deepEqual(ids, ['theory', 'the-law-of-beverloo-and-mu_r-twice', 'the-law-of-beverloo-and-mu_r-twice-1', 'with-e-and-a-link']);
  await page.getByRole('heading', { level: 2 }).nth(1).getByRole('link').click();
  assert.match(page.url(), /#the-law-of-beverloo-and-mu_r-twice-1$/);
  assert.equal(await page.locator('h3 a').count(), 1);
  await page.context().close();
});

test('a page\'s contents stand beside it, and folded on a phone', async () => {
  for (const [width, open] of [[1280, true], [360, false]]) {
    const page = await in_.openPage(browser, path.join(small, 'docs/explanation/theory.html'), { viewport: { width, height: 740 } });
    const contents = page.getByRole('navigation', { name: 'On this page' });
    assert.equal(await contents.getByRole('link').first().isVisible(), open);
    if (!open) await contents.getByText('On this page').click();
    await contents.getByRole('link', { name: /^With\b.*\band a link$/ }).click();
    assert.match(page.url(), /#with-e-and-a-link$/);
    const [beside, text] = await Promise.all([contents, page.locator('main')].map((each) => each.boundingBox()));
    assert.equal(beside.x >= text.x + text.width, open);
    await page.context().close();
  }
  assert.doesNotMatch(readSmall('docs/tutorials/z.html'), /id="contents"/);
});

test('formulas are typeset in the page; dollars of prices and of code stay', async () => {
  const page = await in_.openPage(browser, path.join(small, 'docs/explanation/theory.html'));
  assert.deepEqual(await page.$$eval('main math', (all) => all.map((math) => math.getAttribute('display') ?? 'inline')), ['inline', 'inline', 'block', 'inline', 'inline']);
  const tall = await page.locator('math[display="block"]').boundingBox();
  assert.ok(tall.height > 30, 'its fractions are drawn');
  const first = await page.locator('main p').first().innerText();
  assert.match(first, /^Costs \$5, or \$5 and \$6, or \$a\$ in code: no formulas\./);
  assert.deepEqual(page.complaints, []);
  await page.context().close();
});

test('a formula that cannot be typeset ends the making of the site, with its document', async () => {
  const broken = path.join(folder, 'broken');
  writeDocuments(broken);
  writeFileSync(path.join(broken, 'docs/how-to/broken.md'), '# Broken\n\n$\\frac{1$\n');
  await assert.rejects(buildSite(path.join(folder, 'never'), made, broken), /docs\/how-to\/broken\.md: KaTeX parse error/);
});

test('on paper there is the text alone', async () => {
  const page = await in_.openPage(browser, path.join(small, 'docs/how-to/unclog.html'));
  await page.emulateMedia({ media: 'print' });
  const shown = await page.$$eval('#head, #contents, #menu, .copy, main, pre', (all) => all.filter((each) => each.checkVisibility()).map(({ tagName }) => tagName));
  assert.deepEqual(shown, ['MAIN', 'PRE', 'PRE', 'PRE']);
  assert.equal(await page.$eval('h2', (heading) => getComputedStyle(heading).breakAfter), 'avoid');
  await page.context().close();
});

// The site, with made-up pages in the place of the program's: every link leads somewhere, and it reads well.
import assert from 'node:assert/strict';
import { existsSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import test, { after } from 'node:test';
import { buildSite } from '../../web/site/build.mjs';
import * as in_ from './browser.mjs';

const folder = mkdtempSync(path.join(tmpdir(), 'vibrosow-site-'));
const [site, made] = [path.join(folder, 'site'), path.join(folder, 'made')];
for (const page of ['studio/studio.html', 'run/report.html', 'run-in-space/report.html']) {
  mkdirSync(path.join(made, path.dirname(page)), { recursive: true });
  writeFileSync(path.join(made, page), '<!doctype html><html lang="en"><title>Made up</title><main><h1>Made up</h1></main></html>');
}
const pages = await buildSite(site, made);
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

test('every document has its page, and each page leads to all in the menu', () => {
  const documents = readdirSync(new URL('../../docs', import.meta.url), { recursive: true }).filter((name) => name.endsWith('.md'));
  for (const name of documents) {
    const page = name.replace(/\.md$/, '.html').replace(/(^|\/)README\.html$/, '$1index.html');
    assert.ok(existsSync(path.join(site, 'docs', page)), name);
  }
  const menuOf = (file) => addressesIn(/<nav.*<\/nav>/s.exec(texts.get(file))[0]).map((address) => path.join(path.dirname(file), address));
  const ofIndex = menuOf(path.join(site, 'index.html'));
  assert.ok(ofIndex.includes(path.join(site, 'studio.html')) && ofIndex.includes(path.join(site, 'seeders/FORMAT.html')));
  assert.deepEqual(menuOf(path.join(site, 'docs/how-to/run-a-long-study.html')), ofIndex);
});

test('what a file says stays text', () => {
  const page = texts.get(path.join(site, 'seeders/FORMAT.html'));
  assert.doesNotMatch(bodyOf(path.join(site, 'seeders/FORMAT.html')), /<script/);
  assert.match(page, /default-src 'none'.*connect-src 'none'/);
});

for (const name of ['index.html', 'docs/DECIDING.html', 'reports/performance.html']) {
  test(`${name} reads well: light, dark, on a phone; it asks for nothing`, async () => {
    for (const looks of [{}, { colorScheme: 'dark' }, { viewport: { width: 390, height: 844 } }]) {
      const page = await in_.openPage(browser, path.join(site, name), { ...looks, bypass: true });
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
  const page = await in_.openPage(browser, path.join(site, 'docs/how-to/use-the-studio.html'), { viewport: { width: 390, height: 844 } });
  await page.getByRole('link', { name: 'Contents' }).click();
  await page.getByRole('navigation', { name: 'Contents' }).getByRole('link', { name: 'What it is' }).click();
  await page.getByRole('heading', { name: 'Vibrosow', exact: true, level: 1 }).waitFor();
  await page.getByRole('button', { name: 'Dark' }).click();
  await page.waitForSelector('html[data-theme="dark"]');
  assert.deepEqual(page.complaints, []);
});

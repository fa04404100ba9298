// Pages of made-up data, in a browser that is there for all tests of a file.
import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { after } from 'node:test';
import * as in_ from './browser.mjs';
import { fillTemplate } from './made_up_run.mjs';

export const hostile = '</script><img src=x onerror=alert(1)>';
export const template = readFileSync(in_.template, 'utf8');
const folder = mkdtempSync(path.join(tmpdir(), 'vibrosow-pages-'));
const browser = await in_.startBrowser();

after(async () => {
  await browser.close();
  rmSync(folder, { recursive: true });
});

export function fileOf(made) {
  const file = path.join(folder, 'page.html');
  writeFileSync(file, fillTemplate(template, made));
  return file;
}

export function openMade(made, options) {
  return in_.openPage(browser, fileOf(made), options);
}

/** Opens a page of its own for a check, after which nothing may have been complained of. */
export async function withPage(made, options, check) {
  const page = await openMade(made, options);
  try {
    await check(page);
    assert.deepEqual(page.complaints, []);
  } finally {
    await page.context().close();
  }
}

// Makes one file of a page: script and style inlined, the script's hash in its content security policy.
import { createHash } from 'node:crypto';
import { existsSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const here = path.dirname(fileURLToPath(import.meta.url));

async function bundle(entry, options) {
  const result = await build({
    entryPoints: [path.join(here, entry)], absWorkingDir: here, bundle: true, minify: true, write: false, metafile: true,
    target: 'es2020', charset: 'utf8', legalComments: 'inline', logLevel: 'warning', ...options,
  });
  return { text: result.outputFiles[0].text.trim(), inputs: Object.keys(result.metafile.inputs) };
}

// A module imported as "FILE?text" is put in as the text of its bundle: what a worker is made of.
const asText = {
  name: 'text',
  setup({ onResolve, onLoad }) {
    onResolve({ filter: /\?text$/ }, ({ path: file, resolveDir }) => ({ path: path.resolve(resolveDir, file.replace(/\?text$/, '')), namespace: 'text' }));
    onLoad({ filter: /./, namespace: 'text' }, async ({ path: file }) => ({ contents: (await bundle(path.relative(here, file), { format: 'iife' })).text, loader: 'text' }));
  },
};

// A package's licence as its authors wrote it: a file, or the end of what it says of itself.
async function licenceOf(folder, licence) {
  const file = path.join(folder, 'LICENSE');
  if (existsSync(file)) return readFile(file, 'utf8');
  const [, text] = (await readFile(path.join(folder, 'README.md'), 'utf8')).split(`## ${licence}\n`);
  if (!text) throw new Error(`${folder}: it has no licence text`);
  return `${licence}\n${text}`;
}

// The licence texts of the packages that went in.
async function licences(inputs) {
  const packages = new Set(inputs.map((file) => /^node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(file)?.[1]).filter(Boolean));
  const texts = await Promise.all([...packages].sort().map(async (name) => {
    const folderOf = path.join(here, 'node_modules', name);
    const { version, license: licence } = JSON.parse(await readFile(path.join(folderOf, 'package.json'), 'utf8'));
    return `${name} ${version}\n\n${(await licenceOf(folderOf, licence)).trim()}`;
  }));
  return `/*!\n${texts.join('\n\n').replaceAll('*/', '* /')}\n*/\n`;
}

function timesIn(text, part) {
  return text.split(part).length - 1;
}

function place(page, name, mark, text) {
  if (timesIn(page, mark) !== 1) throw new Error(`${name}: ${mark} is not there exactly once`);
  return page.replace(mark, () => text);
}

/**
 * The text of the page of the folder `name`, made of its page.html, main.mjs and style.css. `parts`: [mark, text] of what else is
 * filled in; `markers` are left for the program to fill. `plugins`: of esbuild, for the script.
 */
export async function makePage(name, { parts = [], markers = [], plugins = [] }) {
  const [script, style, page] = await Promise.all([
    bundle(`${name}/main.mjs`, { format: 'iife', plugins: [asText, ...plugins] }), bundle(`${name}/style.css`, {}), readFile(path.join(here, name, 'page.html'), 'utf8'),
  ]);
  const code = (await licences([...script.inputs, ...style.inputs])) + script.text;
  if (/<\/script|<!--/i.test(code) || /<\/style/i.test(style.text)) throw new Error(`${name}: the script or the style would end its own element`);
  const hash = createHash('sha256').update(code).digest('base64');
  const all = [['@SCRIPT_HASH@', `'sha256-${hash}'`], ['@STYLE@', style.text], ['@SCRIPT@', code], ...parts];
  const html = all.reduce((text, [mark, part]) => place(text, name, mark, part), page);
  for (const marker of markers) {
    if (timesIn(html, marker) !== 1) throw new Error(`${name}: ${marker} is not there exactly once`);
  }
  return html;
}

// Builds report.html, the template of the pages of a run and a sweep, as one file: script and style inlined, and two markers left for the
// program to fill. Usage: node build.mjs [FOLDER]; default build/web of the repository.
import { createHash } from 'node:crypto';
import { mkdir, readFile, writeFile } from 'node:fs/promises';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const here = path.dirname(fileURLToPath(import.meta.url));
const folder = path.resolve(process.argv[2] ?? path.join(here, '..', 'build', 'web'));
const markers = ['@REPORT_DATA@', '@RECORDING@'];

async function bundle(entry, options) {
  const result = await build({
    entryPoints: [path.join(here, entry)], absWorkingDir: here, bundle: true, minify: true, write: false, metafile: true,
    target: 'es2020', charset: 'utf8', legalComments: 'inline', logLevel: 'warning', ...options,
  });
  return { text: result.outputFiles[0].text.trim(), inputs: Object.keys(result.metafile.inputs) };
}

// The licence texts of the packages that went in, as their authors wrote them.
async function licences(inputs) {
  const packages = new Set(inputs.map((file) => /^node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(file)?.[1]).filter(Boolean));
  const texts = await Promise.all([...packages].sort().map(async (name) => {
    const folderOf = path.join(here, 'node_modules', name);
    const { version } = JSON.parse(await readFile(path.join(folderOf, 'package.json'), 'utf8'));
    return `${name} ${version}\n\n${(await readFile(path.join(folderOf, 'LICENSE'), 'utf8')).trim()}`;
  }));
  return `/*!\n${texts.join('\n\n').replaceAll('*/', '* /')}\n*/\n`;
}

function timesIn(text, part) {
  return text.split(part).length - 1;
}

function place(page, mark, text) {
  if (timesIn(page, mark) !== 1) throw new Error(`page.html: ${mark} is not there exactly once`);
  return page.replace(mark, () => text);
}

const [script, style, page] = await Promise.all([
  bundle('report/main.mjs', { format: 'iife' }),
  bundle('report/style.css', {}),
  readFile(path.join(here, 'report', 'page.html'), 'utf8'),
]);
const code = (await licences([...script.inputs, ...style.inputs])) + script.text;
if (/<\/script|<!--/i.test(code) || /<\/style/i.test(style.text)) throw new Error('the script or the style would end its own element');
const hash = createHash('sha256').update(code).digest('base64');
const parts = [['@SCRIPT_HASH@', `'sha256-${hash}'`], ['@STYLE@', style.text], ['@SCRIPT@', code]];
const html = parts.reduce((text, [mark, part]) => place(text, mark, part), page);
for (const marker of markers) {
  if (timesIn(html, marker) !== 1) throw new Error(`report.html: ${marker} is not there exactly once`);
}
await mkdir(folder, { recursive: true });
await writeFile(path.join(folder, 'report.html'), html);
console.log(`${path.relative(process.cwd(), path.join(folder, 'report.html'))}: ${Math.round(html.length / 1000)} kB`);

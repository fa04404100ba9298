// Builds the templates of the pages that the program writes, one file each, with markers left for the program to fill: report.html, the same
// with the simulator, of a run in the plane, and studio.html. Usage: node build.mjs [FOLDER]; default build/web of the repository.
import { existsSync } from 'node:fs';
import { mkdir, readFile, writeFile } from 'node:fs/promises';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { makePage } from './make_page.mjs';

const here = path.dirname(fileURLToPath(import.meta.url));
const built = path.join(here, '..', 'build');
const folder = path.resolve(process.argv[2] ?? path.join(built, 'web'));

// The simulator as base64 of its gzip; nothing where it has not been built, which the page then says.
async function moduleText(name) {
  const file = path.join(built, 'wasm', 'web', 'core', `simulator-${name}.wasm`);
  return existsSync(file) ? gzipSync(await readFile(file), { level: 9 }).toString('base64') : '';
}

async function write(file, html) {
  await writeFile(path.join(folder, file), html);
  console.log(`${path.relative(process.cwd(), path.join(folder, file))}: ${Math.round(html.length / 1000)} kB`);
}

await mkdir(folder, { recursive: true });
const simd = await moduleText('simd');
const filled = { markers: ['@REPORT_DATA@', '@RECORDING@'] };
await write('report.html', await makePage('report', { ...filled, parts: [['@SIMULATOR_SIMD@', '']] }));
await write('report-with-simulator.html', await makePage('report', { ...filled, parts: [['@SIMULATOR_SIMD@', simd]] }));
const parts = [['@SIMULATOR_SIMD@', simd], ['@SIMULATOR_SCALAR@', await moduleText('scalar')]];
await write('studio.html', await makePage('studio', { markers: ['@STUDIO_DATA@'], parts }));

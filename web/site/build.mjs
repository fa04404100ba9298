// Builds the site: the documents, and whatever they link to, as pages beside each other, with the studio and examples of reports.
// Usage: node web/site/build.mjs FOLDER MADE, which holds studio/studio.html and NAME/report.html of each example; scripts/site makes it.
import { copyFileSync, existsSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { makePage } from '../make_page.mjs';
import { contentOf, escapeHtml, lookedUp, pageOf } from './documents.mjs';

const root = fileURLToPath(new URL('../..', import.meta.url));
const made = [
  { from: 'studio/studio.html', page: 'studio.html', name: 'The studio' },
  { from: 'run/report.html', page: 'example-run/report.html', name: 'A report: a run in the plane' },
  { from: 'run-in-space/report.html', page: 'example-run-in-space/report.html', name: 'A report: a run in space' },
];

const titleOf = (source) => /^# (.*)$/m.exec(readFileSync(path.join(root, source), 'utf8'))[1];
const there = (sources) => sources.filter((source) => existsSync(path.join(root, source)));
const entries = (sources) => sources.map((source) => ({ page: pageOf(source), name: titleOf(source), source }));
const byName = (list) => list.sort((a, b) => (a.name < b.name ? -1 : 1));

/** The documents of a folder; a README first. */
function documentsIn(folder) {
  if (!existsSync(path.join(root, folder))) return [];
  const names = readdirSync(path.join(root, folder)).filter((name) => name.endsWith('.md'));
  const index = names.filter((name) => name === 'README.md');
  return [...index, ...names.filter((name) => name !== 'README.md')].map((name) => `${folder}/${name}`);
}

/** Headings of the menu, each with what stands under it: { page, name, source of a document }. */
function menuGroups() {
  const front = there(['reports/gallery/README.md', 'reports/pages/README.md']);
  const reports = readdirSync(path.join(root, 'reports')).map((name) => `reports/${name}/README.md`);
  const findings = there(['reports/FINDINGS.md', 'reports/performance.md', 'reports/README.md', ...reports.filter((source) => !front.includes(source))]);
  return [
    ['Vibrosow', [{ page: 'index.html', name: 'What it is', source: 'README.md' }, ...made, ...entries(front), ...entries(documentsIn('docs'))]],
    ['Tutorials', byName(entries(documentsIn('docs/tutorials')))],
    ['How to', byName(entries(documentsIn('docs/how-to')))],
    ['Reference', entries(['seeders/FORMAT.md', ...documentsIn('docs/reference'), 'python/README.md', 'ARCHITECTURE.md', 'CONTRIBUTING.md', 'CHANGELOG.md'])],
    ['Explanation', byName(entries(documentsIn('docs/explanation')))],
    ['Findings', entries(findings)],
  ].filter(([, list]) => list.length > 0);
}

const addressFrom = (page, other) => encodeURI(path.posix.relative(path.posix.dirname(page), other));

function menu(groups, page) {
  return groups.map(([heading, list]) => `<h2>${heading}</h2><ul>${list.map((entry) =>
    `<li><a href="${addressFrom(page, entry.page)}"${entry.page === page ? ' aria-current="page"' : ''}>${escapeHtml(entry.name)}</a></li>`).join('')}</ul>`).join('');
}

/** What the site holds of the repository, by its source; what is linked to is added while pages are written. */
class Queue {
  constructor() {
    this.found = new Map();
    this.waiting = [];
  }

  /** The place of a source in the site. */
  placeOf(source) {
    const looked = lookedUp(root, source);
    if (!this.found.has(looked.source)) {
      this.found.set(looked.source, looked.kind === 'picture' ? looked.source : pageOf(looked.source, looked.kind));
      this.waiting.push(looked);
    }
    return this.found.get(looked.source);
  }
}

function linkIn(queue, source, kind, page) {
  const folder = kind === 'folder' ? source : path.posix.dirname(source);
  return (target) => {
    if (/^(?:[a-z]+:|#)/i.test(target)) return target;
    const [, file, anchor] = /^([^#]*)(#.*)?$/.exec(target);
    const wanted = path.posix.join(folder, decodeURI(file));
    if (wanted.startsWith('..')) throw new Error(`${source}: a link leads out of the repository: ${target}`);
    try {
      return addressFrom(page, queue.placeOf(wanted.replace(/\/$/, ''))) + (anchor ?? '');
    } catch (error) {
      throw new Error(`${source}: ${error.message}`);
    }
  };
}

/** The path of a place in the site, whose folder is there. */
function roomFor(folder, place) {
  const file = path.join(folder, place);
  mkdirSync(path.dirname(file), { recursive: true });
  return file;
}

/** Writes the site into `folder`, in place of what was there. Returns how many pages it has. */
export async function buildSite(folder, madeIn) {
  const template = await makePage('site', { markers: ['@TITLE@', '@INDEX@', '@CONTENT@', '@MENU@'] });
  const groups = menuGroups();
  const queue = new Queue();
  groups.flatMap(([, list]) => list).forEach(({ source }) => source && queue.placeOf(source));
  rmSync(folder, { recursive: true, force: true });
  for (const { from, page } of made) copyFileSync(path.join(madeIn, from), roomFor(folder, page));
  let pages = made.length;
  while (queue.waiting.length > 0) {
    const { source, kind } = queue.waiting.shift();
    const page = queue.found.get(source);
    if (kind === 'picture' || kind === 'text') copyFileSync(path.join(root, source), roomFor(folder, source));
    if (source.endsWith('.html')) ++pages;
    if (kind === 'picture') continue;
    const { title, html } = contentOf(root, { source, kind }, linkIn(queue, source, kind, page));
    const parts = { TITLE: escapeHtml(title === 'Vibrosow' ? title : `${title} – Vibrosow`), INDEX: addressFrom(page, 'index.html'), CONTENT: html, MENU: menu(groups, page) };
    writeFileSync(roomFor(folder, page), template.replace(/@(TITLE|INDEX|CONTENT|MENU)@/g, (_, name) => parts[name]));
    ++pages;
  }
  return pages;
}

if (process.argv[1] && import.meta.url === pathToFileURL(process.argv[1]).href) {
  const [folder, madeIn] = process.argv.slice(2);
  console.log(`${path.join(folder, 'index.html')}: ${await buildSite(folder, madeIn)} pages`);
}

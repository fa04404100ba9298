// Builds the site: the documents, and whatever they link to, as pages beside each other, with the studio and examples of reports.
// Usage: node web/site/build.mjs FOLDER MADE, which holds studio/studio.html and NAME/report.html of each example; scripts/site makes it.
import { copyFileSync, mkdirSync, rmSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { build } from 'esbuild';
import { makePage } from '../make_page.mjs';
import { contentOf, escapeHtml, lookedUp, pageOf } from './documents.mjs';
import { withStart } from './front.mjs';
import { addressFrom, made, menu, menuGroups } from './menu.mjs';

const here = path.dirname(fileURLToPath(import.meta.url));
const repository = path.join(here, '../..');

/** What the site holds of the repository, by its source; what is linked to is added while pages are written. */
class Queue {
  constructor(root) {
    this.root = root;
    this.found = new Map();
    this.waiting = [];
  }

  /** The place of a source in the site. */
  placeOf(source) {
    const looked = lookedUp(this.root, source);
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
    if (wanted.startsWith('..')) throw new Error(`a link leads out of the repository: ${target}`);
    return addressFrom(page, queue.placeOf(wanted.replace(/\/$/, ''))) + (anchor ?? '');
  };
}

/** The path of a place in the site, whose folder is there. */
function roomFor(folder, place) {
  const file = path.join(folder, place);
  mkdirSync(path.dirname(file), { recursive: true });
  return file;
}

// A guide comes before a change or a report that has the same words.
const weightOf = (page) => (/^(?:docs|seeders|python|index)\b/.test(page) ? 1 : 0.5);

/** The search and all texts that it finds, as one script. `pages` as find.mjs takes them. */
async function searchScript(pages) {
  const { outputFiles } = await build({
    entryPoints: [path.join(here, 'find.mjs')], bundle: true, minify: true, write: false,
    format: 'iife', globalName: 'vibrosowSearch', target: 'es2020', charset: 'utf8',
  });
  return `${outputFiles[0].text}var vibrosowIndex=vibrosowSearch.indexOf(${JSON.stringify(pages)});\n`;
}

/** Writes the site of the repository at `root` into `folder`, in place of what was there. Returns how many pages it has. */
export async function buildSite(folder, madeIn, root = repository) {
  const template = await makePage('site', { markers: ['@TITLE@', '@INDEX@', '@CONTENTS@', '@CONTENT@', '@MENU@'] });
  const groups = menuGroups(root);
  const queue = new Queue(root);
  const toFind = [];
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
    try {
      const { title, html, contents, sections } = contentOf(root, { source, kind }, linkIn(queue, source, kind, page));
      const content = page === 'index.html' ? withStart(html, root, groups, queue) : html;
      const parts = {
        TITLE: escapeHtml(title === 'Vibrosow' ? title : `${title} – Vibrosow`), INDEX: addressFrom(page, 'index.html'),
        CONTENTS: contents, CONTENT: content, MENU: menu(groups, page),
      };
      writeFileSync(roomFor(folder, page), template.replace(/@(TITLE|INDEX|CONTENTS|CONTENT|MENU)@/g, (_, name) => parts[name]));
      if (sections.length > 0) toFind.push([encodeURI(page), weightOf(page), ...sections]);
    } catch (error) {
      throw new Error(`${source}: ${error.message}`, { cause: error });
    }
    ++pages;
  }
  writeFileSync(path.join(folder, 'search-index.js'), await searchScript(toFind));
  return pages;
}

if (process.argv[1] && import.meta.url === pathToFileURL(process.argv[1]).href) {
  const [folder, madeIn] = process.argv.slice(2);
  console.log(`${path.join(folder, 'index.html')}: ${await buildSite(folder, madeIn)} pages`);
}

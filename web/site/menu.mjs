// The menu: the documents by their purpose, tutorials first.
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import path from 'node:path';
import { escapeHtml, pageOf } from './documents.mjs';

export const made = [
  { from: 'studio/studio.html', page: 'studio.html', name: 'The studio', picture: 'reports/pages/studio-playing.jpg', says: 'Draw a tray and watch it sow, in this browser.' },
  { from: 'run/report.html', page: 'example-run/report.html', name: 'A report of a run in 2D', picture: 'reports/pages/run-desktop.jpg', says: 'Every seed of a wheat tray, and what each hole sowed.' },
  { from: 'run-in-space/report.html', page: 'example-run-in-space/report.html', name: 'A report of a run in 3D' },
];

// Each heading with its folder, and what belongs there from elsewhere: `first` before the folder's pages, `last` after them.
const purposes = [
  { heading: 'Tutorials', folder: 'docs/tutorials' },
  { heading: 'How-to', folder: 'docs/how-to', last: ['CONTRIBUTING.md'] },
  { heading: 'Reference', folder: 'docs/reference', first: ['seeders/FORMAT.md'], last: ['python/README.md', 'CHANGELOG.md'] },
  { heading: 'Explanation', folder: 'docs/explanation', last: ['ARCHITECTURE.md'] },
  { heading: 'Findings', first: ['reports/FINDINGS.md', 'reports/performance.md', 'reports/README.md'] },
  { heading: 'Other documents', folder: 'docs' },
];

/** Headings of the menu, each with what stands under it: { page, name, source of a document }. The first has no heading. */
export function menuGroups(root) {
  const there = (source) => existsSync(path.join(root, source));
  const read = (source) => readFileSync(path.join(root, source), 'utf8');
  const titleOf = (source) => (/^# (.*)$/m.exec(read(source))?.[1] ?? source).replaceAll('`', '');
  const entries = (sources) => sources.filter(there).map((source) => ({ page: pageOf(source), name: titleOf(source), source }));

  // Pages of a folder stand in the order of their links in docs/README.md; what it does not link to follows by name.
  const index = there('docs/README.md') ? [...read('docs/README.md').matchAll(/\]\(([^)#]+)/g)].map(([, target]) => path.posix.join('docs', target)) : [];
  const rank = (source) => (index.includes(source) ? index.indexOf(source) : index.length);
  const inFolder = (folder) => (folder && there(folder) ? readdirSync(path.join(root, folder)) : []).filter((name) => name.endsWith('.md') && name !== 'README.md').sort()
    .map((name) => `${folder}/${name}`).sort((a, b) => rank(a) - rank(b));

  const front = entries(['docs/README.md', 'reports/gallery/README.md', 'reports/pages/README.md']);
  const groups = purposes.map(({ heading, folder, first = [], last = [] }) => [heading, entries([...first, ...inFolder(folder), ...last])]);
  return [['', [{ page: 'index.html', name: 'What it is', source: 'README.md' }, ...made, ...front]], ...groups.filter(([, list]) => list.length > 0)];
}

export const addressFrom = (page, other) => encodeURI(path.posix.relative(path.posix.dirname(page), other));

/** The menu on `page`. The tutorials are unfolded, and where the page stands; on a page that stands nowhere, as the first, what one can do too. */
export function menu(groups, page) {
  const holds = (list) => list.some((entry) => entry.page === page);
  const isListed = groups.some(([heading, list]) => heading && holds(list));
  const items = (list) => `<ul>${list.map((entry) =>
    `<li><a href="${addressFrom(page, entry.page)}"${entry.page === page ? ' aria-current="page"' : ''}>${escapeHtml(entry.name)}</a></li>`).join('')}</ul>`;
  return groups.map(([heading, list]) => {
    if (!heading) return items(list);
    const open = heading === 'Tutorials' || holds(list) || (!isListed && heading === 'How-to');
    return `<details${open ? ' open' : ''}><summary>${heading}</summary>${items(list)}</details>`;
  }).join('');
}

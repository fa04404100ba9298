// The site's documents: markdown, listings of folders and texts, as pages whose links lead to pages of the site.
import { readFileSync, readdirSync, statSync } from 'node:fs';
import path from 'node:path';
import { markdown } from './markdown.mjs';

const pictures = new Set(['.png', '.jpg', '.gif', '.svg', '.webp']);
export const { escapeHtml } = markdown.utils;

const isDocument = (file) => file.endsWith('.md');
// Taken as it is, and so is a page that a report holds.
const isPicture = (file) => pictures.has(path.extname(file)) || file.endsWith('.html');

/** Where the page of `source` stands in the site; both are paths with / from the top of the repository and of the site. */
export function pageOf(source, kind) {
  if (source === 'README.md') return 'index.html';
  if (kind === 'folder') return path.posix.join(source, 'index.html');
  if (path.posix.basename(source) === 'README.md') return path.posix.join(path.posix.dirname(source), 'index.html');
  return isDocument(source) ? source.replace(/\.md$/, '.html') : `${source}.html`;
}

/** What `source` is: "document", "picture", "folder" or "text". A folder that says in a README.md what is in it is that document. Throws where nothing is there. */
export function lookedUp(root, source) {
  const found = statSync(path.join(root, source), { throwIfNoEntry: false });
  if (!found) throw new Error(`there is no ${source}`);
  if (!found.isDirectory()) return { source, kind: isDocument(source) ? 'document' : isPicture(source) ? 'picture' : 'text' };
  const told = path.posix.join(source, 'README.md');
  return statSync(path.join(root, told), { throwIfNoEntry: false }) ? { source: told, kind: 'document' } : { source, kind: 'folder' };
}

// As GitHub names a heading's anchor.
function anchorsOf() {
  const times = new Map();
  return (text) => {
    const named = text.toLowerCase().replace(/[^\p{L}\p{M}\p{N}\s_-]/gu, '').trim().replace(/\s/g, '-');
    let anchor = named;
    while (times.has(anchor)) {
      times.set(named, times.get(named) + 1);
      anchor = `${named}-${times.get(named)}`;
    }
    times.set(anchor, 0);
    return anchor;
  };
}

const plainText = (token) => (token.children ?? [token]).map(({ type, content }) => (type.endsWith('break') ? ' ' : content)).join('');

// What is read in a section, for the search: [anchor, heading, text] of the title and of each heading below it.
function sectionsOf(tokens) {
  const sections = [];
  tokens.forEach((token, k) => {
    if (/^h[1-3]$/.test(token.tag) && token.nesting === 1) sections.push([token.attrGet('id'), plainText(tokens[k + 1]), '']);
    else if (/^(?:inline|fence|code_block)$/.test(token.type) && sections.length > 0 && !/^h[1-3]$/.test(tokens[k - 1]?.tag)) sections.at(-1)[2] += `${plainText(token)} `;
  });
  return sections.map(([anchor, heading, text]) => [anchor, heading, text.replace(/\s+/g, ' ').trim()]);
}

// A heading leads to itself, so that its address can be copied; one that is or holds a link is left alone. The title is the page's.
function linkToItself(heading, inline, Token) {
  if (heading.tag === 'h1' || inline.children.some(({ type }) => type === 'link_open')) return;
  const link = new Token('link_open', 'a', 1);
  link.attrs = [['class', 'itself'], ['href', `#${encodeURIComponent(heading.attrGet('id'))}`]];
  inline.children = [link, ...inline.children, new Token('link_close', 'a', -1)];
}

/** The page's own contents: its headings of the second and third rank; nothing where there are hardly any. */
function contentsOf(headings) {
  if (headings.length < 2) return '';
  const items = headings.map(({ tag, id, html }) => `<li class="${tag}"><a href="#${encodeURIComponent(id)}">${html}</a></li>`).join('');
  return `<nav id="contents" aria-label="On this page"><details><summary>On this page</summary><ul>${items}</ul></details></nav>`;
}

/** `link(target)`: the address, in the site, of what a document calls `target`. Gives the page's title, content and contents as HTML, and its sections as text. */
function readDocument(text, link) {
  const tokens = markdown.parse(text.replace(/^<!--.*-->\n/gm, ''), {});
  const anchor = anchorsOf();
  const headings = [];
  for (const child of tokens.flatMap(({ children }) => children ?? [])) {
    for (const attribute of ['href', 'src']) {
      const target = child.attrGet(attribute);
      if (target !== null) child.attrSet(attribute, link(target));
    }
  }
  tokens.forEach((token, k) => {
    if (token.type === 'heading_open') token.attrSet('id', anchor(plainText(tokens[k + 1])));
  });
  const sections = sectionsOf(tokens);
  tokens.forEach((token, k) => {
    if (token.type !== 'heading_open') return;
    const inline = tokens[k + 1];
    if (/^h[23]$/.test(token.tag)) {
      const unlinked = inline.children.filter(({ type }) => !type.startsWith('link_'));
      headings.push({ tag: token.tag, id: token.attrGet('id'), html: markdown.renderer.renderInline(unlinked, markdown.options, {}) });
    }
    linkToItself(token, inline, token.constructor);
  });
  const html = markdown.renderer.render(tokens, markdown.options, {});
  return { title: sections[0]?.[1] ?? '', html: scrollable(html), contents: contentsOf(headings), sections };
}

// A table that is wider than a phone scrolls by itself, by the keyboard too; a head without words is no head.
function scrollable(html) {
  let tables = 0;
  return html.replace(/<th( [^>]*)?><\/th>/g, '<td$1></td>')
    .replaceAll('<table>', () => `<div class="table-frame" tabindex="0" role="region" aria-label="Table ${++tables}"><table>`).replaceAll('</table>', '</table></div>');
}

const nothingToFind = { contents: '', sections: [] };

function listing(root, source, link) {
  const names = readdirSync(path.join(root, source)).filter((name) => !/^[._]|^cases$/.test(name)).sort();
  const items = names.map((name) => `<li><a href="${escapeHtml(link(encodeURI(name)))}">${escapeHtml(name)}</a></li>`).join('\n');
  return { ...nothingToFind, title: source, html: `<h1>${escapeHtml(source)}</h1>\n<ul>\n${items}\n</ul>` };
}

function plain(text, source, raw) {
  const name = escapeHtml(path.posix.basename(source));
  return { ...nothingToFind, title: source, html: `<h1>${escapeHtml(source)}</h1>\n<p><a href="${escapeHtml(raw)}" download>Save ${name}</a></p>\n<pre tabindex="0"><code>${escapeHtml(text)}</code></pre>` };
}

/** The page of what was looked up. `link` takes what is written in it, relative to its folder. */
export function contentOf(root, { source, kind }, link) {
  if (kind === 'folder') return listing(root, source, link);
  const text = readFileSync(path.join(root, source), 'utf8');
  return kind === 'document' ? readDocument(text, link) : plain(text, source, encodeURI(path.posix.basename(source)));
}

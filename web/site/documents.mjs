// The site's documents: markdown, listings of folders and texts, as pages whose links lead to pages of the site.
import { readFileSync, readdirSync, statSync } from 'node:fs';
import path from 'node:path';
import markdownIt from 'markdown-it';

const markdown = markdownIt({ html: false });
const pictures = new Set(['.png', '.jpg', '.gif', '.svg']);
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
  const used = new Map();
  return (text) => {
    const plain = text.toLowerCase().replace(/[^\p{L}\p{N}\s_-]/gu, '').trim().replace(/\s/g, '-');
    const times = used.get(plain) ?? 0;
    used.set(plain, times + 1);
    return times ? `${plain}-${times}` : plain;
  };
}

const plainText = (token) => token.children.map(({ content }) => content).join('');

/** `link(target)`: the address, in the site, of what a document calls `target`. Gives the title and the content as HTML. */
function readDocument(text, link) {
  const tokens = markdown.parse(text.replace(/^<!--.*-->\n/gm, ''), {});
  const anchor = anchorsOf();
  let title = '';
  tokens.forEach((token, k) => {
    if (token.type === 'heading_open') {
      const name = plainText(tokens[k + 1]);
      title ||= name;
      token.attrSet('id', anchor(name));
    }
    for (const child of token.children ?? []) {
      for (const attribute of ['href', 'src']) {
        const target = child.attrGet(attribute);
        if (target !== null) child.attrSet(attribute, link(target));
      }
    }
  });
  const html = markdown.renderer.render(tokens, markdown.options, {});
  return { title, html: scrollable(html) };
}

// What is wider than a phone scrolls by itself, by the keyboard too.
function scrollable(html) {
  let tables = 0;
  return html
    .replaceAll('<table>', () => `<div class="table-frame" tabindex="0" role="region" aria-label="Table ${++tables}"><table>`).replaceAll('</table>', '</table></div>')
    .replaceAll('<pre>', '<pre tabindex="0">');
}

function listing(root, source, link) {
  const names = readdirSync(path.join(root, source)).filter((name) => !/^[._]|^cases$/.test(name)).sort();
  const items = names.map((name) => `<li><a href="${escapeHtml(link(encodeURI(name)))}">${escapeHtml(name)}</a></li>`).join('\n');
  return { title: source, html: `<h1>${escapeHtml(source)}</h1>\n<ul>\n${items}\n</ul>` };
}

function plain(text, source, raw) {
  const name = escapeHtml(path.posix.basename(source));
  return { title: source, html: `<h1>${escapeHtml(source)}</h1>\n<p><a href="${escapeHtml(raw)}" download>Save ${name}</a></p>\n<pre tabindex="0"><code>${escapeHtml(text)}</code></pre>` };
}

/** The page of what was looked up. `link` takes what is written in it, relative to its folder. */
export function contentOf(root, { source, kind }, link) {
  if (kind === 'folder') return listing(root, source, link);
  const text = readFileSync(path.join(root, source), 'utf8');
  return kind === 'document' ? readDocument(text, link) : plain(text, source, encodeURI(path.posix.basename(source)));
}

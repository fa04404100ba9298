// The page itself as one file, with the layouts that are on it: whoever opens it needs nothing else.

const script = 'studio-data';

function inScript(data) {
  return JSON.stringify(data).replaceAll('<', '\\u003c');
}

/**
 * The file's text: `page`, the document as it was written, with `sent`, a fragment that holds layouts, in its data. What the page's
 * script has made of the document is left out; the script makes it again.
 */
export function oneFile(page, sent) {
  const root = page.documentElement.cloneNode(true);
  for (const { name } of [...root.attributes]) if (name.startsWith('data-')) root.removeAttribute(name);
  for (const id of ['head', 'page', 'foot']) root.querySelector(`#${id}`).replaceChildren();
  const data = root.querySelector(`#${script}`);
  data.textContent = inScript({ ...JSON.parse(data.textContent), sent });
  return `<!doctype html>\n${root.outerHTML}\n`;
}

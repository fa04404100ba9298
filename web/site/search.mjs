// The field that finds words in all documents. The index is a script of its own, since a page opened as a file can fetch nothing else. It is
// loaded once the field is used: 'strict-dynamic' in the page's policy lets this script load another, and nothing else in the page.
import { element } from '../report/dom.mjs';

/** Runs the script of the index, which leaves `vibrosowIndex`; `root` is the site's address. */
function loadIndex(root) {
  return new Promise((resolve, reject) => {
    const script = element('script', { src: new URL('search-index.js', root).href, onload: () => resolve(globalThis.vibrosowIndex), onerror: reject });
    document.head.append(script);
  });
}

function resultOf(root, { address, title, heading, context }) {
  return element('li', {}, element('a', { href: new URL(address, root).href },
    element('strong', {}, heading), heading === title ? null : element('span', { class: 'muted' }, ` ${title}`),
    element('span', { class: 'context' }, context.map((piece, k) => (k % 2 ? element('mark', {}, piece) : piece)))));
}

export function searchField(root) {
  const placeholder = matchMedia('(hover: hover)').matches ? 'Search: press /' : 'Search';  // a phone has no key to press
  const field = element('input', { type: 'search', placeholder, 'aria-label': 'Search all documents', 'aria-keyshortcuts': '/', autocomplete: 'off', spellcheck: 'false', enterkeyhint: 'go' });
  const said = element('p', { role: 'status', class: 'unseen' });
  const list = element('ol', { class: 'results', 'aria-label': 'Results', hidden: true });
  const whole = element('div', { class: 'search', role: 'search' }, field, said, list);
  const links = () => [...list.querySelectorAll('a')];
  let index = null;

  function show(results, words) {
    list.replaceChildren(...results.map((result) => resultOf(root, result)));
    list.hidden = results.length === 0;
    said.textContent = !words ? '' : results.length > 0 ? `${results.length} ${results.length > 1 ? 'results' : 'result'}` : `Nothing found for “${words}”`;
    said.className = words && results.length === 0 ? 'nothing' : 'unseen';
  }

  async function search() {
    index ??= loadIndex(root);
    try {
      const find = await index;
      const words = field.value.trim();
      show(words ? find(words) : [], words);
    } catch {
      said.textContent = 'The index of the documents could not be read.';
      said.className = 'nothing';
    }
  }

  const close = () => show([], '');
  field.addEventListener('input', search);
  field.addEventListener('focus', search);
  whole.addEventListener('focusout', ({ relatedTarget }) => { if (!whole.contains(relatedTarget)) close(); });
  list.addEventListener('click', ({ target }) => { if (target.closest('a')) close(); });
  whole.addEventListener('keydown', (event) => {
    const all = links();
    const at = all.indexOf(document.activeElement);  // -1: the field
    if (event.key === 'ArrowDown') all[Math.min(at + 1, all.length - 1)]?.focus();
    else if (event.key === 'ArrowUp' && at >= 0) (all[at - 1] ?? field).focus();
    else if (event.key === 'Enter' && at < 0) all[0]?.click();
    else if (event.key === 'Escape') {
      field.value = '';
      field.focus();
      close();
    } else return;
    event.preventDefault();
  });
  document.addEventListener('keydown', (event) => {
    if (event.key !== '/' || event.ctrlKey || event.metaKey || event.altKey || event.target.closest('input, textarea, select')) return;
    event.preventDefault();
    field.select();
    field.focus();
  });
  return whole;
}

// A text as a file of the reader's.
import { element } from '../report/dom.mjs';

export function saveText(text, name, type) {
  const url = URL.createObjectURL(new Blob([text], { type }));
  element('a', { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}

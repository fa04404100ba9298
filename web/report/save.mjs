// Files for the reader to keep.
import { element } from './dom.mjs';

export function saveBlob(blob, name) {
  const url = URL.createObjectURL(blob);
  element('a', { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}

export function saveText(text, name, type) {
  saveBlob(new Blob([text], { type }), name);
}

// What was made is kept in the browser, so that it is there after a reload. A browser may refuse.

// FNV-1a: a page whose seeders or program are others does not take up what was made of these.
function digest(text) {
  let hash = 0x811c9dc5;
  for (let k = 0; k < text.length; ++k) hash = Math.imul(hash ^ text.charCodeAt(k), 0x01000193);
  return `${(hash >>> 0).toString(16)}-${text.length}`;
}

export class Kept {
  /** Of the page at the path `place` with `text`, its data. `storage()` gives the browser's, or throws. */
  constructor(storage, place, text) {
    Object.assign(this, { storage, name: `vibrosow-studio ${place}`, mark: digest(text) });
  }

  /** What was kept of this page; empty where nothing was. */
  read() {
    try {
      const { mark, made } = JSON.parse(this.storage().getItem(this.name)) ?? {};
      return mark === this.mark && typeof made === 'string' ? made : '';
    } catch {
      return '';
    }
  }

  /** Whether the browser has kept it. */
  write(made) {
    try {
      this.storage().setItem(this.name, JSON.stringify({ mark: this.mark, made }));
      return true;
    } catch {
      return false;
    }
  }
}

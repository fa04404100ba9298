// The layout that the reader looks at: one for the whole page, kept in the address (#layout=7).

function numberIn(hash) {
  const match = /^#layout=(\d+)$/.exec(hash);
  return match ? Number(match[1]) : null;
}

export class ChosenLayout {
  /** `otherwise`: the number of the layout where the address names none. */
  constructor(layouts, otherwise) {
    this.layouts = layouts;
    this.otherwise = otherwise;
    this.listeners = [];
    this.read();
    addEventListener('hashchange', () => {
      this.read();
      this.tell();
    });
  }

  read() {
    const asked = numberIn(location.hash);
    this.number = this.layouts.find(({ number, same = [] }) => number === asked || same.some((twin) => twin.number === asked))?.number ?? this.otherwise;
  }

  get layout() {
    return this.layouts.find((layout) => layout.number === this.number) ?? null;
  }

  choose(number) {
    if (number === this.number && numberIn(location.hash) === number) this.tell();
    else location.hash = `layout=${number}`;
  }

  /** `listener` is called at once and at every change, with whether the reader chose. */
  onChange(listener) {
    this.listeners.push(listener);
    listener(false);
  }

  tell() {
    this.listeners.forEach((listener) => listener(true));
  }
}

// All layouts in a table: sorted by any column, with the figures that the reader wants.
import { element, section } from './dom.mjs';
import { textOf, titleOf, valueOf } from './layout_figures.mjs';
import { keyWords } from './layout_words.mjs';
import { numbersOf } from './same_layouts.mjs';

const shownAtFirst = ['rate_g_per_s', 'unevenness_cv_percent', 'instability_cv_percent', 'longest_pause_s', 'spilled_percent', 'misfit_percent'];

function asNumber(text) {
  return text !== '' && Number.isFinite(Number(text)) ? Number(text) : text;
}

// Numbers by size, texts by the alphabet; what is empty comes last either way.
function compare(a, b, sign) {
  const [noA, noB] = [a, b].map((value) => value === null || value === '');
  if (noA || noB) return noA - noB;
  if (typeof a === 'number' && typeof b === 'number') return sign * (a - b);
  return sign * String(a).localeCompare(String(b), 'en', { numeric: true });
}

function edgeMark() {
  return element('span', { class: 'at-edge' }, ' ⊣', element('span', { class: 'unseen' }, ' end of its range'));
}

class LayoutTable {
  constructor(data, figures, chosen, filter) {
    Object.assign(this, { data, figures, chosen, sort: 'number', sign: 1 });
    this.wanted = new Set(figures.filter((figure) => data.kind !== 'sweep' || shownAtFirst.includes(figure.name)));
    this.table = element('table', { class: 'layouts' });
    const boxes = figures.map((figure) => element('label', { class: 'switch' },
      element('input', { type: 'checkbox', checked: this.wanted.has(figure), onchange: (event) => this.want(figure, event.target.checked) }), element('span', {}, titleOf(figure))));
    this.frame = element('div', {}, element('details', { class: 'card columns-choice' }, element('summary', {}, 'Figures in the table'), element('div', { class: 'choices' }, boxes)),
      element('div', { class: 'table-frame tall', tabindex: '0', role: 'region', 'aria-label': 'Table of all layouts' }, this.table),
      data.layouts.some((layout) => layout.at_edge.length) ? element('p', { class: 'muted' }, '⊣: at the end of the range that was searched; better ones may lie beyond.') : null);
    this.show();
    chosen.onChange(() => this.mark());
    filter.onChange((shown) => { this.data = shown; this.show(); });
  }

  want(figure, wanted) {
    if (wanted) this.wanted.add(figure);
    else this.wanted.delete(figure);
    this.show();
  }

  // { id, name, unit, of (what is sorted by), text }
  columns() {
    const { data } = this;
    const has = (part) => data.layouts.some(part);
    return [
      { id: 'number', name: 'layout', of: (layout) => layout.number, text: numbersOf },
      ...(has((layout) => layout.name) ? [{ id: 'name', name: 'name', of: (layout) => layout.name }] : []),
      ...keyWords(data.keys).map(({ words, unit }, k) => ({ id: `key-${k}`, name: words, unit, of: (layout) => asNumber(layout.values[k] ?? ''), isEdge: (layout) => layout.at_edge.includes(k) })),
      { id: 'status', name: 'status', of: (layout) => layout.standing ?? layout.status },
      ...(has((layout) => layout.replicates !== data.layouts[0]?.replicates) ? [{ id: 'replicates', name: 'runs', of: (layout) => layout.replicates }] : []),
      ...this.figures.filter((figure) => this.wanted.has(figure)).map((figure) => ({
        id: figure.name, name: figure.words, unit: figure.unit, isFigure: true,
        of: (layout) => valueOf(layout, figure)?.value ?? null, text: (layout) => textOf(valueOf(layout, figure)),
      })),
    ];
  }

  sortBy(id) {
    this.sign = this.sort === id ? -this.sign : 1;
    this.sort = id;
    this.show();
    this.table.querySelector(`th button[data-column="${CSS.escape(id)}"]`)?.focus();
  }

  show() {
    const columns = this.columns();
    const by = columns.find((column) => column.id === this.sort) ?? columns[0];
    const rows = [...this.data.layouts].sort((a, b) => compare(by.of(a), by.of(b), this.sign) || a.number - b.number);
    columns.forEach((column) => { column.numeric = column.isFigure || this.data.layouts.every((layout) => typeof column.of(layout) === 'number'); });
    this.table.replaceChildren(element('caption', { class: 'unseen' }, 'All layouts. A press on a heading sorts by it.'),
      element('thead', {}, element('tr', {}, columns.map((column) => this.heading(column, by)))),
      element('tbody', {}, rows.map((layout) => this.row(layout, columns))));
    this.mark();
  }

  heading(column, by) {
    const sorted = column === by ? (this.sign > 0 ? 'ascending' : 'descending') : null;
    return element('th', { scope: 'col', class: column.numeric ? 'number' : null, 'aria-sort': sorted },
      element('button', { type: 'button', class: 'sort', 'data-column': column.id, onclick: () => this.sortBy(column.id) },
        column.name, column.unit ? element('span', { class: 'unit' }, ` ${column.unit}`) : null,
        element('span', { class: 'arrow', 'aria-hidden': 'true' }, sorted ? (this.sign > 0 ? ' ▲' : ' ▼') : '')));
  }

  row(layout, columns) {
    const cells = columns.map((column, k) => {
      const content = column.text ? column.text(layout) : String(column.of(layout) ?? '');
      const align = column.numeric ? 'number' : null;
      if (k > 0) return element('td', { class: align }, content, column.isEdge?.(layout) ? edgeMark() : null);
      return element('th', { scope: 'row', class: align }, element('button', { type: 'button', class: 'pick', 'aria-label': `Show layout ${content}` }, content));
    });
    return element('tr', { 'data-layout': layout.number, onclick: () => this.chosen.choose(layout.number) }, cells);
  }

  mark() {
    for (const row of this.table.querySelectorAll('tbody tr')) {
      const is = Number(row.dataset.layout) === this.chosen.number;
      row.toggleAttribute('data-chosen', is);
      row.querySelector('button').setAttribute('aria-pressed', String(is));
    }
  }
}

export function layoutTableSection(data, figures, chosen, filter) {
  return section('layouts', 'All layouts', new LayoutTable(data, figures, chosen, filter).frame);
}

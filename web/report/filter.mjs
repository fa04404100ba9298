// Which layouts are shown: by what they are told apart by, by what is wanted, and whether they can be compared.
import { element, listChoice } from './dom.mjs';
import { factorsOf } from './factorial.mjs';
import { valueOf } from './layout_figures.mjs';
import { eachOf } from './same_layouts.mjs';
import { wantedFields } from './wanted.mjs';

/** The layouts that have all these levels, [{ factor, level }], and whose value of `figure` is within `range`, where these are given. */
export function filtered(layouts, levels, figure = null, range = null) {
  const isWanted = (layout) => {
    const value = range && valueOf(layout, figure);
    return !range || (value && layout.compared && value.value >= range.low && value.value <= range.high);
  };
  return layouts.filter((layout) => eachOf(layout).some((one) => levels.every(({ factor, level }) => factor.of(one) === level)) && isWanted(layout));
}

/** A section of the page with the filter under its heading. */
export function withFilter(filter, part) {
  part.querySelector('h2').after(filter.frame);
  return part;
}

export class Filter {
  constructor(data, figures, wanted) {
    Object.assign(this, { data, wanted, listeners: [], levels: new Map(), asWanted: false, figure: figures.find(({ name }) => name === wanted.figure) ?? null });
    this.said = element('p', { class: 'muted', id: 'filter-sentence', role: 'status' });
    const any = { value: null, text: 'any' };
    const lists = factorsOf(data).filter(({ levels }) => levels.length > 1).map((factor) => listChoice(`Only ${factor.name}`, [any, ...factor.levels.map((level) => ({ value: level, text: level || '–' }))], null, (level) => {
      this.levels.set(factor, level);
      this.change();
    }));
    const fields = wantedFields(wanted, figures);
    const box = element('input', { type: 'checkbox', onchange: () => { this.asWanted = box.checked; this.change(); } });
    this.frame = element('div', { class: 'filter' }, element('div', { class: 'choices' }, fields, fields ? element('label', { class: 'switch' }, box, element('span', {}, 'Only layouts with it')) : null, lists), this.said);
    wanted.onChange(() => this.change());
    this.say(data.layouts.length);
  }

  change() {
    const levels = [...this.levels].filter(([, level]) => level !== null).map(([factor, level]) => ({ factor, level }));
    const layouts = filtered(this.data.layouts, levels, this.figure, this.asWanted && this.figure ? this.wanted.of(this.figure) : null);
    this.say(layouts.length);
    this.listeners.forEach((listener) => listener({ ...this.data, layouts }));
  }

  /** `listener(data)` is called with the data of those that are shown, whenever they or what is wanted change. */
  onChange(listener) {
    this.listeners.push(listener);
  }

  say(count) {
    this.said.textContent = count === this.data.layouts.length ? '' : `${count} of ${this.data.layouts.length} layouts are shown.`;
  }
}

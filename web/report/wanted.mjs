// What rate is wanted: as it was asked of a decision or a search, or as the reader writes it.
import { element } from './dom.mjs';
import { number } from './format.mjs';

export class Wanted {
  /** `given`: { figure (its name), low, high } in the figure's unit, or null; `figure`: whose range can be written, or null. */
  constructor(given, figure) {
    this.figure = given?.figure ?? figure?.name ?? null;
    this.range = given ? { low: given.low, high: given.high } : null;
    this.listeners = [];
  }

  /** { low, high } that is wanted of a figure, or null. */
  of({ name }) {
    return name === this.figure ? this.range : null;
  }

  /** Ends that are no numbers are open; without either nothing is wanted. */
  want(low, high) {
    const [from, to] = [low, high].map((text) => (text.trim() === '' ? NaN : Number(text)));
    this.range = Number.isFinite(from) || Number.isFinite(to) ? { low: Number.isFinite(from) ? from : -Infinity, high: Number.isFinite(to) ? to : Infinity } : null;
    this.listeners.forEach((listener) => listener());
  }

  onChange(listener) {
    this.listeners.push(listener);
  }
}

/** Two fields for the range; null where no figure can be wanted. */
export function wantedFields(wanted, figures) {
  const figure = figures.find(({ name }) => name === wanted.figure);
  if (!figure) return null;
  const unit = figure.unit ? `, ${figure.unit}` : '';
  const field = (name, value) => element('input', { class: 'number-field', inputmode: 'decimal', size: 6, 'aria-label': `Wanted ${figure.words} ${name}${unit}`, value: Number.isFinite(value) ? number(value, 4) : '', oninput: () => wanted.want(from.value, to.value) });
  const from = field('from', wanted.range?.low), to = field('to', wanted.range?.high);
  return element('span', { class: 'list-choice wanted' }, element('span', {}, `Wanted ${figure.words}${unit}`), from, element('span', {}, 'to'), to);
}

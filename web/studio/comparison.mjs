// Two layouts beside each other in numbers.
import { element, section } from '../report/dom.mjs';
import { number } from '../report/format.mjs';

function rateOf(outcome, k) {
  const hole = outcome?.holes[k];
  return hole && Number.isFinite(hole.seeds_per_s) ? { value: hole.seeds_per_s, low: hole.low, high: hole.high } : null;
}

function totalOf(outcome) {
  return Number.isFinite(outcome?.total_seeds_per_s) ? { value: outcome.total_seeds_per_s } : null;
}

function cvOf(outcome) {
  return Number.isFinite(outcome?.unevenness?.cv_percent) ? { value: outcome.unevenness.cv_percent } : null;
}

// The difference of two rates, and whether their intervals lie apart.
function difference(a, b) {
  if (!a || !b || a.value === 0) return { text: '–', apart: false };
  const percent = 100 * (b.value / a.value - 1);
  const apart = Number.isFinite(a.low) && Number.isFinite(b.low) && (a.high < b.low || b.high < a.low);
  const sign = percent < 0 ? '−' : percent > 0 ? '+' : '';
  return { text: `${sign}${number(Math.abs(percent), 2)} %`, apart };
}

/** What the table shows: { columns, rows: [{ name, cells: [{ text, apart }] }] } of two outcomes, either of which may be null. */
export function comparisonOf(a, b) {
  const holes = Math.max(a?.holes.length ?? 0, b?.holes.length ?? 0);
  const figures = (outcome) => [...Array.from({ length: holes }, (_, k) => rateOf(outcome, k)), totalOf(outcome)];
  const cells = (outcome) => [...figures(outcome).map((rate) => ({ text: number(rate?.value) })), { text: cvOf(outcome) ? `${number(cvOf(outcome).value)} %` : '–' }];
  const differences = figures(a).map((rate, k) => difference(rate, figures(b)[k]));
  return {
    columns: [...Array.from({ length: holes }, (_, k) => `hole ${k + 1}`), 'all holes', 'CV'],
    rows: [{ name: 'Layout A, seeds/s', cells: cells(a) }, { name: 'Layout B, seeds/s', cells: cells(b) }, { name: 'B against A', cells: [...differences, { text: '' }] }],
  };
}

/** One sentence about both; what is still missing where something is. */
export function comparisonSentence(a, b) {
  const [one, other] = [totalOf(a), totalOf(b)];
  if (!one || !other) return 'Both layouts have to sow for a while before they can be compared.';
  const change = number(Math.abs(100 * (other.value / one.value - 1)), 2);
  const more = change === '0' || one.value === 0 ? 'as many seeds as' : `${change} % ${other.value > one.value ? 'more' : 'fewer'} seeds than`;
  const rates = `B lets out ${more} A, ${number(other.value)} against ${number(one.value)} seeds/s`;
  const [even, than] = [cvOf(b), cvOf(a)];
  if (!even || !than) return `${rates}.`;
  const how = even.value === than.value ? 'as much' : even.value < than.value ? 'less' : 'more';
  return `${rates}; its holes differ ${how}: CV ${number(even.value)} % against ${number(than.value)} %.`;
}

export class Comparison {
  constructor() {
    this.sentence = element('p', { class: 'lead' });
    this.head = element('thead');
    this.body = element('tbody');
    this.frame = section('comparison', 'Both layouts', this.sentence,
      element('div', { class: 'table-frame card', tabindex: '0', role: 'region', 'aria-label': 'Rates of both layouts' },
        element('table', {}, element('caption', { class: 'unseen' }, 'Rates of both layouts'), this.head, this.body)),
      element('p', { class: 'hint' }, 'Bold: more than chance in the counting explains, the 95 % intervals lie apart.'));
  }

  show(a, b) {
    if (a === this.a && b === this.b) return;
    Object.assign(this, { a, b });
    const { columns, rows } = comparisonOf(a, b);
    this.sentence.textContent = comparisonSentence(a, b);
    this.head.replaceChildren(element('tr', {}, element('th', { scope: 'col' }, 'Layout'), columns.map((name) => element('th', { scope: 'col', class: 'number' }, name))));
    this.body.replaceChildren(...rows.map(({ name, cells }) => element('tr', {}, element('th', { scope: 'row' }, name),
      cells.map(({ text, apart }) => element('td', { class: 'number' }, apart ? element('b', {}, text) : text)))));
  }
}

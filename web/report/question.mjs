// What a decision or a search was asked, and what its answer cost.
import { element, section } from './dom.mjs';
import { sentence } from './format.mjs';

export function questionSection(data) {
  return section('question', 'What was asked, and what it cost',
    element('dl', { class: 'settings narrow' }, data.asked.map(({ name, value }) => element('div', {}, element('dt', {}, name), element('dd', {}, value)))),
    data.cost.map((text) => element('p', {}, sentence(text))));
}

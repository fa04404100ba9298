// One light for all doubts about a result: whether any is known, and whether one of them is serious. A remark is { serious, text, what_to_do },
// as the page's data have it (src/report/page.hpp).
import { element, icon } from './dom.mjs';
import { sentence } from './format.mjs';

const signs = { none: 'M6 12.5l4 4 8-9', mild: 'M12 6v7.5M12 17v.5', serious: 'M7 7l10 10M17 7L7 17' };

/** Remarks that are none of the program's, but of the page: mild, without advice. */
export function notes(texts) {
  return texts.map((text) => ({ serious: false, text }));
}

/** Remarks once each, the serious ones first. */
export function differentRemarks(remarks) {
  const ordered = [...remarks.filter(({ serious }) => serious), ...remarks.filter(({ serious }) => !serious)];
  const texts = ordered.map(({ text }) => sentence(text));
  return ordered.filter((_, k) => texts.indexOf(texts[k]) === k);
}

/** { level: "none", "mild" or "serious", words, all: the different remarks }. */
export function lightOf(remarks) {
  const all = differentRemarks(remarks);
  const serious = all.filter((remark) => remark.serious).length, mild = all.length - serious;
  const mildWords = mild === 1 ? '1 note' : `${mild} notes`;
  if (serious > 0) return { level: 'serious', words: `Doubtful: ${serious} serious ${serious === 1 ? 'doubt' : 'doubts'}${mild ? ` and ${mildWords}` : ''}`, all };
  if (mild > 0) return { level: 'mild', words: `No serious doubt, but ${mildWords}`, all };
  return { level: 'none', words: 'No doubt is known', all };
}

/** An item of a list. */
export function remarkItem({ serious, text, what_to_do: toDo }) {
  return element('li', { class: serious ? 'serious' : null }, serious ? element('strong', {}, 'Doubtful: ') : null,
    sentence(text), toDo ? element('span', { class: 'muted' }, ` What to do: ${toDo}.`) : null);
}

/** The light with its words, and the doubts under it. */
export function doubtLight(remarks) {
  const { level, words, all } = lightOf(remarks);
  const lamp = icon(signs[level]);
  lamp.setAttribute('class', 'lamp');
  return element('div', { class: `light ${level}`, role: 'group', 'aria-label': 'Doubts about this result' }, element('p', { class: 'light-words' }, lamp, words),
    all.length ? element('ul', { class: 'remarks', 'aria-label': 'What to know about this result' }, all.map(remarkItem)) : null);
}

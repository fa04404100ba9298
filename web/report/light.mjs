// One light for all doubts about a result: whether any is known, and whether one of them is serious.
import { element, icon } from './dom.mjs';
import { sentence } from './format.mjs';

// How the program begins a sentence about a doubt, and how it goes on to what one can do (src/outflow/doubts.cpp).
const severity = /^(Doubtful|Note): /;
const advice = /^(.*?) What to do: (.*)$/s;

const signs = { none: 'M6 12.5l4 4 8-9', mild: 'M12 6v7.5M12 17v.5', serious: 'M7 7l10 10M17 7L7 17' };

/** { level: "none", "mild" or "serious", words, all: the sentences once each, the serious ones first } of sentences about a result. */
export function lightOf(sentences) {
  const isSerious = (one) => one.startsWith('Doubtful: ');
  const different = [...new Set(sentences.map(sentence))];
  const serious = different.filter(isSerious), mild = different.filter((one) => !isSerious(one));
  const notes = mild.length === 1 ? '1 note' : `${mild.length} notes`;
  const all = [...serious, ...mild];
  if (serious.length > 0) return { level: 'serious', words: `Doubtful: ${serious.length} serious ${serious.length === 1 ? 'doubt' : 'doubts'}${mild.length ? ` and ${notes}` : ''}`, all };
  if (mild.length > 0) return { level: 'mild', words: `No serious doubt, but ${notes}`, all };
  return { level: 'none', words: 'No doubt is known', all };
}

function remark(text) {
  const said = text.replace(severity, '');
  const [, what, toDo] = advice.exec(said) ?? [null, said, ''];
  return element('li', { class: text.startsWith('Doubtful: ') ? 'serious' : null }, text.startsWith('Doubtful: ') ? element('strong', {}, 'Doubtful: ') : null,
    sentence(what), toDo ? element('span', { class: 'muted' }, ` What to do: ${toDo}`) : null);
}

/** The light with its words, and the doubts under it. */
export function doubtLight(sentences) {
  const { level, words, all } = lightOf(sentences);
  const lamp = icon(signs[level]);
  lamp.setAttribute('class', 'lamp');
  return element('div', { class: `light ${level}`, role: 'group', 'aria-label': 'Doubts about this result' }, element('p', { class: 'light-words' }, lamp, words),
    all.length ? element('ul', { class: 'remarks', 'aria-label': 'What to know about this result' }, all.map(remark)) : null);
}

// What stands at the head and the foot of every sheet of paper.
import { element } from './dom.mjs';

/** `text` as a string of CSS. */
export function cssString(text) {
  return `"${text.replace(/["\\<>\p{Cc}]/gu, (character) => `\\${character.codePointAt(0).toString(16)} `)}"`;
}

/** The style of pages with a title and what kind of page it is at their head; at their foot what wrote it, and the page's number of all. */
export function paperStyle({ kicker, title }, { name = 'vibrosow', version = '' }) {
  const box = (place, content) => `@${place} { content: ${content}; font: 9pt system-ui, sans-serif; color: #666056; }`;
  return element('style', {}, ['@page { margin: 20mm 14mm 18mm;', box('top-left', cssString(title)), box('top-right', cssString(kicker)),
    box('bottom-left', cssString(`Written by ${name} ${version}`.trim())), box('bottom-right', 'counter(page) " / " counter(pages)'), '}'].join('\n'));
}

// The front page: what the README says, and after its first paragraph where to start, with the studio and a report to open.
import { contentOf, escapeHtml } from './documents.mjs';
import { made } from './menu.mjs';

// The first sentence of a document, below its title.
function firstSentence(root, source) {
  const [[, , text]] = contentOf(root, { source, kind: 'document' }, (target) => target).sections;
  return /^.*?[.?!:](?=\s|$)/.exec(text)?.[0] ?? text;
}

const card = (address, name, says, picture) =>
  `<li><a href="${address}">${picture ? `<img src="${encodeURI(picture)}" alt="" loading="lazy">` : ''}<strong>${escapeHtml(name)}</strong></a><p>${escapeHtml(says)}</p></li>`;

/** The README's page with the first three tutorials, the studio and a report. `queue`: takes the pictures into the site. */
export function withStart(html, root, groups, queue) {
  const tutorials = (groups.find(([heading]) => heading === 'Tutorials')?.[1] ?? []).slice(0, 3);
  const steps = tutorials.map(({ page, name, source }) => card(encodeURI(page), name, firstSentence(root, source)));
  const opened = made.filter(({ says }) => says).map(({ page, name, says, picture }) => card(page, name, says, queue.placeOf(picture)));
  const start = steps.length > 0 ? `<h2>Start here</h2>\n<ol class="cards">${steps.join('')}</ol>\n` : '';
  return html.replace('</p>', () => `</p>\n<div class="start">${start}<h2>Try it in your browser</h2>\n<ul class="cards">${opened.join('')}</ul></div>`);
}

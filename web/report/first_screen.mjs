// The first screen of every page: the answer with what to expect, the light of its doubts, and the tray that it is about, drawn and in words.
import { element } from './dom.mjs';
import { sentence } from './format.mjs';
import { inputList } from './inputs.mjs';
import { layoutInSentence } from './layout_words.mjs';
import { doubtLight } from './light.mjs';
import { themeSwitch } from './theme_switch.mjs';
import { boxesOf, trayDrawing } from './tray_drawing.mjs';

// Nothing of a page whose data hold no tray.
function trayParts({ name, vessels, scene, space }) {
  if (vessels.length === 0) return [];
  return [
    element('aside', { class: 'tray-card card', 'aria-label': name }, element('h2', {}, name), trayDrawing(name, vessels, boxesOf([vessels], space))),
    inputList({ scene, vessels, space }),
  ];
}

/** The tray of a layout, `lead`, which stands for so much: "Layout 7 (5 · 9 Hz): best"; of one that cannot be built, or of null, null. */
export function trayOfLayout(data, lead, standsFor) {
  if (!lead || lead.vessels.length === 0) return null;
  const { vessels, scene } = lead;
  return { name: sentence(`${layoutInSentence(data, lead)}: ${standsFor}`).slice(0, -1), vessels, scene, space: data.space };
}

/** `tray`: { name, vessels, scene, space }, or null. `headlines`: the answer, and then what to expect of it. */
export function firstScreen({ kicker, title, headlines, remarks, tray }) {
  return [
    element('div', { class: 'topline' }, element('p', { class: 'kicker' }, kicker), themeSwitch()),
    element('div', { class: 'first-screen' },
      element('div', { class: 'answer' }, element('h1', {}, title), headlines.filter(Boolean).map((text) => element('p', { class: 'headline' }, sentence(text))), doubtLight(remarks)),
      tray && trayParts(tray)),
  ];
}

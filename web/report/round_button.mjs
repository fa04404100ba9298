// Round buttons with a picture, as a player has them.
import { element, icon } from './dom.mjs';

const pictures = {
  play: ['M7 4.5v15l12-7.5z'],
  pause: ['M6 5h4v14H6z', 'M14 5h4v14h-4z'],
  back: ['M5 5h3v14H5z', 'M19 5v14l-9-7z'],
  forward: ['M16 5h3v14h-3z', 'M5 5v14l9-7z'],
  end: ['M3 5v14l7-7z', 'M10 5v14l7-7z', 'M18 5h3v14h-3z'],
  restart: ['M12 4a8 8 0 1 1-7.7 5.8l2.4.7A5.5 5.5 0 1 0 12 6.5v3.2L6.8 5.6 12 1.5z'],
  remove: ['M6.4 5 12 10.6 17.6 5 19 6.4 13.4 12 19 17.6 17.6 19 12 13.4 6.4 19 5 17.6 10.6 12 5 6.4z'],
};

/** `name`: said aloud and shown over it. */
export function roundButton(picture, name, act) {
  return element('button', { type: 'button', class: 'round', 'aria-label': name, title: name, onclick: act }, icon(...pictures[picture]));
}

/** Gives a round button another picture and name, where it has not got them. */
export function nameButton(button, picture, name) {
  if (button.title === name) return;
  button.title = name;
  button.setAttribute('aria-label', name);
  button.replaceChildren(icon(...pictures[picture]));
}

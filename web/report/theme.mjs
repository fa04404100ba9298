// Light or dark: as the system has it until the reader says otherwise; light on paper.

const listeners = new Set();
const dark = matchMedia('(prefers-color-scheme: dark)');
let chosen = null;
let printing = false;

/** "light" or "dark" */
export function theme() {
  if (printing) return 'light';
  return chosen ?? (dark.matches ? 'dark' : 'light');
}

function apply() {
  document.documentElement.dataset.theme = theme();
  listeners.forEach((listener) => listener(theme()));
}

export function toggleTheme() {
  chosen = theme() === 'dark' ? 'light' : 'dark';
  apply();
}

export function onTheme(listener) {
  listeners.add(listener);
}

/** A colour of the style sheet, such as "ink". */
export function themeColour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

/** The colours that a canvas is drawn with, and the font of its numbers. */
export function inks() {
  const colours = Object.fromEntries(['ink', 'wall', 'halo', 'accent', 'depth'].map((name) => [name, themeColour(name)]));
  return { ...colours, font: `600 13px ${themeColour('font')}` };
}

function print(begins) {
  printing = begins;
  apply();
}

export function startTheme() {
  dark.addEventListener('change', apply);
  addEventListener('beforeprint', () => print(true));
  addEventListener('afterprint', () => print(false));
  apply();
}

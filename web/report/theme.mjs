// Light or dark: as the system has it until the reader says otherwise; light on paper, of which listeners hear as of a theme.

const listeners = new Set();
const dark = globalThis.matchMedia?.('(prefers-color-scheme: dark)') ?? { matches: false };  // no window: a test of the page's parts
let systemIsDark = dark.matches;  // asked once: a query that is asked while it changes tells no listener (seen in Chromium)
let chosen = null;
let printing = false;

/** "light" or "dark" */
export function theme() {
  if (printing) return 'light';
  return chosen ?? (systemIsDark ? 'dark' : 'light');
}

function apply() {
  document.documentElement.dataset.theme = theme();
  listeners.forEach((listener) => listener(theme()));
}

/** Whether the page is being printed. */
export function onPaper() {
  return printing;
}

export function toggleTheme() {
  chosen = theme() === 'dark' ? 'light' : 'dark';
  apply();
}

/** Returns what ends it. */
export function onTheme(listener) {
  listeners.add(listener);
  return () => listeners.delete(listener);
}

/** A colour of the style sheet, such as "ink". */
export function themeColour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

/** The colours that a canvas is drawn with, and the font of its numbers. */
export function inks() {
  const colours = Object.fromEntries(['ink', 'wall', 'halo', 'accent', 'depth', 'chain', 'card', 'floor', 'glass'].map((name) => [name, themeColour(name)]));
  return { ...colours, font: `600 13px ${themeColour('font')}` };
}

function print(begins) {
  printing = begins;
  document.documentElement.toggleAttribute('data-paper', begins);  // as wide as a sheet, for what is drawn to its place's width
  apply();
}

export function startTheme() {
  dark.addEventListener('change', ({ matches }) => {
    systemIsDark = matches;
    apply();
  });
  addEventListener('beforeprint', () => print(true));
  addEventListener('afterprint', () => print(false));
  apply();
}

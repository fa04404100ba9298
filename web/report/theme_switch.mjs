// The button that goes from light to dark and back.
import { element } from './dom.mjs';
import { onTheme, theme, toggleTheme } from './theme.mjs';

export function themeSwitch() {
  const button = element('button', { type: 'button', class: 'quiet', onclick: toggleTheme });
  const name = () => { button.textContent = theme() === 'dark' ? 'Light' : 'Dark'; };
  onTheme(name);
  name();
  return button;
}

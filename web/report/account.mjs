// What the run was: effects, guard, settings, and where it came from.
import { element, section } from './dom.mjs';

function effectList(title, effects) {
  if (effects.length === 0) return null;
  return element('div', {}, element('h3', {}, title),
    element('dl', { class: 'effects' }, effects.map(({ name, why }) => [element('dt', {}, name), element('dd', {}, why ?? '')])));
}

export function effectsSection(data) {
  return section('effects', 'What was simulated', element('div', { class: 'columns' },
    effectList('Present', data.effects.filter((effect) => effect.present)), effectList('Left out', data.effects.filter((effect) => !effect.present))));
}

export function guardSection(data) {
  return data.guard ? section('guard', 'Guard', element('p', {}, data.guard)) : null;
}

function saveButton(text) {
  const url = URL.createObjectURL(new Blob([text], { type: 'application/json' }));
  return element('a', { class: 'save', href: url, download: 'scene.json' }, 'Save the scene as JSON');
}

export function settingsSection(data) {
  const scene = `${JSON.stringify(data.scene, null, 2)}\n`;
  return section('settings', 'Settings',
    element('dl', { class: 'settings' }, data.settings.map(({ name, value }) => element('div', {}, element('dt', {}, name), element('dd', {}, value)))),
    element('details', { class: 'card' }, element('summary', {}, 'The whole scene'), saveButton(scene),
      element('pre', { tabindex: '0', role: 'region', 'aria-label': 'The scene as JSON' }, scene)));
}

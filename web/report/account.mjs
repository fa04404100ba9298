// How a run was computed: effects, guard, settings, and where it came from; folded, for it is not what one asks first.
import { element, folded, section } from './dom.mjs';

function effectList(title, effects) {
  if (effects.length === 0) return null;
  return element('div', {}, element('h4', {}, title),
    element('dl', { class: 'effects' }, effects.map(({ name, why }) => [element('dt', {}, name), element('dd', {}, why ?? '')])));
}

function effectsPart({ effects }) {
  return [element('h3', {}, 'Effects'), element('div', { class: 'columns' },
    effectList('Present', effects.filter((effect) => effect.present)), effectList('Left out', effects.filter((effect) => !effect.present)))];
}

function saveButton(text) {
  const url = URL.createObjectURL(new Blob([text], { type: 'application/json' }));
  return element('a', { class: 'save', href: url, download: 'scene.json' }, 'Save the scene as JSON');
}

function settingsPart(data) {
  const scene = `${JSON.stringify(data.scene, null, 2)}\n`;
  return [element('h3', {}, 'Settings'),
    element('dl', { class: 'settings' }, data.settings.map(({ name, value }) => element('div', {}, element('dt', {}, name), element('dd', {}, value)))),
    element('details', { class: 'card' }, element('summary', {}, 'The whole scene'), saveButton(scene),
      element('pre', { tabindex: '0', role: 'region', 'aria-label': 'The scene as JSON' }, scene))];
}

const inSummary = ['contact law', 'scheme', 'time step'];  // of the settings

export function computedSection(data) {
  const few = data.settings.filter(({ name }) => inSummary.includes(name)).map(({ name, value }) => `${name} ${value}`);
  return section('computed', 'How it was computed', folded(['Effects, guard and settings', ...few].join(' · '),
    effectsPart(data), data.guard ? [element('h3', {}, 'Guard'), element('p', {}, data.guard)] : null, settingsPart(data)));
}

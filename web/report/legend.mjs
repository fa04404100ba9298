// What colours mean: names beside swatches, or a scale.
import { element } from './dom.mjs';

function swatch(colour, name) {
  return element('span', { class: 'swatch', style: `background:${colour}` }, name ?? null);
}

/** Of a colouring's legend, { kind: "names", names } or { kind: "scale", low, high, note }, the elements. */
export function legendParts(legend, colours) {
  if (legend.kind === 'names') return legend.names.map((name, k) => element('span', { class: 'legend-item' }, swatch(colours[k]), name));
  return [element('span', {}, legend.note),
    element('span', { class: 'legend-scale' }, legend.low, element('span', { class: 'ramp' }, colours.map((colour) => swatch(colour))), legend.high)];
}

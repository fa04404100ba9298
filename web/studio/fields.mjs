// Number fields and sliders of the controls.
import { element } from '../report/dom.mjs';

const decimals = 4;

function shown(value) {
  return value === null ? '' : String(Number(value.toFixed(decimals)));
}

/** A number field. `change(value)` is called with what lies in the field's range once it has been entered. */
export function numberField(name, change, { step = 'any', mixed = null } = {}) {
  const field = element('input', { type: 'number', class: 'number-field', 'aria-label': name, step, inputmode: 'decimal', placeholder: mixed, onchange: () => {
    const value = field.valueAsNumber;
    if (Number.isFinite(value)) change(Math.min(Number(field.max), Math.max(Number(field.min), value)));
    else show(last);
  } });
  let last = null;
  const show = (value, least = field.min, most = field.max) => {
    last = value;
    field.min = least;
    field.max = most;
    field.value = shown(value);
  };
  return { field, show };
}

/** A slider with a number field beside it. `change(value, ended)`: `ended` is false as long as the slider is held. */
export function rangeField(name, unit, change, mixed = null) {
  const slider = element('input', { type: 'range', 'aria-label': `${name}, ${unit}`, oninput: () => change(slider.valueAsNumber, false), onchange: () => change(slider.valueAsNumber, true) });
  const number = numberField(`${name} in ${unit}`, (value) => change(value, true), { mixed });
  const frame = element('div', { class: 'field' }, element('span', { class: 'field-name', 'aria-hidden': 'true' }, name),
    element('span', { class: 'field-value' }, number.field, element('span', { class: 'unit', 'aria-hidden': 'true' }, unit)), slider);
  const show = (value, { least, most, step }) => {
    number.show(value, least, most);
    number.field.step = 'any';
    Object.assign(slider, { min: least, max: most, step });
    if (value !== null) slider.value = value;
    slider.style.setProperty('--done', `${value === null ? 0 : (100 * (value - least)) / (most - least || 1)}%`);
  };
  return { frame, show };
}

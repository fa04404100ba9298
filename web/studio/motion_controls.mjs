// Frequency, amplitude and direction of a harmonic motion.
import { element } from '../report/dom.mjs';
import { rangeField } from './fields.mjs';
import { rangesOf, withMotion } from './layout.mjs';
import { degreesOf, mmOf } from './quantities.mjs';

export class MotionControls {
  constructor(change) {
    const field = (name, unit, key) => rangeField(name, unit, (value, ended) => change(withMotion(this.layout, { [key]: value }), ended));
    this.fields = { frequency_hz: field('Frequency', 'Hz', 'frequency_hz'), amplitude_mm: field('Amplitude', 'mm', 'amplitude_mm'), direction_degree: field('Direction', '°', 'direction_degree') };
    this.frame = element('div', { role: 'group', class: 'panel motion', 'aria-label': 'Motion of the tray' }, element('div', { class: 'panel-head' }, element('h3', {}, 'Motion'),
      element('p', { class: 'hint' }, 'Amplitude: half the stroke. Direction: 0° along the tray, 90° up.')), Object.values(this.fields).map(({ frame }) => frame));
  }

  show(layout) {
    this.layout = layout;
    this.frame.hidden = layout.motion === null;
    if (layout.motion === null) return;
    const ranges = rangesOf(layout.seeder).motion;
    const values = { frequency_hz: layout.motion.frequency_hz, amplitude_mm: mmOf(layout.motion.amplitude_m), direction_degree: degreesOf(layout.motion.direction_rad) };
    for (const [key, field] of Object.entries(this.fields)) field.show(values[key], ranges[key]);
  }
}

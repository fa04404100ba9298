// The sowing rate that is wanted, as seeds a second of the tray, and what the slice says to it.
import { element } from '../report/dom.mjs';
import { number } from '../report/format.mjs';
import { numberField } from './fields.mjs';

const quantities = {
  kg_per_ha: { name: 'Wanted', unit: 'kg/ha', said: 'Wanted sowing rate in kg/ha', usual: 180, least: 0.1, most: 1000 },
  spacing_cm: { name: 'rows', unit: 'cm apart', said: 'Row spacing in cm', usual: 15, least: 1, most: 200 },
  speed_km_per_h: { name: 'at', unit: 'km/h', said: 'Speed in km/h', usual: 8, least: 0.1, most: 40 },
  rows: { name: 'the tray feeds', unit: 'rows', said: 'Rows that the tray feeds', usual: 1, least: 1, most: 200 },
};
const doubt = 'Doubtful: in 2D a hole is a slot all across. Of twelve wheat trays with round holes 2D let out 6.8 to 7.6 times what 3D did. Run it in 3D, and weigh, before you sow.';

/** { g_per_s, seeds_per_s } that a tray has to sow for a task { kg_per_ha, spacing_cm, speed_km_per_h, rows }; seeds only where each lot has one size. */
export function wantedRate({ kg_per_ha, spacing_cm, speed_km_per_h, rows }, lots) {
  const kilograms = kg_per_ha * 1e-4 * (spacing_cm / 100) * (speed_km_per_h / 3.6) * rows;
  const mass = lots.some((lot) => lot.sizes) ? NaN : lots.reduce((sum, lot) => sum + lot.number_fraction * lot.mass_kg, 0);
  return { g_per_s: kilograms * 1000, seeds_per_s: kilograms / mass };
}

/** How many slices the tray is deep, as the program says in an outcome's table; null of a tray without a depth, or where nothing flowed. */
export function slicesOf({ columns, rows }) {
  const tray = columns.findIndex(({ name }) => name === 'of the tray'), slice = columns.findIndex(({ name, unit }) => name === 'rate of the slice' && unit === columns[tray]?.unit);
  const all = rows.find(([hole, lot]) => hole === 'all' && lot === 'all');
  const ratio = tray < 0 || slice < 0 || !all ? NaN : Number(all[tray]) / Number(all[slice]);
  return Number.isFinite(ratio) ? ratio : null;
}

function beside(wanted, outcome) {
  if (!outcome) return '';
  const slices = outcome.said ? slicesOf(outcome.said.hole_table) : null;
  if (slices === null) return 'How much of it this slice stands for is not known: the seeder gives its tray no depth, or nothing flows. ';
  const sown = outcome.total_seeds_per_s * slices;
  return `In 2D this layout sows ${number(sown)} seeds/s, ${number(sown / wanted, 2)} times that: ${number(slices)} slices of ${number(outcome.total_seeds_per_s)}. `;
}

/** { value, words } for a task, of seeds `lots`; `outcome`: what has been measured, null before that. */
export function wantedWords(task, lots, outcome) {
  const { g_per_s, seeds_per_s } = wantedRate(task, lots);
  if (!Number.isFinite(seeds_per_s)) return { value: `${number(g_per_s)} g/s`, words: 'The seeds are of several sizes: vibrosow plan says how many a second that is.' };
  return { value: `${number(seeds_per_s)} seeds/s of the tray`, words: `${number(g_per_s)} g/s. ${beside(seeds_per_s, outcome)}${doubt}` };
}

/** What was kept of a task, if it is one; null otherwise. */
export function taskOf(text) {
  try {
    const task = JSON.parse(text);
    const isOne = Object.entries(quantities).every(([key, { least, most }]) => task[key] >= least && task[key] <= most);
    return isOne ? Object.fromEntries(Object.keys(quantities).map((key) => [key, task[key]])) : null;
  } catch {
    return null;
  }
}

export class Wanted {
  /** `task`: what is wanted; null where nothing was said yet. `changed(task)`: null once it is no longer asked for. */
  constructor(task, changed) {
    this.task = task;
    this.button = element('button', { type: 'button', class: 'quiet', 'aria-expanded': 'false', onclick: () => {
      this.task = this.task ? null : this.usual();
      this.show();
      changed(this.task);
    } }, 'Wanted rate');
    this.fields = Object.fromEntries(Object.entries(quantities).map(([key, { said }]) => [key, numberField(said, (value) => {
      this.task = { ...this.task, [key]: value };
      this.show();
      changed(this.task);
    })]));
    const parts = Object.entries(quantities).map(([key, { name, unit }]) => element('span', { class: 'wanted-part' },
      element('span', { 'aria-hidden': 'true' }, name), this.fields[key].field, element('span', { 'aria-hidden': 'true' }, unit)));
    this.frame = element('div', { class: 'wanted', role: 'group', 'aria-label': 'Wanted sowing rate' }, parts);
    this.show();
  }

  usual() {
    return Object.fromEntries(Object.entries(quantities).map(([key, { usual }]) => [key, usual]));
  }

  show() {
    const { task } = this;
    this.frame.hidden = task === null;
    this.button.setAttribute('aria-expanded', String(task !== null));
    if (task) for (const [key, { least, most }] of Object.entries(quantities)) this.fields[key].show(task[key], least, most);
  }
}

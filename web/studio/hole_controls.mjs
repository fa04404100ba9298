// Holes as a list of numbers, beside the handles under the tray: places, widths, how many.
import { element } from '../report/dom.mjs';
import { roundButton } from '../report/round_button.mjs';
import { numberField, rangeField } from './fields.mjs';
import { addHole, commonWidth, hasFloor, mostInARow, moveHole, rangesOf, reachOf, spreadHoles, widenAll, widenHole } from './layout.mjs';
import { mmOf } from './quantities.mjs';

export class HoleControls {
  /** `acts`: { change(layout, ended), remove(k), add() } */
  constructor(acts) {
    this.acts = acts;
    this.rows = [];
    this.list = element('ol', { class: 'hole-list' });
    this.count = numberField('Number of holes', (value) => this.set(spreadHoles(this.layout, value)), { step: 1 });
    this.width = rangeField('Width of all', 'mm', (value, ended) => this.acts.change(widenAll(this.layout, value), ended), 'various');
    this.adder = element('button', { type: 'button', class: 'quiet', onclick: () => acts.add() }, 'Add a hole');
    this.frame = element('div', { role: 'group', class: 'panel holes', 'aria-label': 'Holes of the tray' }, element('div', { class: 'panel-head' }, element('h3', {}, 'Holes'), this.count.field, this.adder),
      this.width.frame,
      element('div', { class: 'hole-row hole-list-head', 'aria-hidden': 'true' }, element('span'), element('span', {}, 'at, mm'), element('span', {}, 'width, mm'), element('span')), this.list);
  }

  set(layout) {
    this.acts.change(layout, true);
    this.show(this.layout);  // what was entered may have been too much
  }

  makeRow(k) {
    const at = numberField(`Place of hole ${k + 1} in mm`, (value) => this.set(moveHole(this.layout, k, value)));
    const width = numberField(`Width of hole ${k + 1} in mm`, (value) => this.set(widenHole(this.layout, k, value)));
    const remove = roundButton('remove', `Remove hole ${k + 1}`, () => this.acts.remove(k));
    remove.classList.add('small');
    return { at, width, remove, row: element('li', { class: 'hole-row' }, element('b', { 'aria-hidden': 'true' }, String(k + 1)), at.field, width.field, remove) };
  }

  show(layout) {
    this.layout = layout;
    const { holes } = layout;
    const ranges = rangesOf(layout.seeder);
    this.frame.hidden = !hasFloor(layout.seeder);
    while (this.rows.length > holes.length) this.rows.pop().row.remove();
    while (this.rows.length < holes.length) {
      this.rows.push(this.makeRow(this.rows.length));
      this.list.append(this.rows[this.rows.length - 1].row);
    }
    this.rows.forEach(({ at, width, remove }, k) => {
      at.show(mmOf(holes[k].centre_m), ...reachOf(layout, k));
      width.show(mmOf(holes[k].width_m), ranges.width_mm.least, ranges.width_mm.most);
      remove.disabled = holes.length < 2;
    });
    this.count.show(holes.length, 1, holes.length ? mostInARow(layout) : 1);
    this.count.field.disabled = holes.length === 0;
    this.width.show(commonWidth(layout), ranges.width_mm);
    const room = addHole(layout) !== null;
    this.adder.disabled = !room;
    this.adder.title = room ? '' : 'There is no room for another hole';
  }
}

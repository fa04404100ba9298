// A handle under every hole: a slider that moves it along the floor, by pointer or by keys.
import { element } from '../report/dom.mjs';
import { number } from '../report/format.mjs';
import { mmOf } from './quantities.mjs';

const narrowest = 30;  // px of a handle, so that a finger finds it
const widthStep = 0.5; // mm

/** "hole 2 at 164 mm, 12 mm wide" */
export function holeWords({ centre_m, width_m }, k) {
  return `hole ${k + 1} at ${number(mmOf(centre_m), 5)} mm, ${number(mmOf(width_m), 5)} mm wide`;
}

export class Handles {
  /** `acts`: { move(k, mm, ended), widen(k, by), remove(k) } */
  constructor(acts) {
    this.acts = acts;
    this.rail = element('div', { class: 'rail', 'aria-hidden': 'true' });
    this.frame = element('div', { class: 'handles', role: 'group', 'aria-label': 'Holes' }, this.rail);
    this.list = [];
  }

  make(k) {
    const bubble = element('span', { class: 'bubble' });
    const handle = element('div', { class: 'handle', role: 'slider', tabindex: '0', 'aria-label': `Hole ${k + 1}`, 'aria-orientation': 'horizontal',
      'aria-description': 'Arrow keys move it, with shift by 10 mm; plus and minus change its width; Delete takes it away',
      onkeydown: (event) => this.key(event, k), onpointerdown: (event) => this.grab(event, k) },
      element('span', { class: 'opening' }), element('span', { class: 'knob' }, String(k + 1)), bubble);
    return { handle, bubble };
  }

  grab(event, k) {
    if (event.button !== 0) return;
    const { handle } = this.list[k];
    const from = event.clientX, start = this.holes[k].centre_m * 1000;
    const move = ({ clientX }) => {
      if (clientX !== this.lastX) this.acts.move(k, Math.round(start + (clientX - from) / this.scale), false);
      this.lastX = clientX;
    };
    const release = () => {
      for (const [name, act] of [['pointermove', move], ['pointerup', release], ['pointercancel', release]]) handle.removeEventListener(name, act);
      handle.classList.remove('held');
      if (this.lastX !== from) this.acts.move(k, mmOf(this.holes[k].centre_m), true);
    };
    event.preventDefault();
    this.lastX = from;
    handle.focus({ preventScroll: true });
    handle.setPointerCapture(event.pointerId);
    handle.classList.add('held');
    for (const [name, act] of [['pointermove', move], ['pointerup', release], ['pointercancel', release]]) handle.addEventListener(name, act);
  }

  key(event, k) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const now = this.holes[k].centre_m * 1000, by = event.shiftKey ? 10 : 1;
    const [low, high] = this.reaches[k];
    const act = {
      ArrowLeft: () => this.acts.move(k, now - by, true), ArrowDown: () => this.acts.move(k, now - by, true),
      ArrowRight: () => this.acts.move(k, now + by, true), ArrowUp: () => this.acts.move(k, now + by, true),
      Home: () => this.acts.move(k, low, true), End: () => this.acts.move(k, high, true),
      '+': () => this.acts.widen(k, widthStep), '=': () => this.acts.widen(k, widthStep), '-': () => this.acts.widen(k, -widthStep),
      Delete: () => this.acts.remove(k),
    }[event.key];
    if (!act) return;
    event.preventDefault();
    event.stopPropagation();
    act();
  }

  focus(k) {
    this.list[Math.min(k, this.list.length - 1)]?.handle.focus();
  }

  /** Brings them to the holes. `placeOf(mm)`: px [x, y] of a place of the floor; `scale`: px a mm; `ends`: mm of the floor. */
  show(holes, reaches, { placeOf, scale, length, height }) {
    Object.assign(this, { holes, reaches, scale });
    while (this.list.length > holes.length) this.list.pop().handle.remove();
    while (this.list.length < holes.length) {
      this.list.push(this.make(this.list.length));
      this.frame.append(this.list[this.list.length - 1].handle);
    }
    const [left] = placeOf(0), [right] = placeOf(length);
    this.rail.style.cssText = `left:${left}px;width:${right - left}px`;
    this.list.forEach(({ handle, bubble }, k) => {
      const hole = holes[k], mm = mmOf(hole.centre_m);
      const [x, y] = placeOf(hole.centre_m * 1000);
      const opening = hole.width_m * 1000 * scale, width = Math.max(narrowest, opening);
      handle.style.cssText = `left:${x - width / 2}px;width:${width}px;top:${y}px;height:${height - y}px;--opening:${opening}px`;
      const [low, high] = reaches[k];
      for (const [name, value] of [['aria-valuemin', low], ['aria-valuemax', high], ['aria-valuenow', mm], ['aria-valuetext', holeWords(hole, k)]]) handle.setAttribute(name, value);
      bubble.textContent = `${number(mm, 5)} mm`;
    });
  }
}

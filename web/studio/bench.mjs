// One tray on the page: a layout, its simulation, and the controls of both.
import { startSimulator } from '../core/simulator.mjs';
import { choice, element } from '../report/dom.mjs';
import { clock, sentence } from '../report/format.mjs';
import { choicesOf } from './choices.mjs';
import { Course } from './course.mjs';
import { holeWords } from './handles.mjs';
import { HoleControls } from './hole_controls.mjs';
import { addHole, moveHole, removeHole, startOf, widenHole } from './layout.mjs';
import { startsAgain } from './obstacles.mjs';
import { MotionControls } from './motion_controls.mjs';
import { measured, OutflowPanel } from './outflow_panel.mjs';
import { saveText } from '../report/save.mjs';
import { keptSentence, sceneOf } from './scene_edit.mjs';
import { fileName, seederFile } from './seeder_file.mjs';
import { asFastAsItCan, realTime, Transport } from './transport.mjs';
import { TrayView } from './tray_view.mjs';

const settling = 250;  // ms after a gesture, before its layout is simulated
const between = 300;   // ms between the changes that a run takes while a gesture lasts
const readable = 4000; // ms that it stays said why a run started again
const still = matchMedia('(prefers-reduced-motion: reduce)');

// Whether a hole that was to move has not, and will not.
function hasNoRoom({ status, frame }) {
  return status === 'playing' ? frame.waiting === 'given up' : status === 'ended' && Boolean(frame.waiting);
}

export class Bench {
  /** `name`: "A" or "B"; `told("layout")` is called when its layout has changed, `told("made")` when the gesture that changed it has ended, `told("state")` when its simulation has moved on.
   * `all()`: the benches of the page, which start, run and rest together. */
  constructor(data, name, layout, { told, all }) {
    Object.assign(this, { data, name, layout, told, all });
    this.pace = still.matches ? undefined : realTime;  // undefined: waits at the start
    const remove = (k) => this.remove(k);
    const edit = (changed, ended) => this.change(changed, ended);
    this.view = new TrayView({ remove, move: (k, mm, ended) => edit(moveHole(this.layout, k, mm), ended), widen: (k, by) => this.widen(k, by) });
    this.holes = new HoleControls({ change: edit, remove, add: () => this.add() });
    this.motion = new MotionControls(edit);
    this.outflow = new OutflowPanel();
    this.transport = new Transport({ toggle: () => this.toggle(), restart: () => this.restart(), toTheEnd: () => this.toTheEnd() });
    this.course = new Course(startSimulator, (state) => this.showState(state));
    this.build();
    this.showLayout();
  }

  build() {
    this.choices = element('div', { class: 'bench-choices' });
    this.kept = element('p', { class: 'hint' });
    this.problem = element('p', { class: 'doubt', role: 'alert' });
    this.status = element('p', { class: 'unseen', role: 'status' });
    this.title = element('h2', { id: `layout-${this.name}` }, `Layout ${this.name}`);
    const save = element('button', { type: 'button', class: 'quiet', onclick: () => this.save() }, 'Save the seeder file');
    const looks = element('div', { role: 'group', class: 'panel looks', 'aria-label': 'View' }, this.view.legend, this.view.choices, save);
    this.frame = element('section', { class: 'bench', 'aria-labelledby': `layout-${this.name}` }, this.title, this.choices, this.kept, this.problem, this.outflow.remarks,
      element('div', { class: 'workbench' }, element('div', { class: 'replay card' }, this.view.place, element('div', { class: 'controls' }, this.transport.frame)),
        this.tabs(), element('div', { class: 'panels' }, this.outflow.frame, this.holes.frame), this.motion.frame, looks), this.outflow.guard, this.status);
    this.frame.dataset.tab = 'outflow';
  }

  // Where there is no room for all panels beside the picture, one at a time.
  tabs() {
    const options = [['outflow', 'Rates'], ['holes', 'Holes'], ['motion', 'Motion'], ['looks', 'View']].map(([value, text]) => ({ value, text }));
    const tabs = choice('Show', options, 'outflow', (value) => { this.frame.dataset.tab = value; });
    tabs.classList.add('tabs');
    return tabs;
  }

  /** Of the layout shown, as far as it has been measured; null before that. */
  get outcome() {
    const { state } = this.course;
    return ['playing', 'paused', 'ended'].includes(state.status) ? measured(state) : null;
  }

  open() {
    this.course.open(sceneOf(this.layout, this.data.crops), this.pace);
  }

  /** Takes another layout. A run goes on with it, also while the gesture that makes it lasts; where it cannot, it starts again once that has ended. */
  change(layout, ended = true) {
    const moved = layout !== this.layout, other = layout.seeder !== this.layout.seeder;
    this.layout = layout;
    if (moved) this.showLayout();
    clearTimeout(this.opening);
    this.news = '';
    if (other) this.course.leaveSeeder();
    else if (moved && !this.course.isUnderWay && this.course.state.status !== 'changed') this.course.leave();
    if (this.course.isUnderWay) this.goOn(ended);
    else if (ended) this.openSoon();
    if (moved) this.told('layout');
    if (ended) this.told('made');
  }

  // One change at a time, and of those that come meanwhile the last.
  async goOn(ended) {
    this.due = { ended: ended || Boolean(this.due?.ended) };
    if (this.isGoingOn) return;
    this.isGoingOn = true;
    try {
      while (this.due) await this.takeDue();
    } finally {
      this.isGoingOn = false;
    }
  }

  async takeDue() {
    const { layout, due } = this;
    this.due = null;
    if (this.course.isUnderWay && this.taken?.layout !== layout) this.taken = { layout, obstacle: await this.course.change(sceneOf(layout, this.data.crops)) };
    if (due.ended && layout === this.layout) {
      if (!this.course.isUnderWay) this.openSoon();  // it came to its end meanwhile
      else if (this.taken.obstacle) this.startAgain(this.taken.obstacle);
    }
    if (!due.ended) await new Promise((wakes) => { setTimeout(wakes, between); });
  }

  openSoon() {
    clearTimeout(this.opening);
    this.opening = setTimeout(() => this.restart(), settling);
  }

  startAgain(obstacle) {
    this.news = startsAgain(obstacle);
    this.course.leave();
    this.openSoon();
    clearTimeout(this.silence);
    this.silence = setTimeout(() => this.hush(), readable);
  }

  hush() {
    this.news = '';
    this.transport.show(this.course.state);
  }

  showLayout() {
    const { layout, data } = this;
    this.showChoices();
    this.kept.textContent = keptSentence(layout, data.crops);
    this.kept.hidden = !this.kept.textContent;
    this.holes.show(layout);
    this.motion.show(layout);
    this.view.showHoles(layout);
  }

  // The lists are made again only where what they show has changed, so that the focus stays where it is.
  showChoices() {
    const { seeder, crop, accuracy } = this.layout;
    const now = [seeder, crop, accuracy];
    if (this.chosen?.every((one, k) => one === now[k])) return;
    const focused = [...this.choices.querySelectorAll('select, input')].indexOf(document.activeElement);
    this.chosen = now;
    this.choices.replaceChildren(...choicesOf(this.data, this.layout, {
      seeder: (one) => this.change(startOf(one)), crop: (name) => this.change({ ...this.layout, crop: name }), accuracy: (name) => this.change({ ...this.layout, accuracy: name }),
    }));
    if (focused >= 0) this.choices.querySelectorAll('select, input')[focused]?.focus();
  }

  showState(state) {
    if (!state.prepared) {
      this.prepared = null;
      this.view.clear();
    } else if (state.prepared !== this.prepared) {
      this.prepared = state.prepared;
      this.scene = sceneOf(this.layout, this.data.crops);
      this.view.open(state.prepared, this.scene, this.layout.motion);
      this.view.showHoles(this.layout);
    }
    if (state.frame && state.prepared === this.prepared) this.view.show(state.frame);
    this.transport.show(state, this.news);
    this.outflow.show(state, this.scene);
    this.tellProblem(state.problem);
    if (state.status !== this.lastStatus) this.say(state);
    this.lastStatus = state.status;
    this.frame.dataset.status = state.status;
    this.told('state');
    if (hasNoRoom(state)) this.startAgain('given up');
  }

  say({ status, frame }) {
    if (status === 'changed') this.status.textContent = `Layout ${this.name} has changed. ${this.news || 'The simulation starts again'}.`;
    if (status === 'ended') this.status.textContent = `Layout ${this.name} has run to ${clock(frame.time_s)}.`;
  }

  tellProblem(problem) {
    this.problem.textContent = sentence(problem);
    this.problem.hidden = !problem;
  }

  widen(k, by) {
    this.change(widenHole(this.layout, k, this.layout.holes[k].width_m * 1000 + by));
  }

  add() {
    const more = addHole(this.layout);
    if (!more) return;
    this.change(more.layout);
    this.view.handles.focus(more.added);
    this.status.textContent = `Added ${holeWords(more.layout.holes[more.added], more.added)}.`;
  }

  remove(k) {
    const fewer = removeHole(this.layout, k);
    if (fewer === this.layout) return;
    this.change(fewer);
    this.view.handles.focus(k);
    this.status.textContent = `Removed hole ${k + 1}.`;
  }

  /** At a pace of the transport; undefined: it rests. One that has ended stays so. */
  go(pace) {
    this.pace = pace;
    if (pace === undefined) this.course.pause();
    else this.course.play(pace);
  }

  toggle() {
    const { status } = this.course.state;
    for (const bench of this.all()) bench.go(status === 'playing' ? undefined : realTime);
    if (status === 'ended') this.restart();
  }

  restart() {
    for (const bench of this.all()) bench.open();
  }

  toTheEnd() {
    for (const bench of this.all()) bench.go(asFastAsItCan);
  }

  save() {
    try {
      saveText(seederFile(this.layout, this.data.crops), fileName(this.layout), 'application/toml');
    } catch (error) {
      this.tellProblem(`The seeder file cannot be written: ${error.message}`);
    }
  }

  close() {
    this.due = null;
    clearTimeout(this.opening);
    clearTimeout(this.silence);
    this.course.close();
    this.view.close();
    this.frame.remove();
  }
}

// The replay's section: the canvas, its controls and its legend.
import { Between } from './between.mjs';
import { chainsOf } from './chains.mjs';
import { seedSentence } from './chosen_seed.mjs';
import { colourings } from './colouring.mjs';
import { Counters } from './counters.mjs';
import { choice, element, listChoice, presses, section } from './dom.mjs';
import { clock, force } from './format.mjs';
import { labBox, meanPose } from './geometry.mjs';
import { legendParts } from './legend.mjs';
import { lookAround } from './looking.mjs';
import { poseAt } from './path.mjs';
import { PlaneView } from './plane_view.mjs';
import { nameButton, roundButton } from './round_button.mjs';
import { SpaceView } from './space_view.mjs';
import { Stage } from './stage.mjs';
import { inks, onTheme, theme } from './theme.mjs';

const speeds = [[0.125, '1/8', 'an eighth'], [0.25, '1/4', 'a quarter'], [0.5, '1/2', 'a half'], [1, '1×', 'as fast as it was']];

class Replay {
  constructor(data, recording, player) {
    Object.assign(this, { data, recording, player, still: false, chained: false, chosen: null });
    const tray = Math.max(0, recording.vessels.indexOf('tray'));
    this.canvas = element('canvas', { id: 'replay-canvas', role: 'img', 'aria-label': 'The grains of the run' });
    this.under = recording.fields.includes('z') ? element('canvas', { 'aria-hidden': 'true' }) : null;
    const looked = [data, recording, labBox(data.vessels, recording), meanPose(recording, tray)];
    this.view = this.under ? new SpaceView(...looked, this.under) : new PlaneView(...looked);
    this.between = new Between(recording);
    player.smooth = this.under !== null;
    this.counters = new Counters(data.events, data.holes);
    this.ways = colourings(recording, data);
    this.build();
    this.stage = new Stage(this.canvas, (width) => this.view.height(width), () => this.show());
    player.onChange(() => this.show());
    this.ink = inks();
    onTheme(() => this.repaint());
    this.colourBy(this.ways[0]);
  }

  build() {
    this.legend = element('p', { class: 'legend', id: 'replay-legend' });
    this.forceNote = element('p', { class: 'legend', id: 'replay-forces', hidden: true });
    this.seedNote = element('p', { class: 'legend', id: 'replay-seed', role: 'status', hidden: true });
    this.clock = element('output', { class: 'clock', id: 'replay-time', for: 'replay-frame' });
    this.range = element('input', { type: 'range', id: 'replay-frame', min: 0, max: this.player.last, step: 1, value: 0, 'aria-label': 'Time of the replay',
      oninput: () => {
        const index = Number(this.range.value);  // before it follows the player
        this.player.pause();
        this.player.show(index);
      } });
    this.playButton = roundButton('play', 'Play', () => this.player.toggle());
    this.playButton.classList.add('primary');
    const controls = element('div', { class: 'controls' },
      element('div', { class: 'controls-time' }, this.playButton, roundButton('back', 'One frame back', () => this.player.step(-1)),
        roundButton('forward', 'One frame forward', () => this.player.step(1)), this.range, this.clock),
      element('div', { class: 'controls-choices' },
        choice('Speed', speeds.map(([value, text, name]) => ({ value, text, name })), 1, (value) => this.player.setSpeed(value)),
        this.under ? this.views() : null, this.under ? this.cutting() : null,
        choice('Colour', this.ways.map((way) => ({ value: way, text: way.text })), this.ways[0], (way) => this.colourBy(way)),
        this.data.vessels.some((vessel) => vessel.name === 'tray') ? this.stillSwitch() : null,
        this.recording.forceFrames.length ? this.chainSwitch() : null));
    this.figure = element('div', { class: 'replay card' }, element('div', { class: this.under ? 'stage layered' : 'stage' }, this.under, this.canvas), this.legend, this.forceNote, this.seedNote, controls);
    if (this.under) this.makeTurnable();
  }

  stillSwitch() {
    const box = element('input', { type: 'checkbox', onchange: () => { this.still = box.checked; this.show(); } });
    return element('label', { class: 'switch' }, box, element('span', {}, 'Hold the tray still'));
  }

  chainSwitch() {
    const box = element('input', { type: 'checkbox', onchange: () => { this.chained = box.checked; this.show(); } });
    return element('label', { class: 'switch' }, box, element('span', {}, 'Force chains'));
  }

  // Each press of the last looks through the next hole.
  views() {
    const { holes } = this.view;
    let next = 0;
    const throughHole = () => {
      this.look('hole', next);
      next = (next + 1) % holes.length;
    };
    return presses('View', [['Front', () => this.look('front')], ['Corner', () => this.look('corner')], ['Above', () => this.look('above')],
      ...(holes.length ? [['Hole', throughHole, 'Through a hole, from below']] : [])]);
  }

  // From where, and how far, what stands before the middle is cut away.
  cutting() {
    let side = 'front';
    const range = element('input', { type: 'range', min: 0, max: 100, value: 0, 'aria-label': 'How much is cut away, percent', oninput: () => cut() });
    const cut = () => {
      range.style.setProperty('--done', `${range.value}%`);
      this.view.cutFrom(side, range.value / 100);
      this.paint();
    };
    const sides = listChoice('Cut', [['front', 'from the front'], ['left', 'from the left'], ['top', 'from the top']].map(([value, text]) => ({ value, text })), side, (value) => {
      side = value;
      cut();
    });
    return element('div', { class: 'cut' }, sides, range);
  }

  choose(x, y) {
    const seed = this.shown ? this.view.seedAt(x, y) : null;
    this.chosen = seed === null ? null : this.shown.frame.ids[seed];
    this.paint();
    this.tellChosen();
  }

  async tellChosen() {
    const { chosen, shown } = this;
    this.seedNote.hidden = chosen === null;
    if (chosen === null) return;
    const text = await seedSentence(this.recording, this.data, chosen, shown);
    if (chosen === this.chosen && shown === this.shown) this.seedNote.textContent = text;
  }

  look(name, hole) {
    this.view.camera.look(name, hole);
    this.paint();
  }

  makeTurnable() {
    this.canvas.classList.add('turnable');
    this.canvas.tabIndex = 0;
    this.under.addEventListener('webglcontextlost', () => {
      this.view.withoutGl();
      this.paint();
    });
    lookAround(this.canvas, this.view.camera, { changed: () => this.paint(), reset: () => this.look('front'), choose: (x, y) => this.choose(x, y) });
  }

  async colourBy(way) {
    this.wanted = way;
    const made = await way.make();
    if (this.wanted !== way) return;
    this.colouring = made;
    this.ofForces = way.ofForces === true;
    this.showLegend();
    this.show();
  }

  showLegend() {
    const { legend } = this.colouring;
    const colours = this.colouring.colours(theme());
    const parts = legendParts(legend, colours);
    this.legend.replaceChildren(...parts, element('span', { class: 'legend-note' }, 'Under the holes: seeds so far'));
  }

  countsNow() {
    const until = this.player.index === this.player.last ? Infinity : this.player.moment;
    return new Map(this.data.holes.map((hole) => [hole.hole, this.counters.until(hole.hole, until)]));
  }

  /** Brings controls and picture to the player's frame. */
  async show() {
    const { player } = this;
    const from = performance.now();
    this.range.value = player.index;
    this.range.style.setProperty('--done', `${(100 * player.index) / Math.max(1, player.last)}%`);
    this.range.setAttribute('aria-valuetext', clock(player.moment));
    this.clock.textContent = clock(player.moment);
    this.showPlaying();
    const asked = player.index, { part } = player;
    if (!this.colouring || !this.stage?.width) return;
    this.shown = await this.picture(asked, part);
    if (asked !== player.index && !player.playing) return;
    this.paint(from);
    if (this.chosen !== null) this.tellChosen();
  }

  // What is drawn of a moment, `part` of the way to the next frame: where forces are asked for, of the nearest frame that has them.
  async picture(asked, part) {
    const { recording, colouring } = this;
    const chained = this.chained, forces = chained || this.ofForces;
    const index = forces ? recording.nearestForces(asked) : asked;
    const smooth = forces ? 0 : part;
    const poseOf = (vessel) => poseAt(recording, vessel, this.data.paths?.[recording.vessels[vessel]], index, smooth);
    const recorded = await recording.frame(index);
    const frame = smooth > 0 ? await this.between.frame(index, smooth, poseOf(this.between.tray)) : recorded;
    const known = this.shown?.index === index && this.shown.colouring === colouring;
    const bins = known ? this.shown.bins : await colouring.of(recorded, index);
    const chains = forces ? chainsOf(await recording.contacts(index), frame, recording) : null;
    const time = smooth > 0 ? recording.times[index] + smooth * (recording.times[index + 1] - recording.times[index]) : recording.times[index];
    const counts = this.countsNow();
    return { asked, index, frame, bins, poseOf, time, counts, colouring, forces: chains, chains: chained ? chains : null };
  }

  // How large the forces are, and of which moment.
  showForces({ forces, time, asked }) {
    this.forceNote.hidden = !forces;
    if (!forces) return;
    const when = time === this.recording.times[asked] ? 'now' : `at ${clock(time)}, the nearest moment whose forces are kept`;
    const size = forces.count ? `${forces.count} contacts, ${force(forces.mean)} in the mean, ${force(forces.largest)} at most` : 'no contacts';
    const left = forces === this.shown.chains && this.view.leastChain > 0 ? '; lines are of those above the mean' : '';
    this.forceNote.textContent = `Forces and seeds ${when}: ${size}${left}.`;
  }

  showPlaying() {
    const name = this.player.playing ? 'Pause' : 'Play';
    nameButton(this.playButton, name.toLowerCase(), name);
  }

  // `from`: when the script began that leads to it.
  paint(from = performance.now()) {
    if (!this.shown || !this.stage?.width) return;
    const { shown } = this;
    this.showForces(shown);
    this.view.draw(this.stage, { ...shown, still: this.still, chosen: this.chosen, colours: shown.colouring.colours(theme()), ink: this.ink });
    this.canvas.dataset.counts = JSON.stringify([...shown.counts]);
    this.canvas.dataset.frame = shown.asked;
    this.canvas.setAttribute('aria-label', this.said());
    this.canvas.dataset.scriptMs = (performance.now() - from).toFixed(2);
  }

  repaint() {
    this.ink = inks();
    if (!this.colouring) return;
    this.showLegend();
    this.paint();
  }

  said() {
    const { shown } = this;
    const counts = [...shown.counts].map(([hole, count]) => `hole ${hole}: ${count}`).join(', ');
    const how = this.under ? '. Arrow keys turn it, with Shift they move it, plus and minus zoom, 0 shows its front, Enter chooses the seed in the middle' : '';
    const forces = shown.forces ? ` ${this.forceNote.textContent}` : '';
    return `${shown.frame.ids.length} grains at ${clock(shown.time)}.${forces} Seeds so far, ${counts}${how}.`;
  }
}

// `place`: where keys are heard, the window or one element.
function startKeys(player, place) {
  place.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const target = event.target.closest?.('input, button, a, summary, select, textarea') ?? null;
    const kind = target?.type ?? (target ? 'other' : 'none');
    if (event.key === ' ' && ['none', 'range', 'radio'].includes(kind)) {
      event.preventDefault();
      player.toggle();
    }
    const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (by && !['range', 'radio', 'text'].includes(kind) && !event.target.closest?.('.table-frame, pre')) {
      event.preventDefault();
      player.step(by);
    }
  });
}

/** The replay as a part of another section, whose keys are heard in it alone. */
export function replayFigure(data, recording, player) {
  const { figure } = new Replay(data, recording, player);
  startKeys(player, figure);
  return figure;
}

/** The section; without a recording, what to do to get one. `problem`: why a recording that is there cannot be shown. */
export function replaySection(data, recording, player, problem) {
  if (problem) return section('replay', 'Replay', element('p', { class: 'doubt' }, `The recording in this page cannot be replayed: ${problem}.`));
  if (!recording) {
    return section('replay', 'Replay', element('p', {}, 'This run kept no recording; ', element('code', {}, 'vibrosow run FILE --html'), ' keeps one and shows it here.'));
  }
  const replay = new Replay(data, recording, player);
  startKeys(player, window);
  return section('replay', 'Replay', replay.figure);
}

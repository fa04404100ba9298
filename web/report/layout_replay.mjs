// The replay of the chosen layout, or how to get one.
import { element } from './dom.mjs';
import { number } from './format.mjs';
import { bytesOfBase64 } from './page_data.mjs';
import { Player } from './player.mjs';
import { openRecording } from './recording.mjs';
import { replayFigure } from './replay.mjs';

/** What is told of the run, by its own events. */
export function replaySentence({ random_seed: seed, end_time_s: end, holes, events }) {
  const all = holes.reduce((sum, { counted_all: counted }) => sum + counted, 0);
  const counts = holes.map(({ hole, counted_all: counted }) => `${counted} by hole ${hole}`);
  const by = holes.length > 1 && holes.length <= 8 && all > 0 ? `: ${counts.join(', ')}` : '';
  const spilled = events.hole.filter((hole) => hole === 0).length;
  return `One run of this layout, with random seed ${seed}: ${all} ${all === 1 ? 'seed' : 'seeds'} left in ${number(end)} s${by}${spilled ? `; ${spilled} went over the rim` : ''}.`;
}

function missing({ command }) {
  if (!command) return [];
  return [element('h3', {}, 'Replay'), element('p', { class: 'muted' }, 'This page has no replay of this layout. A page of one run of it is made, in the folder of its seeder, by'),
    element('pre', { class: 'command', tabindex: '0', 'aria-label': 'Command' }, element('code', {}, command)),
    element('p', { class: 'muted' }, element('code', {}, '--replays N'), ' puts replays of the N best layouts into this page.')];
}

export class LayoutReplays {
  constructor() {
    this.frame = element('div', { class: 'layout-replay' });
    this.made = new Map();  // by layout, once it was chosen
  }

  async make({ replay, vessels }) {
    try {
      const recording = await openRecording(bytesOfBase64(replay.recording));
      const player = new Player(recording.times);
      player.showTime(replay.measure_from_s);
      return { player, parts: [replayFigure({ ...replay, vessels }, recording, player), element('p', { class: 'muted' }, replaySentence(replay))] };
    } catch (error) {
      return { player: null, parts: [element('p', { class: 'doubt' }, `The recording of this layout cannot be replayed: ${error.message}.`)] };
    }
  }

  async show(layout) {
    this.layout = layout;
    this.player?.pause();
    this.player = null;
    if (!layout.replay) return this.frame.replaceChildren(...missing(layout));
    if (!this.made.has(layout)) this.made.set(layout, this.make(layout));
    this.frame.replaceChildren(element('h3', {}, 'Replay'));
    const { player, parts } = await this.made.get(layout);
    if (this.layout !== layout) return undefined;
    this.player = player;
    return this.frame.replaceChildren(element('h3', {}, 'Replay'), ...parts);
  }
}

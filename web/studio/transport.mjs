// Play, restart, to the end; how far the run is and how fast it goes.
import { element } from '../report/dom.mjs';
import { clock, number } from '../report/format.mjs';
import { nameButton, roundButton } from '../report/round_button.mjs';

export const realTime = 1;          // simulated seconds a second
export const asFastAsItCan = null;

function speedWords({ speed_ratio: ratio }) {
  if (!(ratio > 0)) return 'Running';
  if (Math.abs(ratio - 1) < 0.05) return 'In real time';
  return ratio < 1 ? `${number(ratio, 2)} of real time` : `${number(ratio, 2)} times real time`;
}

const words = {
  opening: () => 'Preparing', ready: () => 'At the start', paused: () => 'Paused', ended: () => 'At its end', failed: () => 'Not running',
  changed: () => 'Changed: starts again', playing: ({ frame }) => waits[frame.waiting] ?? speedWords(frame),
};

const waits = { motion: 'Waits for the shake before', holes: 'Waits: seeds are in the way' };

export class Transport {
  /** `acts`: { toggle(), restart(), toTheEnd() } */
  constructor(acts) {
    this.play = roundButton('play', 'Play', acts.toggle);
    this.play.classList.add('primary');
    this.restart = roundButton('restart', 'Restart', acts.restart);
    this.toTheEnd = roundButton('end', 'To the end, as fast as it can', acts.toTheEnd);
    this.bar = element('progress', { max: 1, value: 0, 'aria-label': 'Time of the run' });
    this.clock = element('span', { class: 'clock' });
    this.speed = element('span', { class: 'speed muted' });
    this.frame = element('div', { class: 'controls-time' }, this.play, this.restart, this.toTheEnd, this.bar, element('span', { class: 'times' }, this.clock, this.speed));
  }

  /** `news`: said in place of how fast it goes; mostly nothing. */
  show(state, news = '') {
    const { status, prepared, frame } = state;
    const playing = status === 'playing';
    nameButton(this.play, playing ? 'pause' : 'play', playing ? 'Pause' : 'Play');
    this.play.disabled = ['opening', 'failed', 'changed'].includes(status);
    this.restart.disabled = this.play.disabled || status === 'ready';
    this.toTheEnd.disabled = this.play.disabled || status === 'ended';
    this.speed.textContent = news || words[status](state);
    this.clock.textContent = prepared ? `${clock(frame.time_s)} of ${number(prepared.duration_s)} s` : '';
    this.bar.value = prepared ? frame.time_s / prepared.duration_s : 0;
    this.bar.setAttribute('aria-valuetext', this.clock.textContent);
  }
}

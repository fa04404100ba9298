// What the holes have let out so far: rates with their intervals, unevenness, guard, doubts.
import { element } from '../report/dom.mjs';
import { number, sentence } from '../report/format.mjs';
import { intervalTrack, scaleOf, trackAxis } from '../report/interval_track.mjs';
import { differentRemarks, remarkItem } from '../report/light.mjs';
import { RollingRate } from './rolling.mjs';
import { wantedWords } from './wanted.mjs';

const rated = (hole) => Number.isFinite(hole.seeds_per_s);

const leastWindow = 0.1; // s, of which rates are shown, unless the run has ended
const newsEvery = 250;   // ms of the clock, of the rate of the last shakes: so that it can be read

/** The outcome of a course's state once something has been measured; null before that. */
export function measured({ status, prepared, outcome }) {
  const window = outcome ? outcome.end_time_s - prepared.measure_from_s : 0;
  return window > (status === 'ended' ? 0 : leastWindow) ? outcome : null;
}

function valuesOf(outcome) {
  return (outcome?.holes ?? []).filter(rated).map((hole) => ({ hole, value: { value: hole.seeds_per_s, low: hole.low ?? null, high: hole.high ?? null, below: false } }));
}

function barsOf(outcome, scale) {
  const values = valuesOf(outcome);
  return values.length === 0 ? [] : [
    element('li', { class: 'hole-head', 'aria-hidden': 'true' }, element('span'), trackAxis(scale), element('span', { class: 'number' }, 'seeds/s')),
    ...values.map(({ hole, value }) => element('li', {}, element('span', {}, `hole ${hole.hole}`), intervalTrack(scale, value, { bar: true }),
      element('span', { class: 'number' }, number(value.value), element('span', { class: 'unseen' }, ' seeds/s')))),
  ];
}

function figure(term, value, words) {
  return element('div', {}, element('dt', {}, term), element('dd', { class: 'value' }, value), words ? element('dd', { class: 'muted' }, words) : null);
}

function wantedFigure({ value, words }) {
  return figure('Wanted', value, words);
}

// Nothing where so few seeds show no difference: the sentence says so.
function cvText({ cv_percent: cv }) {
  return Number.isFinite(cv) ? `CV ${number(cv)} %` : '';
}

function windowWords(state) {
  const { measure_from_s: from, since_s: since } = state.prepared, until = measured(state)?.end_time_s;
  const changed = since > 0 ? `Changed at ${number(since)} s. ` : '';
  if (until) return `${changed}Measured from ${number(from)} to ${number(until)} s.`;
  return changed + (state.frame.time_s > from ? 'Measuring has begun.' : `Measuring begins at ${number(from)} s.`);
}

// s of a shake; null of a tray that does not shake to and fro.
function periodOf(motion) {
  return motion?.kind === 'harmonic' && motion.amplitude_m > 0 ? 1 / motion.frequency_hz : null;
}

// "last 3 shakes"; of a tray that does not shake to and fro, "last 0.5 s".
function lately({ shakes, from_s: from, until_s: until }) {
  if (shakes === null) return `Last ${number(until - from, 2)} s`;
  return shakes === 1 ? 'Last shake' : `Last ${shakes} shakes`;
}

function latelyFigure(rolling) {
  const { seeds_per_s: rate, low, high } = rolling.all;
  return figure(lately(rolling), `${number(rate)} seeds/s, ${number(low)} to ${number(high)}`);
}

const endings = { stopped_by_guard: 'The guard stopped this run' };

/** `remarks`, the doubts, has a place of its own, on top of what they are about; `guard`, what the guard saw, one below. */
export class OutflowPanel {
  constructor() {
    this.window = element('p', { class: 'hint' });
    this.bars = element('ul', { class: 'hole-bars' });
    this.figures = element('dl', { class: 'figures' });
    this.remarks = element('ul', { class: 'remarks', 'aria-label': 'What to know about this layout', tabindex: '0', hidden: true });  // where it is cut short, the focus shows it whole
    this.guard = element('p', { class: 'hint guard' });
    this.frame = element('div', { role: 'group', class: 'panel outflow', 'aria-label': 'Outflow of the holes' }, element('div', { class: 'panel-head' }, element('h3', {}, 'Outflow'), this.window), this.bars, this.figures);
  }

  /** `state`: of the course, of this `scene`. Of one that is not prepared there is nothing to say. */
  show(state, scene) {
    const { status, prepared, frame, outcome } = state;
    this.frame.classList.toggle('stale', ['changed', 'opening'].includes(status));
    this.window.textContent = prepared ? windowWords(state) : '';
    Object.assign(this, { state, scene });
    if (prepared !== this.prepared) this.rolling = prepared && new RollingRate(periodOf(scene.tray.motion), prepared.since_s);
    if (prepared) this.rolling.take(frame);
    const now = performance.now();
    const news = prepared && status !== this.status || now - (this.filled ?? 0) >= newsEvery;
    if (news || outcome !== this.outcome || prepared !== this.prepared) {
      this.filled = now;
      this.fill(state);
    }
    Object.assign(this, { outcome, prepared, status });
  }

  /** Tells what a task wants, too: see wantedWords. null: nothing is wanted. */
  want(task) {
    this.task = task;
    if (this.state) this.fill(this.state);
  }

  /** Draws the bars on a scale that holds those of all layouts of the page; `all`: the `rates` of each. */
  showBeside(all) {
    const scale = scaleOf(all.flatMap(valuesOf).map(({ value }) => value));
    if (this.drawn && this.drawn.rates === this.rates && this.drawn.high === scale.high) return;
    this.drawn = { rates: this.rates, high: scale.high };
    this.bars.replaceChildren(...barsOf(this.rates, scale));
  }

  fill(state) {
    const { prepared, outcome } = state;
    const rates = prepared && measured(state), rolling = prepared && this.rolling.now();
    this.rates = rates ?? rolling;
    this.figures.replaceChildren(...[
      rates && prepared.holes ? figure('All holes', `${number(rates.total_seeds_per_s)} seeds/s`) : null,
      rolling && prepared.holes ? latelyFigure(rolling) : null,
      this.task && prepared ? wantedFigure(wantedWords(this.task, this.scene.lots, rates)) : null,
      rates?.unevenness ? figure('Unevenness (CV)', cvText(rates.unevenness), sentence(rates.unevenness.sentence)) : null,
    ].filter(Boolean));
    this.guard.textContent = sentence(outcome?.guard);
    const ending = endings[outcome?.status];
    const remarks = differentRemarks([...(ending ? [{ serious: true, text: ending }] : []), ...(prepared?.remarks ?? []), ...(outcome?.remarks ?? [])]);
    const shown = JSON.stringify(remarks);
    if (shown === this.shown) return;  // so that they can be read, and marked, in peace
    this.shown = shown;
    this.remarks.replaceChildren(...remarks.map(remarkItem));
    this.remarks.hidden = remarks.length === 0;
  }
}

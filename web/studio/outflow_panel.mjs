// What the holes have let out so far: rates with their intervals, unevenness, guard, doubts.
import { element } from '../report/dom.mjs';
import { number, sentence } from '../report/format.mjs';
import { intervalTrack, scaleOf, trackAxis } from '../report/interval_track.mjs';

const rated = (hole) => Number.isFinite(hole.seeds_per_s);

const leastWindow = 0.1; // s, of which rates are shown, unless the run has ended

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

// Nothing where so few seeds show no difference: the sentence says so.
function cvText({ cv_percent: cv }) {
  return Number.isFinite(cv) ? `CV ${number(cv)} %` : '';
}

function windowWords(state) {
  const from = state.prepared.measure_from_s, until = measured(state)?.end_time_s;
  if (until) return `Measured from ${number(from)} to ${number(until)} s.`;
  return state.frame.time_s > from ? 'Measuring has begun.' : `Measuring begins at ${number(from)} s.`;
}

const endings = { stopped_by_guard: 'The guard stopped this run' };

/** `remarks`, the doubts, has a place of its own: on top of what they are about. */
export class OutflowPanel {
  constructor() {
    this.window = element('p', { class: 'hint' });
    this.bars = element('ul', { class: 'hole-bars' });
    this.figures = element('dl', { class: 'figures' });
    this.remarks = element('ul', { class: 'remarks', 'aria-label': 'What to know about this layout', hidden: true });
    this.frame = element('div', { role: 'group', class: 'panel outflow', 'aria-label': 'Outflow of the holes' }, element('h3', {}, 'Outflow'), this.window, this.bars, this.figures);
  }

  /** `state`: of the course. Of a scene that is not prepared there is nothing to say. */
  show(state) {
    this.frame.classList.toggle('stale', ['changed', 'opening'].includes(state.status));
    this.window.textContent = state.prepared ? windowWords(state) : '';
    if (state.outcome !== this.outcome || state.prepared !== this.prepared) this.fill(state);
    Object.assign(this, { outcome: state.outcome, prepared: state.prepared });
  }

  /** Draws the bars on a scale that holds those of all layouts of the page. */
  showBeside(outcomes) {
    const scale = scaleOf(outcomes.flatMap(valuesOf).map(({ value }) => value));
    if (this.drawn && this.drawn.rates === this.rates && this.drawn.high === scale.high) return;
    this.drawn = { rates: this.rates, high: scale.high };
    this.bars.replaceChildren(...barsOf(this.rates, scale));
  }

  fill(state) {
    const { prepared, outcome } = state;
    const rates = this.rates = prepared && measured(state);
    this.figures.replaceChildren(...[
      rates && prepared.holes ? figure('All holes', `${number(rates.total_seeds_per_s)} seeds/s`) : null,
      rates?.unevenness ? figure('Unevenness (CV)', cvText(rates.unevenness), sentence(rates.unevenness.sentence)) : null,
      outcome?.guard ? figure('Guard', '', sentence(outcome.guard)) : null,
    ].filter(Boolean));
    const doubts = [endings[outcome?.status], ...new Set([...(prepared?.remarks ?? []), ...(outcome?.remarks ?? [])])].filter(Boolean);
    this.remarks.replaceChildren(...doubts.map((doubt) => element('li', {}, sentence(doubt))));
    this.remarks.hidden = doubts.length === 0;
  }
}

// The layouts in the order of a chosen figure, each with its interval.
import { choice, element, listChoice, section } from './dom.mjs';
import { intervalTrack, scaleOf, trackAxis } from './interval_track.mjs';
import { textOf, titleOf } from './layout_figures.mjs';
import { keyWords, layoutName } from './layout_words.mjs';
import { ranked, rankingSentence } from './ranking.mjs';
import { numbersOf } from './same_layouts.mjs';
import { toldWords } from './told_words.mjs';

const shownAtFirst = 30;

class RankedChart {
  constructor(data, figures, figure, chosen, filter) {
    Object.assign(this, { data, chosen, figure, wanted: filter.wanted, leastFirst: figure.wanted_low, all: false });
    this.list = element('ol', { class: 'ranks' });
    this.sentence = element('p', { id: 'ranking-sentence', class: 'lead', 'aria-live': 'polite' });
    this.legend = element('p', { class: 'legend' });
    this.more = element('button', { type: 'button', class: 'quiet', onclick: () => { this.all = !this.all; this.show(); } });
    this.order = element('div', {});
    this.figureChoice = listChoice('Figure', figures.map((one) => ({ value: one, text: titleOf(one) })), figure, (one) => this.rankBy(one));
    this.head = element('div', { class: 'rank-head', 'aria-hidden': 'true' });
    this.frame = element('div', {}, element('div', { class: 'choices' }, this.figureChoice, this.order), this.sentence,
      element('figure', { class: 'card' }, this.head, this.list, this.more, element('figcaption', {}, this.legend)));
    this.rankBy(figure);
    chosen.onChange(() => this.mark());
    filter.onChange((shown) => { this.data = shown; this.show(); });
  }

  rankBy(figure) {
    this.figure = figure;
    this.leastFirst = figure.wanted_low;
    this.order.replaceChildren(choice('Order', [{ value: false, text: 'Most first' }, { value: true, text: 'Least first' }], this.leastFirst,
      (leastFirst) => { this.leastFirst = leastFirst; this.show(); }));
    this.show();
  }

  show() {
    const { data, figure } = this;
    const rows = ranked(data.layouts, figure, this.leastFirst);
    const scale = scaleOf(rows.map((row) => row.value));
    const first = rows.find((row) => row.told === 'first')?.value ?? null;
    const shown = this.all ? rows : rows.slice(0, shownAtFirst);
    const words = keyWords(data.keys);
    this.words = toldWords(data, figure, this.leastFirst);
    this.sentence.textContent = rankingSentence(data, rows, figure, this.leastFirst);
    this.head.replaceChildren(element('span', {}, words.map((key) => key.words).join(' · ')), trackAxis(scale), element('span', { class: 'number' }, titleOf(figure)));
    this.list.replaceChildren(...shown.map((row) => this.row(row, scale, first)));
    this.more.hidden = rows.length <= shownAtFirst;
    this.more.textContent = this.all ? `Show the first ${shownAtFirst}` : `Show all ${rows.length}`;
    this.showLegend(rows, scale, first);
    this.mark();
  }

  row({ layout, value, told }, scale, first) {
    const note = this.words.note({ layout, told });
    return element('li', {}, element('button', { type: 'button', class: `rank ${told.replace(' ', '-')}`, 'data-layout': layout.number, onclick: () => this.chosen.choose(layout.number) },
      element('span', { class: 'rank-name', title: layoutName(this.data, layout) }, element('b', {}, `${numbersOf(layout)} `), layoutName(this.data, layout)),
      intervalTrack(scale, value, { band: first, wanted: this.wanted.of(this.figure) }),
      element('span', { class: 'rank-value number' }, textOf(value), note ? element('span', { class: 'rank-note' }, ` ${note}`) : null)));
  }

  showLegend(rows, scale, first) {
    const has = (told) => rows.some((row) => row.told === told);
    const point = (told) => element('span', { class: `legend-item rank ${told}` }, element('span', { class: 'point' }), this.words[told]);
    this.legend.replaceChildren(...[
      first ? point('first') : null,
      has('alike') ? point('alike') : null,
      has('apart') ? point('apart') : null,
      has('not compared') ? point('not-ok') : null,
      first && first.low !== null ? element('span', { class: 'legend-item' }, element('span', { class: 'swatch window' }), this.words.band) : null,
      this.wanted.of(this.figure) ? element('span', { class: 'legend-item' }, element('span', { class: 'wanted-stroke' }), 'what is wanted') : null,
      scale.cut ? element('span', {}, 'Intervals that reach the right edge go on beyond it.') : null,
      this.figure.has_interval || this.figure.with_ends ? null : element('span', {}, 'All runs of a layout together give this figure: it has no interval.'),
    ].filter(Boolean));
  }

  mark() {
    for (const button of this.list.querySelectorAll('button')) {
      button.setAttribute('aria-pressed', String(Number(button.dataset.layout) === this.chosen.number));
    }
  }
}

/** `figure`: the one to begin with. */
export function rankingSection(data, figures, figure, chosen, filter) {
  return section('ranking', 'Layouts in order', new RankedChart(data, figures, figure, chosen, filter).frame);
}

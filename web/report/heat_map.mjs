// The figure of a factorial study over two of its choices, and what each choice does by itself.
import { mix } from './colours.mjs';
import { element, listChoice, section } from './dom.mjs';
import { cellsOf, factorialOf, mainEffects } from './factorial.mjs';
import { number, sentence } from './format.mjs';
import { intervalTrack, scaleOf, trackAxis } from './interval_track.mjs';
import { titleOf } from './layout_figures.mjs';
import { onTheme, themeColour } from './theme.mjs';

const strongest = 0.5;  // of the accent in a cell, so that its text is read

const isWithin = (summary, wanted) => wanted && summary && summary.value >= wanted.low && summary.value <= wanted.high;

/** "Rate depends most on holes: 4.2 to 12.1 g/s in the mean; least on span: 7.9 to 8.1 g/s." */
export function effectsSentence(effects, figure) {
  const said = ({ factor, levels }) => {
    const means = levels.filter(({ summary }) => summary).map(({ summary }) => summary.value);
    return `${factor.name}: ${number(Math.min(...means))} to ${number(Math.max(...means))}${figure.unit ? ` ${figure.unit}` : ''} in the mean`;
  };
  const known = effects.filter(({ levels }) => levels.some(({ summary }) => summary));
  if (known.length === 0) return `No layout that can be compared has a value of ${figure.words}.`;
  return sentence(`${figure.words} depends most on ${said(known[0])}${known.length > 1 ? `; least on ${said(known[known.length - 1])}` : ''}`);
}

class HeatMap {
  constructor(data, factors, figures, figure, chosen, filter) {
    Object.assign(this, { data, factors, figure, chosen, wanted: filter.wanted });
    [this.down, this.across] = mainEffects(data, factors, figure).map(({ factor }) => factor);
    this.sentence = element('p', { id: 'effects-sentence', class: 'lead', 'aria-live': 'polite' });
    this.table = element('table', { class: 'heat-map' });
    this.effects = element('ul', { class: 'hole-bars effect-bars' });
    this.note = element('figcaption', {});
    this.axes = element('div', { class: 'choices' });
    this.figures = figures.map((one) => ({ value: one, text: titleOf(one) }));
    this.frame = element('div', {}, this.axes, this.sentence, element('figure', { class: 'card' },
      element('div', { class: 'table-frame', tabindex: '0', role: 'region', 'aria-label': 'Heat map' }, this.table), this.note), element('h3', {}, 'What each choice does by itself'), element('figure', { class: 'card' }, this.effects,
      element('figcaption', { class: 'muted' }, 'Bars: means over all layouts with that choice. Lines: from the least of them to the most.')));
    this.choose();
    onTheme(() => this.draw());
    chosen.onChange(() => this.mark());
    filter.onChange((shown) => { this.data = shown; this.draw(); });
  }

  // The lists, which never name one factor twice.
  choose() {
    const list = (title, of, take) => listChoice(title, this.factors.map((one) => ({ value: one, text: one.name })), of, (one) => {
      take(one);
      this.choose();
    });
    this.axes.replaceChildren(listChoice('Shown', this.figures, this.figure, (one) => { this.figure = one; this.draw(); }),
      list('Down', this.down, (one) => { if (one === this.across) this.across = this.down; this.down = one; }),
      list('Along', this.across, (one) => { if (one === this.down) this.down = this.across; this.across = one; }));
    this.draw();
  }

  draw() {
    const { data, factors, figure, down, across } = this;
    const cells = cellsOf(data, [down, across], figure), effects = mainEffects(data, factors, figure);
    const means = cells.flat().filter(({ summary }) => summary).map(({ summary }) => summary.value);
    this.ends = [Math.min(...means), Math.max(...means)];
    this.sentence.textContent = effectsSentence(effects, figure);
    this.table.replaceChildren(element('caption', { class: 'unseen' }, `${titleOf(figure)} by ${down.name} and ${across.name}`),
      element('thead', {}, element('tr', {}, element('th', { scope: 'col' }, `${down.name} \\ ${across.name}`), across.levels.map((level) => element('th', { scope: 'col', class: 'number' }, level || '–')))),
      element('tbody', {}, cells.map((row, k) => element('tr', {}, element('th', { scope: 'row' }, down.levels[k] || '–'), row.map((cell) => this.cell(cell))))));
    this.drawEffects(effects);
    const others = factors.filter((factor) => factor !== down && factor !== across).map(({ name }) => name);
    const wanted = this.wanted.of(figure);
    this.note.textContent = [`${sentence(titleOf(figure))} The stronger the colour, the more.`, others.length ? `Each cell is the mean over ${others.join(' and ')}.` : 'A press on a cell chooses its layout.',
      wanted ? `Framed: from ${number(wanted.low)} to ${number(wanted.high)}, as wanted.` : ''].filter(Boolean).join(' ');
    this.mark();
  }

  cell({ layouts, summary }) {
    if (!summary) return element('td', { class: 'number' }, '–');
    const [low, high] = this.ends;
    const colour = mix(themeColour('card'), themeColour('accent'), high > low ? (strongest * (summary.value - low)) / (high - low) : 0);
    const text = number(summary.value), [only] = layouts;
    return element('td', { class: `number${isWithin(summary, this.wanted.of(this.figure)) ? ' as-wanted' : ''}`, style: `background:${colour}` },
      layouts.length === 1 ? element('button', { type: 'button', class: 'pick', 'data-layout': only.number, 'aria-label': `${text}: show layout ${only.number}`, onclick: () => this.chosen.choose(only.number) }, text) : text);
  }

  drawEffects(effects) {
    const all = effects.flatMap(({ levels }) => levels).filter(({ summary }) => summary);
    const scale = scaleOf(all.map(({ summary }) => ({ ...summary, below: false })));
    this.effects.replaceChildren(element('li', { class: 'hole-head', 'aria-hidden': 'true' }, element('span'), trackAxis(scale), element('span', { class: 'number' }, titleOf(this.figure))),
      ...effects.flatMap(({ factor, levels }) => levels.filter(({ summary }) => summary).map(({ level, summary }, k) => element('li', { class: k === 0 ? 'first-level' : null },
        element('span', {}, `${factor.name} ${level || '–'}`), intervalTrack(scale, summary, { bar: true, wanted: this.wanted.of(this.figure) }), element('span', { class: 'number' }, number(summary.value))))));
  }

  mark() {
    for (const button of this.table.querySelectorAll('button')) button.setAttribute('aria-pressed', String(Number(button.dataset.layout) === this.chosen.number));
  }
}

/** null of a study that is not of every combination of its choices. */
export function heatMapSection(data, figures, figure, chosen, filter) {
  const factors = factorialOf(data);
  if (factors.length === 0 || !figure) return null;
  return section('heat-map', 'Every combination', new HeatMap(data, factors, figures, figure, chosen, filter).frame);
}

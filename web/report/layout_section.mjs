// The chosen layout: drawn, with all its figures and its holes.
import { element, listChoice } from './dom.mjs';
import { sentence } from './format.mjs';
import { intervalTrack, scaleOf, trackAxis } from './interval_track.mjs';
import { textOf, textWithUnit, titleOf, valueOf } from './layout_figures.mjs';
import { LayoutReplays } from './layout_replay.mjs';
import { keyWords, sentenceWithNote, withUnit } from './layout_words.mjs';
import { numbersOf } from './same_layouts.mjs';
import { boxesOf, trayDrawing } from './tray_drawing.mjs';

const ofHoles = [
  { name: 'seeds_per_s', words: 'seeds', unit: '1/s' }, { name: 'g_per_s', words: 'rate', unit: 'g/s' },
  { name: 'longest_pause_s', words: 'longest pause', unit: 's' },
];
const statusWords = {
  'outside the model': 'It lies outside the model, so it must not be used', invalid: 'It cannot be built',
  stopped: 'The guard stopped a run of it', incomplete: 'Runs of it are missing', failed: 'It failed', clogs: 'It clogs', spills: 'It spills',
  'misses the rate': 'It misses the rate', 'misses the rate or spills': 'It misses the rate or spills', 'ruled out by drafts': 'Drafts ruled it out',
};

function settings(data, layout) {
  const rows = keyWords(data.keys).map(({ words, unit }, k) => [words, layout.values[k], unit, layout.at_edge.includes(k)]).filter(([, value]) => value !== undefined && value !== '');
  return element('dl', { class: 'settings narrow' }, rows.map(([words, value, unit, isEdge]) => element('div', {}, element('dt', {}, words),
    element('dd', {}, withUnit(value, unit), isEdge ? element('span', { class: 'at-edge' }, ', the end of its range') : null))));
}

function figureList(layout, figures) {
  const known = figures.map((figure) => ({ figure, value: valueOf(layout, figure) })).filter(({ value }) => value);
  if (known.length === 0) return element('p', { class: 'muted' }, 'It has no figures.');
  return element('dl', { class: 'figures' }, known.map(({ figure, value }) => element('div', {},
    element('dt', {}, figure.words), element('dd', { class: 'value' }, textWithUnit(value, figure)), element('dd', { class: 'muted' }, figure.description))));
}

// Where several lots leave by a hole, the row of all of them.
function wholeHoles(layout) {
  const all = layout.holes.filter((hole) => hole.lot === 'all');
  return all.length ? all : layout.holes;
}

class HoleBars {
  constructor() {
    this.figure = ofHoles[0];
    this.list = element('ul', { class: 'hole-bars' });
    this.frame = element('div', {}, element('h3', {}, 'Holes'), element('div', { class: 'choices' },
      listChoice('Figure of the holes', ofHoles.map((one) => ({ value: one, text: titleOf(one) })), this.figure, (one) => { this.figure = one; this.show(this.layout); })), this.list);
  }

  show(layout) {
    this.layout = layout;
    const holes = wholeHoles(layout).map((hole) => ({ hole, value: valueOf({ means: hole }, this.figure) })).filter(({ value }) => value);
    const several = new Set(wholeHoles(layout).map((hole) => hole.lot)).size > 1;
    this.frame.hidden = layout.holes.length === 0;
    const scale = scaleOf(holes.map(({ value }) => value));
    this.list.replaceChildren(element('li', { class: 'hole-head', 'aria-hidden': 'true' }, element('span'), trackAxis(scale), element('span', { class: 'number' }, titleOf(this.figure))),
      ...holes.map(({ hole, value }) => element('li', {}, element('span', {}, several ? `hole ${hole.hole}, ${hole.lot}` : `hole ${hole.hole}`),
        intervalTrack(scale, value, { bar: true }), element('span', { class: 'number' }, textOf(value)))));
    if (holes.length === 0) this.list.replaceChildren(element('li', { class: 'muted' }, `No hole has a ${this.figure.words}.`));
  }
}

/** `why(layout)`: why it stands as it does. Follows the choice; on a narrow page it comes into sight when the reader chooses. */
export function layoutSection(data, figures, chosen, why = () => '') {
  const boxes = boxesOf(data.layouts.map(({ vessels }) => vessels), data.space);
  const bars = new HoleBars();
  const replays = new LayoutReplays();
  const title = element('h2', { id: 'layout-title', 'aria-live': 'polite' });
  const about = element('div', {});
  const numbers = element('div', {});
  const frame = element('section', { id: 'layout', tabindex: '0', 'aria-labelledby': 'layout-title' }, title, about, replays.frame, bars.frame, numbers);
  chosen.onChange((byReader) => {
    const { layout } = chosen;
    if (!layout) return;
    const doubt = statusWords[layout.status] ? sentenceWithNote(statusWords[layout.status], layout.note) : layout.note;
    title.textContent = layout.name ? `Layout ${numbersOf(layout)}: ${layout.name}` : `Layout ${numbersOf(layout)}`;
    about.replaceChildren(...[doubt ? element('p', { class: 'doubt' }, doubt) : null, layout.standing && layout.compared ? element('p', { class: 'standing' }, [sentence(layout.standing), why(layout)].filter(Boolean).join(' ')) : null, layout.expected ? element('p', { class: 'expected' }, sentence(layout.expected)) : null, trayDrawing(`Layout ${layout.number}`, layout.vessels, boxes), settings(data, layout)].filter(Boolean));
    replays.show(layout);
    bars.show(layout);
    const runs = layout.replicates === 1 ? 'From one run: no intervals.' : `Means of ${layout.replicates} runs, ± half the width of the 95 % interval; what has no ± is of all runs together.`;
    numbers.replaceChildren(element('h3', {}, 'Figures'), layout.replicates ? element('p', { class: 'muted' }, runs) : '', figureList(layout, figures));
    frame.scrollTop = 0;
    if (byReader && getComputedStyle(frame).position !== 'sticky') frame.scrollIntoView({ block: 'start' });
  });
  return frame;
}

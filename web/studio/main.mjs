// The studio: seeders that sow while one changes them.
import { element } from '../report/dom.mjs';
import { sentence } from '../report/format.mjs';
import { startTheme } from '../report/theme.mjs';
import { themeSwitch } from '../report/theme_switch.mjs';
import { Bench } from './bench.mjs';
import { restingSeeders } from './choices.mjs';
import { Comparison } from './comparison.mjs';
import { startOf } from './layout.mjs';
import { layoutsOf } from './link.mjs';
import { Share } from './share.mjs';
import { readStudioData } from './studio_data.mjs';

const plainWords = 'A 2D slice one seed thick: use it to compare layouts; it is no sowing rate.';

class Studio {
  constructor(data, { layouts, notice }) {
    this.data = data;
    this.benches = [];
    this.comparison = new Comparison();
    this.share = new Share(() => this.benches.map((bench) => bench.layout));
    this.compareButton = element('button', { type: 'button', class: 'quiet', onclick: () => this.toggleSecond() });
    this.place = element('div', { class: 'benches' });
    this.comparison.frame.hidden = true;
    this.notice = element('p', { class: 'doubt', role: 'alert', hidden: !notice }, sentence(notice));
    this.layouts = layouts;
  }

  head() {
    return [
      element('div', { class: 'topline' }, element('h1', {}, 'Move a hole and watch it sow'), element('div', { class: 'actions' }, this.compareButton, this.share.button, themeSwitch())),
      this.share.frame,
      element('p', { class: 'plain' }, element('span', { class: 'roomy' }, 'Every seed is simulated here, in this page. '), element('b', {}, plainWords)), this.notice,
    ];
  }

  page() {
    this.layouts.forEach((layout) => this.add(layout));
    return [this.comparison.frame, this.place, restingSeeders(this.data)].filter(Boolean);
  }

  add(layout) {
    const bench = new Bench(this.data, 'AB'[this.benches.length], layout, (told, what) => this.told(what));
    this.benches.push(bench);
    this.place.append(bench.frame);
    this.showCount();
  }

  toggleSecond() {
    if (this.benches.length < 2) this.add(this.benches[0].layout);
    else this.benches.pop().close();
    this.showCount();
    this.told('layout');
  }

  showCount() {
    const two = this.benches.length === 2;
    document.documentElement.dataset.benches = this.benches.length;
    this.compareButton.textContent = two ? 'Remove layout B' : 'Compare layouts';
    this.comparison.frame.hidden = !two;
  }

  told(what) {
    if (what === 'layout') this.share.hide();
    const outcomes = this.benches.map((bench) => bench.outcome);
    if (outcomes.length === 2) this.comparison.show(...outcomes);
    const rates = this.benches.map((bench) => bench.outflow.rates);
    for (const bench of this.benches) bench.outflow.showBeside(rates);
  }
}

// What the page opens with: the link's layouts, else the seeder that the program named. Seeders that a link brings join those of the page.
async function opening(data) {
  const { asked, opened } = data;
  const notice = asked && asked !== opened ? `${asked.title || asked.name} is not simulated in this page. ${sentence(asked.why_not)}` : '';
  try {
    const layouts = await layoutsOf(location.hash, data);
    if (layouts) {
      data.linked = [...new Set(layouts.map(({ seeder }) => seeder))].filter((seeder) => !data.seeders.includes(seeder));
      return { layouts, notice: '' };
    }
  } catch (error) {
    return { layouts: [startOf(opened)], notice: `The link cannot be opened: ${error.message}` };
  }
  return { layouts: [startOf(opened)], notice };
}

async function show() {
  startTheme();
  addEventListener('hashchange', () => location.reload());
  const data = readStudioData(document.getElementById('studio-data').textContent);
  const studio = new Studio(data, await opening(data));
  document.documentElement.dataset.kind = 'studio';
  document.getElementById('head').replaceChildren(...studio.head());
  document.getElementById('page').replaceChildren(...studio.page());
  const { name = 'vibrosow', version = '' } = data.program;
  document.getElementById('foot').replaceChildren(element('p', {}, `Written by ${name} ${version}. The simulator is in this file: it works without a network.`));
  document.documentElement.dataset.ready = 'true';
}

show().catch((error) => {
  document.getElementById('page').replaceChildren(element('p', { class: 'doubt' }, `This page cannot show what is in it: ${error.message}.`));
  throw error;
});

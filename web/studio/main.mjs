// The studio: seeders that sow while one changes them.
import { element } from '../report/dom.mjs';
import { sentence } from '../report/format.mjs';
import { paperStyle } from '../report/paper.mjs';
import { startTheme } from '../report/theme.mjs';
import { themeSwitch } from '../report/theme_switch.mjs';
import { Bench } from './bench.mjs';
import { restingSeeders } from './choices.mjs';
import { Comparison } from './comparison.mjs';
import { History } from './history.mjs';
import { Kept } from './kept.mjs';
import { holdInStep } from './in_step.mjs';
import { startOf } from './layout.mjs';
import { fragmentOf, isLink, layoutsOf, textOfLayouts } from './link.mjs';
import { saveText } from '../report/save.mjs';
import { oneFile } from './one_file.mjs';
import { Share } from './share.mjs';
import { readStudioData } from './studio_data.mjs';
import { taskOf, Wanted } from './wanted.mjs';

const title = 'Move a hole and watch it sow';
const plainWords = 'A 2D slice one seed thick: use it to compare layouts; it is no sowing rate.';

class Studio {
  constructor(data, { kept, keptTask }, { layouts, notice, asLeft }) {
    Object.assign(this, { data, kept, keptTask, benches: [], writing: Promise.resolve() });
    this.history = new History(layouts, textOfLayouts);
    this.comparison = new Comparison();
    this.share = new Share(() => this.made());
    const press = (text, act) => element('button', { type: 'button', class: 'quiet', onclick: act }, text);
    this.undoButton = press('Undo', () => this.take(this.history.undo()));
    this.redoButton = press('Redo', () => this.take(this.history.redo()));
    this.resetButton = press('Reset', () => this.reset());
    this.compareButton = press('', () => this.toggleSecond());
    this.wanted = new Wanted(taskOf(keptTask.read()), (task) => this.want(task));
    this.sendButton = press('Send as one file', () => this.send());
    this.place = element('div', { class: 'benches' });
    this.comparison.frame.hidden = true;
    this.notice = element('p', { class: 'doubt', role: 'alert', hidden: !notice }, sentence(notice));
    this.said = element('span', { role: 'status' }, asLeft ? ' These are the layouts that you left here; Reset goes back.' : '');
    addEventListener('keydown', (event) => this.key(event));
  }

  head() {
    return [
      element('div', { class: 'topline' }, element('h1', {}, title), element('div', { class: 'actions' },
        this.undoButton, this.redoButton, this.resetButton, this.wanted.button, this.compareButton, this.share.button, this.sendButton, themeSwitch())),
      this.share.frame, this.wanted.frame,
      element('p', { class: 'plain' }, element('span', { class: 'roomy' }, 'Every seed is simulated here, in this page; holes and shake change while it runs. '), element('b', {}, plainWords), this.said), this.notice,
    ];
  }

  page() {
    this.history.now.forEach((layout) => this.add(layout));
    this.showButtons();
    return [this.comparison.frame, this.place, restingSeeders(this.data)].filter(Boolean);
  }

  /** The layouts on the page. */
  made() {
    return this.benches.map((bench) => bench.layout);
  }

  add(layout) {
    const bench = new Bench(this.data, 'AB'[this.benches.length], layout, { told: (what) => this.told(what), all: () => this.benches });
    this.benches.push(bench);
    bench.outflow.want(this.wanted.task);
    this.place.append(bench.frame);
    this.showCount();
    bench.pace = this.benches[0].pace;
    bench.restart();
  }

  toggleSecond() {
    if (this.benches.length < 2) this.add(this.benches[0].layout);
    else this.benches.pop().close();
    this.showCount();
    this.told('layout');
    this.told('made');
  }

  // Brings back what was on the page.
  take(layouts) {
    this.taking = true;
    while (this.benches.length > layouts.length) this.benches.pop().close();
    layouts.forEach((layout, k) => {
      if (k >= this.benches.length) this.add(layout);
      else if (layout !== this.benches[k].layout) this.benches[k].change(layout);
    });
    this.taking = false;
    this.showCount();
    this.told('layout');
    this.keep();
  }

  /** Each layout as its seeder has it; that can be undone. */
  reset() {
    this.history.add(this.made().map(({ seeder }) => startOf(seeder)));
    this.take(this.history.now);
  }

  key(event) {
    const isText = event.target.closest?.('input[type="number"], input[type="text"]');
    if (isText || event.altKey || !(event.ctrlKey || event.metaKey) || !['z', 'y'].includes(event.key.toLowerCase())) return;
    event.preventDefault();
    const again = event.shiftKey || event.key.toLowerCase() === 'y';
    this.take(again ? this.history.redo() : this.history.undo());
  }

  showCount() {
    const two = this.benches.length === 2;
    document.documentElement.dataset.benches = this.benches.length;
    this.compareButton.textContent = two ? 'Remove layout B' : 'Compare layouts';
    this.comparison.frame.hidden = !two;
  }

  showButtons() {
    this.undoButton.disabled = !this.history.canUndo;
    this.redoButton.disabled = !this.history.canRedo;
    const fresh = this.made().map(({ seeder }) => startOf(seeder));
    this.resetButton.disabled = textOfLayouts(fresh) === textOfLayouts(this.made());
  }

  async send() {
    try {
      saveText(oneFile(document, await fragmentOf(this.made())), 'studio.html', 'text/html');
      this.said.textContent = ' The file holds these layouts and the simulator: any browser opens it, without a network.';
    } catch (error) {
      this.notice.textContent = sentence(`There is no file: ${error.message}`);
      this.notice.hidden = false;
    }
  }

  want(task) {
    for (const bench of this.benches) bench.outflow.want(task);
    this.tellKept(this.keptTask.write(JSON.stringify(task)));
  }

  // What was made is kept, one after the other; an address that names other layouts is given up.
  keep() {
    this.showButtons();
    this.said.textContent = '';
    if (isLink(location.hash)) history.replaceState(null, '', location.href.split('#')[0]);
    const layouts = this.made();
    this.writing = this.writing.then(async () => this.tellKept(this.kept.write(await fragmentOf(layouts)))).catch(() => this.tellKept(false));
  }

  tellKept(kept) {
    if (kept || this.toldNotKept) return;
    this.toldNotKept = true;
    this.notice.textContent = 'This browser keeps nothing for this page: after a reload what you make here is gone. Share a link or save the seeder file.';
    this.notice.hidden = false;
  }

  told(what) {
    if (what === 'layout') this.share.hide();
    if (what === 'made' && !this.taking && this.history.add(this.made())) this.keep();
    holdInStep(this.benches);
    const outcomes = this.benches.map((bench) => bench.outcome);
    if (outcomes.length === 2) this.comparison.show(...outcomes);
    const rates = this.benches.map((bench) => bench.outflow.rates);
    for (const bench of this.benches) bench.outflow.showBeside(rates);
  }
}

// Seeders that layouts bring join those of the page.
async function layoutsFrom(fragment, data) {
  const layouts = await layoutsOf(fragment, data);
  if (layouts) data.linked = [...new Set(layouts.map(({ seeder }) => seeder))].filter((seeder) => !data.seeders.includes(seeder));
  return layouts;
}

// What the page opens with: the link's layouts, else those that were made here before, else those that it was sent with, else the seeder
// that the program named.
async function opening(data, kept) {
  const { asked, opened } = data;
  const notice = asked && asked !== opened ? `${asked.title || asked.name} is not simulated in this page. ${sentence(asked.why_not)}` : '';
  try {
    const layouts = await layoutsFrom(location.hash, data);
    if (layouts) return { layouts, notice: '' };
  } catch (error) {
    return { layouts: [startOf(opened)], notice: `The link cannot be opened: ${error.message}` };
  }
  const left = await layoutsFrom(kept.read(), data).catch(() => null);  // of a page that can no longer read it
  if (left) return { layouts: left, notice, asLeft: true };
  const sent = await layoutsFrom(data.sent, data).catch(() => null);
  return sent ? { layouts: sent, notice: '' } : { layouts: [startOf(opened)], notice };
}

async function show() {
  startTheme();
  addEventListener('hashchange', () => location.reload());
  const text = document.getElementById('studio-data').textContent;
  const data = readStudioData(text);
  const kept = new Kept(() => localStorage, location.pathname, text), keptTask = new Kept(() => localStorage, `${location.pathname} wanted`, text);
  const studio = new Studio(data, { kept, keptTask }, await opening(data, kept));
  document.documentElement.dataset.kind = 'studio';
  document.getElementById('head').replaceChildren(...studio.head());
  document.getElementById('page').replaceChildren(...studio.page());
  const { name = 'vibrosow', version = '' } = data.program;
  document.getElementById('foot').replaceChildren(element('p', {}, `Written by ${name} ${version}. The simulator is in this file: it works without a network.`), paperStyle({ kicker: 'Studio', title }, data.program));
  document.documentElement.dataset.ready = 'true';
}

show().catch((error) => {
  document.getElementById('page').replaceChildren(element('p', { class: 'doubt' }, `This page cannot show what is in it: ${error.message}.`));
  throw error;
});

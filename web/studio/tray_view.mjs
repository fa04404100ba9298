// The tray while it sows: the replay's drawing of the simulation's last frame, and over it dimensions and the handles of the holes.
import { choice, element } from '../report/dom.mjs';
import { clock } from '../report/format.mjs';
import { labBox, toLab } from '../report/geometry.mjs';
import { legendParts } from '../report/legend.mjs';
import { PlaneView } from '../report/plane_view.mjs';
import { Stage } from '../report/stage.mjs';
import { inks, onTheme, theme } from '../report/theme.mjs';
import { Handles } from './handles.mjs';
import { reachOf } from './layout.mjs';
import { liveColourings } from './live_colouring.mjs';
import { LiveRecording, restPose, swings } from './live_recording.mjs';
import { Measures } from './measures.mjs';

const below = 0.085;   // of the picture's width is shown under the tray
const strip = 58;      // px below the picture, where the handles and the ruler are
const tallest = 0.37;  // of the window, so that picture and controls are on it together
const shortest = 150;  // px
const empty = 'The tray';

export class TrayView {
  constructor(acts) {
    this.way = liveColourings[0];
    this.still = false;
    this.handles = new Handles(acts);
    this.canvas = element('canvas', { class: 'tray-canvas', role: 'img', 'aria-label': empty });
    this.measures = new Measures();
    this.legend = element('p', { class: 'legend' });
    this.place = element('div', { class: 'stage live' }, this.canvas, this.measures.frame, this.handles.frame);
    const still = element('input', { type: 'checkbox', onchange: () => { this.still = still.checked; this.showAll(); } });
    this.choices = [
      choice('Colour', liveColourings.map((way) => ({ value: way, text: way.text })), this.way, (way) => this.colourBy(way)),
      element('label', { class: 'switch' }, still, element('span', {}, 'Hold the tray still')),
    ];
    this.stage = new Stage(this.canvas, (width) => Math.min(this.view?.height(width) ?? shortest, Math.max(shortest, tallest * innerHeight)), () => this.showAll());
    this.leaveTheme = onTheme(() => this.repaint());
  }

  /** Takes another prepared scene. */
  open(prepared, scene, motion) {
    const vessels = prepared.vessels;
    this.recording = new LiveRecording(vessels);
    this.tray = vessels.find((vessel) => vessel.name === 'tray') ?? vessels[0];
    const view = new PlaneView({ vessels, lots: prepared.lots }, this.recording, labBox(vessels, swings(vessels, scene)), restPose(this.tray), below);
    Object.assign(this, { prepared, motion, view, scene, frame: null });
    this.colouring = this.way.make(prepared, motion);
    this.handles.frame.hidden = false;
    this.showLegend();
    this.stage.fit();
  }

  /** Shows nothing: neither seeds nor handles on a tray that is not there. */
  clear() {
    if (!this.prepared) return;
    Object.assign(this, { prepared: null, view: null, frame: null, colouring: null });
    this.handles.frame.hidden = true;
    this.measures.clear();
    this.legend.replaceChildren();
    this.stage.fit();
    for (const name of ['counts', 'time']) delete this.canvas.dataset[name];
    this.canvas.setAttribute('aria-label', empty);
  }

  colourBy(way) {
    this.way = way;
    if (!this.prepared) return;
    this.colouring = way.make(this.prepared, this.motion);
    this.repaint();
  }

  showLegend() {
    this.legend.replaceChildren(...legendParts(this.colouring.legend, this.colouring.colours(theme())),
      element('span', { class: 'legend-note' }, 'Numbers: seeds so far'));
  }

  repaint() {
    if (!this.colouring) return;
    this.showLegend();
    this.paint();
  }

  /** The frame is painted when the screen is next drawn, so that none is painted for nobody. */
  show(frame) {
    if (frame === this.frame) return;
    this.frame = frame;
    if (this.due) return;
    this.due = requestAnimationFrame(() => {
      this.due = 0;
      this.paint();
    });
  }

  paint() {
    const { frame, stage, view } = this;
    if (!frame || !stage?.width) return;
    const counts = new Map(frame.counted.map((count, k) => [k + 1, count]));
    view.draw(stage, {
      frame: this.recording.take(frame), index: 0, time: frame.time_s, bins: this.colouring.of(frame), counts, still: this.still,
      colours: this.colouring.colours(theme()), ink: inks(),
    });
    this.canvas.dataset.counts = JSON.stringify(frame.counted);
    this.canvas.dataset.time = frame.time_s;
    this.canvas.setAttribute('aria-label', this.said(counts));
  }

  said(counts) {
    const words = [...counts].map(([hole, count]) => `hole ${hole}: ${count}`).join(', ');
    return `${this.frame.x.length} seeds at ${clock(this.frame.time_s)}. Seeds so far, ${words || 'no holes'}.`;
  }

  /** Brings the handles to the layout's holes, and the dimensions to its tray and motion. */
  showHoles(layout) {
    this.layout = layout;
    const { view, stage, tray } = this;
    if (!view || !stage.width || !layout) return;
    view.place(stage.width, stage.height);
    const pose = restPose(tray);
    this.handles.show(layout.holes, layout.holes.map((_, k) => reachOf(layout, k)), {
      placeOf: (mm) => view.project(...toLab(pose, mm, 0), false), scale: view.scale, length: layout.seeder.scene.tray.length_m * 1000, height: stage.height + strip,
    });
    this.measures.show({
      tray, pose, height: stage.height, strip, motion: layout.motion, trayMotion: layout.motion ? { kind: 'harmonic', ...layout.motion } : this.scene.tray.motion,
      place: { scale: view.scale, of: (x, y) => view.project(x, y, false) }, still: this.still,
    });
  }

  close() {
    this.leaveTheme();
    this.stage.leave();
    cancelAnimationFrame(this.due);
  }

  showAll() {
    this.paint();
    this.showHoles(this.layout);
  }
}

// The replay of a run in space: balls, walls and force chains as a painter paints them, with WebGL2 or without, and over them the counts at the holes
// and a scale bar.
import { Balls } from './balls.mjs';
import { Camera } from './camera.mjs';
import { meanRadius } from './chains.mjs';
import { niceAbove, number } from './format.mjs';
import { composed, inverse, placed } from './geometry.mjs';
import { GlPainter } from './gl_painter.mjs';
import { drawHoleLabels } from './hole_labels.mjs';
import { SpritePainter } from './sprite_painter.mjs';
import { onPaper } from './theme.mjs';
import { holesOf, wallsOf } from './walls.mjs';

const below = 0.1;      // of the width is shown under the tray, where seeds fall
const ofScale = 1 / 8;  // of the width, at least, is the scale bar long
const shortest = 300;   // px
const tallest = 0.72;   // of the window
const nothingCut = [0, 0, 0, 1];
const within = 3;       // px beside a ball that still choose it

const nowhere = { x: 0, y: 0, z: 0, angle: 0 };

export class SpaceView {
  /** `rest`: the tray's mean pose. `under`: the canvas below that of the labels. */
  constructor(data, recording, box, rest, under) {
    Object.assign(this, { rest, under });
    this.tray = Math.max(0, recording.vessels.indexOf('tray'));
    const tray = data.vessels.find((vessel) => vessel.name === 'tray') ?? data.vessels[0];
    this.holes = holesOf(tray);
    this.parts = data.vessels.map((vessel) => ({
      place: recording.vessels.indexOf(vessel.name), walls: wallsOf(vessel, data.faces?.[vessel.name]),
      rims: vessel === tray ? this.holes.flatMap(({ rim }) => rim.map((at, k) => [at, rim[(k + 1) % rim.length]])) : [],
    }));
    this.radius = meanRadius(recording);
    this.leastChain = 1;  // of the mean force: through the whole depth all contacts would hide each other
    const holes = this.holes.map(({ at, radius }) => ({ at: placed(rest, at), radius }));
    this.camera = new Camera({ ...box, low: box.low - below * (box.right - box.left) }, holes);
    this.balls = new Balls(recording, data.lots);
    this.cut = nothingCut;
    this.painter = GlPainter.on(under, this.balls, this.parts);
    if (!this.painter) this.withoutGl();
  }

  /** Paints without WebGL from now on: where there is none, or a browser took it back, as it does from the oldest of many replays. */
  withoutGl() {
    this.under.hidden = true;
    this.painter = new SpritePainter(this.balls, this.parts);
  }

  height(width) {
    return Math.min(Math.max(shortest, this.camera.heightOf(width)), Math.max(shortest, tallest * innerHeight));
  }

  /** Leaves out what lies before a plane, `part` of the way through from the "front", the "left" or the "top". */
  cutFrom(side, part) {
    const [axis, way] = { front: [2, -1], left: [0, -1], top: [1, 1] }[side];
    const { middle, half } = this.camera;
    const at = middle[axis] + way * half[axis] * (1 - 2 * part);
    this.cut = part > 0 ? [...[0, 1, 2].map((one) => (one === axis ? way : 0)), way * at] : nothingCut;
  }

  /** The place in its frame's list of the seed that is drawn nearest at a place of the picture, px; null where there is none. */
  seedAt(x, y) {
    const { balls: { count, place, grain }, camera, cut } = this;
    let best = null, nearest = -Infinity;
    for (let k = 0; k < count; ++k) {
      const at = placed(this.motion, place.subarray(4 * k, 4 * k + 3));
      if (cut[0] * at[0] + cut[1] * at[1] + cut[2] * at[2] > cut[3]) continue;
      const [px, py, toward] = camera.project(...at);
      const aside = Math.hypot(px - x, py - y) / camera.scale, radius = place[4 * k + 3];
      if (aside > radius + within / camera.scale) continue;
      const front = toward + Math.sqrt(Math.max(0, radius ** 2 - aside ** 2));
      if (front > nearest) [best, nearest] = [grain[k], front];
    }
    return best;
  }

  draw(stage, shown) {
    const { camera } = this;
    const { context, width, height } = stage;
    context.clearRect(0, 0, width, height);
    camera.place(width, height);
    // With the tray held still: by way of its own frame to where it rests.
    const motion = this.motion = shown.still ? composed(this.rest, inverse(shown.poseOf(this.tray))) : nowhere;
    const poses = this.parts.map(({ place }) => (place < 0 ? null : composed(motion, shown.poseOf(place))));
    this.painter.draw(stage, { ...shown, camera, motion, poses, cut: this.cut, radius: this.radius, least: this.leastChain });
    if (onPaper() && !this.under.hidden) context.drawImage(this.under, 0, 0, width, height);  // what WebGL paints is not printed
    this.drawChosen(context, shown);
    this.drawCounts(context, shown);
    this.drawScale(context, shown.ink, height);
  }

  // A ring about each ball of the chosen seed, also through others.
  drawChosen(context, { frame, chosen, ink }) {
    const { balls: { count, place, grain }, camera } = this;
    if (chosen === null) return;
    context.lineWidth = 2.5;
    context.strokeStyle = ink.ink;
    for (let k = 0; k < count; ++k) {
      if (frame.ids[grain[k]] !== chosen) continue;
      const [x, y] = camera.project(...placed(this.motion, place.subarray(4 * k, 4 * k + 3)));
      context.beginPath();
      context.arc(x, y, place[4 * k + 3] * camera.scale + 2, 0, 2 * Math.PI);
      context.stroke();
    }
  }

  // In every view, below the hole on the screen.
  drawCounts(context, { counts, ink }) {
    const { camera } = this;
    const labels = this.holes.map(({ number: hole, rim }) => {
      const places = rim.map((at) => camera.project(...placed(this.rest, at)));
      const middle = places.reduce((sum, [x]) => sum + x / places.length, 0);
      return { x: middle, y: Math.max(...places.map(([, y]) => y)), text: String(counts.get(hole) ?? 0) };
    });
    drawHoleLabels(context, labels, { ink: ink.ink, halo: ink.halo }, ink.font);
  }

  drawScale(context, ink, height) {
    const { camera: { scale, width } } = this;
    const length = niceAbove((ofScale * width) / scale);
    const [left, low] = [16, height - 14];
    context.font = ink.font;
    const text = `${number(length)} mm`;
    context.fillStyle = ink.halo;
    context.beginPath();
    context.roundRect(left - 8, low - 24, Math.max(length * scale, context.measureText(text).width) + 16, 32, 5);
    context.fill();
    context.strokeStyle = context.fillStyle = ink.ink;
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(left, low - 4);
    context.lineTo(left, low);
    context.lineTo(left + length * scale, low);
    context.lineTo(left + length * scale, low - 4);
    context.stroke();
    context.textAlign = 'left';
    context.textBaseline = 'bottom';
    context.fillText(text, left, low - 4);
  }
}

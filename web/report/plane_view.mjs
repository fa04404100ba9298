// The replay of a run in the plane: discs and clumps to scale, vessels' outlines, counts under the holes.
import { drawChains, meanRadius } from './chains.mjs';
import { floorAt, toLab, toOwn } from './geometry.mjs';
import { drawHoleLabels } from './hole_labels.mjs';

const usualBelow = 0.13;   // of the width is shown under the tray, where seeds fall
const countsAt = 0.039;    // of the width under the holes
const margin = 14;         // px
const drawnRadius = 0.95;  // of the real one, so that seeds that touch are told apart
const faded = 0.45;        // of seeds under force chains

export class PlaneView {
  constructor(data, recording, box, rest, below = usualBelow) {
    this.data = data;
    this.recording = recording;
    this.rest = rest;  // the tray's mean pose
    const width = box.right - box.left;
    const above = 0.02 * width;
    this.box = { left: box.left - above, right: box.right + above, low: box.low - below * width, high: box.high + above };
    this.tray = Math.max(0, recording.vessels.indexOf('tray'));
    this.shapes = data.lots.map(shapeOf);
  }

  height(width) {
    const scale = (width - 2 * margin) / (this.box.right - this.box.left);
    return Math.min(scale * (this.box.high - this.box.low) + 30, Math.max(300, 0.72 * innerHeight));
  }

  place(width, height) {
    const scale = Math.min((width - 2 * margin) / (this.box.right - this.box.left), (height - 24) / (this.box.high - this.box.low));
    this.scale = scale;
    this.left = (width - scale * (this.box.right - this.box.left)) / 2 - scale * this.box.left;
    this.top = 8 + scale * this.box.high;
  }

  // Lab to screen; with the tray held still, by way of its own frame to where it rests.
  project(x, y, still, pose) {
    const [sx, sy] = still ? toLab(this.rest, ...toOwn(pose, x, y)) : [x, y];
    return [this.left + this.scale * sx, this.top - this.scale * sy];
  }

  draw(stage, shown) {
    const { context, width, height } = stage;
    context.clearRect(0, 0, width, height);
    this.place(width, height);
    this.drawGrains(context, shown);
    if (shown.chains) this.drawChains(context, shown);
    this.drawVessels(context, shown);
    this.drawCounts(context, shown);
  }

  drawGrains(context, { frame, index, bins, colours, still, chains }) {
    const { recording } = this;
    const pose = recording.pose(index, this.tray);
    const [mm, mmOfY, turn] = [recording.units[0] * 1000, recording.units[1] * 1000, recording.units[2]];
    const turned = still ? this.rest.angle - pose.angle : 0;
    const paths = colours.map(() => new Path2D());
    for (let k = 0; k < frame.ids.length; ++k) {
      const id = frame.ids[k];
      const [x, y] = this.project(frame.values[0][k] * mm, frame.values[1][k] * mmOfY, still, pose);
      const radius = recording.radii[id] * 1000 * this.scale;
      const path = paths[bins[k]];
      const shape = this.shapes[recording.lots[id]];
      if (!shape) addDisc(path, x, y, radius);
      else addClump(path, shape, x, y, radius, (recording.fields[2] === 'angle' ? frame.values[2][k] * turn : 0) + turned);
    }
    context.save();
    context.globalAlpha = chains ? faded : 1;
    paths.forEach((path, k) => {
      context.fillStyle = colours[k];
      context.fill(path);
    });
    context.restore();
  }

  drawChains(context, { chains, index, ink, still }) {
    const pose = this.recording.pose(index, this.tray);
    const radius = meanRadius(this.recording) * this.scale;
    drawChains(context, chains, { colour: ink.chain, radius, project: (x, y) => this.project(x, y, still, pose) });
  }

  drawVessels(context, { index, time, ink, still }) {
    const trayPose = this.recording.pose(index, this.tray);
    context.strokeStyle = ink.wall;
    context.lineWidth = 2;
    context.lineJoin = 'round';
    context.lineCap = 'round';
    for (const vessel of this.data.vessels) {
      const place = this.recording.vessels.indexOf(vessel.name);
      if (place < 0) continue;
      const pose = this.recording.pose(index, place);
      for (const line of vessel.lines ?? []) {
        if (typeof line.opens_at_s === 'number' && time >= line.opens_at_s) continue;
        context.beginPath();
        for (const [x, y] of line.points_mm) context.lineTo(...this.project(...toLab(pose, x, y), still, trayPose));
        context.stroke();
      }
    }
  }

  drawCounts(context, { counts, ink }) {
    const tray = this.data.vessels.find((vessel) => vessel.name === 'tray') ?? this.data.vessels[0];
    const holes = tray?.holes ?? [];
    const labels = holes.map((hole) => {
      const [x, y] = this.project(...toLab(this.rest, hole.x_mm, floorAt(tray, hole)), false);
      return { x, y: y + countsAt * this.scale * (this.box.right - this.box.left), text: String(counts.get(hole.number) ?? 0) };
    });
    drawHoleLabels(context, labels, { ink: ink.ink, halo: ink.halo }, ink.font);
  }
}

// Discs of a clump over the circle that holds it, or null of a single disc.
function shapeOf(lot) {
  if (!lot.discs?.length) return null;
  const reach = Math.max(...lot.discs.map((disc) => Math.hypot(disc.x_mm, disc.y_mm) + disc.radius_mm));
  return lot.discs.map((disc) => ({ x: disc.x_mm / reach, y: disc.y_mm / reach, radius: disc.radius_mm / reach }));
}

function addDisc(path, x, y, radius) {
  const drawn = Math.max(0.6, radius * drawnRadius);
  path.moveTo(x + drawn, y);
  path.arc(x, y, drawn, 0, 2 * Math.PI);
}

function addClump(path, shape, x, y, radius, angle) {
  const cos = Math.cos(angle) * radius, sin = Math.sin(angle) * radius;
  const gap = radius * (1 - drawnRadius);
  for (const disc of shape) {
    const drawn = Math.max(0.6, disc.radius * radius - gap);
    const cx = x + cos * disc.x - sin * disc.y, cy = y - (sin * disc.x + cos * disc.y);
    path.moveTo(cx + drawn, cy);
    path.arc(cx, cy, drawn, 0, 2 * Math.PI);
  }
}

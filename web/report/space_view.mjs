// The replay of a run in space: balls, shaded, from the side, from above, or turned as one likes; without perspective.
import { drawChains, meanRadius } from './chains.mjs';
import { floorAt, toLab, toOwn } from './geometry.mjs';
import { mix } from './colours.mjs';
import { drawHoleLabels } from './hole_labels.mjs';

const margin = 16;  // px
const shades = 6;   // of a colour, from the back to the front
const spriteSize = 48;
const depthSteps = 4096;
const faded = 0.3;  // of seeds before force chains

export const cameras = {
  side: { yaw: 0, pitch: 0 },
  above: { yaw: 0, pitch: Math.PI / 2 },
  turnable: { yaw: -0.4, pitch: 0.4 },
};

export class SpaceView {
  constructor(data, recording, box, rest) {
    this.data = data;
    this.recording = recording;
    this.rest = rest;
    const width = box.right - box.left;
    this.box = { ...box, low: box.low - 0.1 * width };
    this.middle = [(box.left + box.right) / 2, (this.box.low + box.high) / 2, (box.front + box.back) / 2];
    this.tray = Math.max(0, recording.vessels.indexOf('tray'));
    this.shapes = data.lots.map(ballsOf);
    this.camera = { ...cameras.side };
    this.fixed = true;
    this.leastChain = 1;  // of the mean force: through the whole depth all contacts would hide each other
    this.sprites = new Map();
  }

  /** `name` of cameras; "turnable" keeps how it was turned last. */
  look(name) {
    if (this.fixed) this.turned = this.turned ?? { ...cameras.turnable };
    this.fixed = name !== 'turnable';
    this.camera = this.fixed ? { ...cameras[name] } : this.turned;
    this.name = name;
  }

  turn(yaw, pitch) {
    this.camera.yaw += yaw;
    this.camera.pitch = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, this.camera.pitch + pitch));
  }

  // Half the width and height, mm, that the view needs; of a turnable one, turned any way about its upright and looked at
  // a little from above.
  reach() {
    const [w, h, d] = [this.box.right - this.box.left, this.box.high - this.box.low, this.box.back - this.box.front].map((length) => length / 2);
    if (this.fixed) return this.camera.pitch > 1 ? [w, d] : [w, h];
    return [Math.hypot(w, d), 0.9 * h + 0.22 * Math.hypot(w, d)];
  }

  height(width) {
    const [half, halfHeight] = this.reach();
    const wanted = ((width - 2 * margin) / half) * halfHeight + 2 * margin + 24;
    return Math.min(wanted, Math.max(300, 0.72 * innerHeight));
  }

  place(width, height) {
    const [half, halfHeight] = this.reach();
    this.scale = Math.min((width - 2 * margin) / (2 * half), (height - 2 * margin) / (2 * halfHeight));
    this.centre = [width / 2, height / 2];
    const { yaw, pitch } = this.camera;
    this.turning = { cosYaw: Math.cos(yaw), sinYaw: Math.sin(yaw), cosPitch: Math.cos(pitch), sinPitch: Math.sin(pitch) };
  }

  // Lab (mm) to the screen; the third is how near it is, mm.
  project(x, y, z) {
    const { cosYaw, sinYaw, cosPitch, sinPitch } = this.turning;
    const dx = x - this.middle[0], dy = y - this.middle[1], dz = z - this.middle[2];
    const across = cosYaw * dx + sinYaw * dz, away = cosYaw * dz - sinYaw * dx;
    return [this.centre[0] + this.scale * across, this.centre[1] - this.scale * (cosPitch * dy + sinPitch * away), sinPitch * dy - cosPitch * away];
  }

  // With the tray held still: by way of its own frame to where it rests.
  inView(x, y, z, { still }, pose) {
    if (!still) return this.project(x, y, z);
    const [sx, sy] = toLab(this.rest, ...toOwn(pose, x, y));
    return this.project(sx, sy, z - (pose.z - this.rest.z) * 1000);
  }

  draw(stage, shown) {
    const { context, width, height } = stage;
    context.clearRect(0, 0, width, height);
    this.place(width, height);
    const faint = { ...shown, alpha: 0.9 };
    this.drawVessels(context, faint);
    this.drawHoles(context, faint);
    context.globalAlpha = shown.chains ? faded : 1;
    this.drawGrains(context, shown);
    context.globalAlpha = 1;
    if (shown.chains) this.drawChains(context, shown);
    this.drawVessels(context, { ...shown, alpha: 0.35 });
    if (this.name === 'above') this.drawHoles(context, shown);
    if (this.name === 'side') this.drawCounts(context, shown);
  }

  drawGrains(context, shown) {
    const balls = this.balls(shown);
    const order = nearestLast(balls.near, balls.count);
    const [low, high] = nearness(balls.near, balls.count);
    const sheet = this.sheet(shown.colours, shown.ink.depth);
    for (let i = 0; i < balls.count; ++i) {
      const k = order[i];
      const shade = Math.min(shades - 1, Math.floor(((balls.near[k] - low) / (high - low || 1)) * shades));
      const radius = balls.radius[k];
      context.drawImage(sheet, spriteSize * balls.bin[k], spriteSize * shade, spriteSize, spriteSize, balls.x[k] - radius, balls.y[k] - radius, 2 * radius, 2 * radius);
    }
  }

  drawChains(context, shown) {
    const pose = this.recording.pose(shown.index, this.tray);
    const radius = meanRadius(this.recording) * this.scale;
    drawChains(context, shown.chains, { colour: shown.ink.chain, radius, least: this.leastChain, project: (x, y, z) => this.inView(x, y, z, shown, pose) });
  }

  // All balls of all grains on the screen.
  balls(shown) {
    const { frame, index, bins } = shown;
    const { recording } = this;
    const pose = recording.pose(index, this.tray);
    const most = Math.max(1, ...this.shapes.map((shape) => shape?.length ?? 1)) * frame.ids.length;
    const balls = { count: 0, x: new Float32Array(most), y: new Float32Array(most), near: new Float32Array(most), radius: new Float32Array(most), bin: new Uint8Array(most) };
    const mm = recording.units.map((unit) => unit * 1000);
    const turned = recording.fields.length === 7;
    const add = (x, y, z, radius, bin) => {
      const k = balls.count++;
      [balls.x[k], balls.y[k], balls.near[k]] = this.inView(x, y, z, shown, pose);
      balls.radius[k] = Math.max(0.7, radius * this.scale);
      balls.bin[k] = bin;
    };
    for (let k = 0; k < frame.ids.length; ++k) {
      const id = frame.ids[k];
      const [x, y, z] = [frame.values[0][k] * mm[0], frame.values[1][k] * mm[1], frame.values[2][k] * mm[2]];
      const radius = recording.radii[id] * 1000;
      const shape = this.shapes[recording.lots[id]];
      if (!shape) {
        add(x, y, z, radius, bins[k]);
        continue;
      }
      const rotate = turned ? rotation([3, 4, 5, 6].map((field) => frame.values[field][k] * recording.units[field])) : (a, b, c) => [a, b, c];
      for (const ball of shape) {
        const [a, b, c] = rotate(ball.x * radius, ball.y * radius, ball.z * radius);
        add(x + a, y + b, z + c, ball.radius * radius, bins[k]);
      }
    }
    return balls;
  }

  // One picture of all colours, side by side, and their shades, below each other.
  sheet(colours, depth) {
    const key = colours.join() + depth;
    if (!this.sprites.has(key)) {
      this.sprites.clear();
      this.sprites.set(key, spriteSheet(colours, depth));
    }
    return this.sprites.get(key);
  }

  drawVessels(context, shown) {
    const { index, time, ink, alpha } = shown;
    const trayPose = this.recording.pose(index, this.tray);
    context.save();
    context.globalAlpha = alpha;
    context.strokeStyle = ink.wall;
    context.lineWidth = 1.5;
    context.lineJoin = 'round';
    context.beginPath();
    for (const vessel of this.data.vessels) {
      const place = this.recording.vessels.indexOf(vessel.name);
      if (place < 0) continue;
      const pose = this.recording.pose(index, place);
      const depth = vessel.depth_mm ?? 0;
      for (const line of vessel.lines ?? []) {
        if (typeof line.opens_at_s === 'number' && time >= line.opens_at_s) continue;
        const points = [0, depth].map((z) => line.points_mm.map(([x, y]) => this.inView(...toLab(pose, x, y), z + pose.z * 1000, shown, trayPose)));
        for (const side of points) side.forEach(([x, y], k) => (k ? context.lineTo(x, y) : context.moveTo(x, y)));
        points[0].forEach(([x, y], k) => {
          context.moveTo(x, y);
          context.lineTo(points[1][k][0], points[1][k][1]);
        });
      }
    }
    context.stroke();
    context.restore();
  }

  drawHoles(context, shown) {
    const tray = this.trayShape();
    const pose = this.recording.pose(shown.index, this.tray);
    context.strokeStyle = shown.ink.accent;
    context.lineWidth = 1.5;
    for (const hole of tray?.holes ?? []) {
      context.beginPath();
      for (const [x, z] of rim(hole)) {
        const [sx, sy] = this.inView(...toLab(pose, x, floorAt(tray, hole)), z + pose.z * 1000, shown, pose);
        context.lineTo(sx, sy);
      }
      context.closePath();
      context.stroke();
    }
  }

  drawCounts(context, { counts, ink }) {
    const tray = this.trayShape();
    const labels = [...(tray?.holes ?? [])].sort((a, b) => b.z_mm - a.z_mm).map((hole) => {
      const [x, y] = this.project(...toLab(this.rest, hole.x_mm, floorAt(tray, hole)), 0);
      return { x, y: y + 0.03 * this.scale * (this.box.right - this.box.left), text: String(counts.get(hole.number) ?? 0) };
    });
    drawHoleLabels(context, labels, { ink: ink.ink, halo: ink.halo }, ink.font);
  }

  trayShape() {
    return this.data.vessels.find((vessel) => vessel.name === 'tray') ?? this.data.vessels[0];
  }
}

function ballsOf(lot) {
  if (!lot.discs?.length) return null;
  const reach = Math.max(...lot.discs.map((ball) => Math.hypot(ball.x_mm, ball.y_mm, ball.z_mm ?? 0) + ball.radius_mm));
  return lot.discs.map((ball) => ({ x: ball.x_mm / reach, y: ball.y_mm / reach, z: (ball.z_mm ?? 0) / reach, radius: ball.radius_mm / reach }));
}

// Turns by a quaternion that need not be of length 1.
function rotation([w, x, y, z]) {
  const s = 2 / (w * w + x * x + y * y + z * z || 1);
  return (a, b, c) => [
    a * (1 - s * (y * y + z * z)) + b * s * (x * y - w * z) + c * s * (x * z + w * y),
    a * s * (x * y + w * z) + b * (1 - s * (x * x + z * z)) + c * s * (y * z - w * x),
    a * s * (x * z - w * y) + b * s * (y * z + w * x) + c * (1 - s * (x * x + y * y)),
  ];
}

function nearness(near, count) {
  let low = Infinity, high = -Infinity;
  for (let k = 0; k < count; ++k) {
    low = Math.min(low, near[k]);
    high = Math.max(high, near[k]);
  }
  return [low, high];
}

// The order to paint in, by counting: far ones first.
function nearestLast(near, count) {
  const [low, high] = nearness(near, count);
  const stepOf = (k) => Math.min(depthSteps - 1, Math.floor(((near[k] - low) / (high - low || 1)) * depthSteps));
  const begins = new Uint32Array(depthSteps + 1);
  for (let k = 0; k < count; ++k) ++begins[stepOf(k) + 1];
  for (let step = 0; step < depthSteps; ++step) begins[step + 1] += begins[step];
  const order = new Uint32Array(count);
  for (let k = 0; k < count; ++k) order[begins[stepOf(k)]++] = k;
  return order;
}

function rim(hole) {
  if (!hole.round) return [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([a, b]) => [hole.x_mm + a * hole.half_x_mm, hole.z_mm + b * hole.half_z_mm]);
  return Array.from({ length: 32 }, (_, k) => (2 * Math.PI * k) / 32)
    .map((angle) => [hole.x_mm + hole.half_x_mm * Math.cos(angle), hole.z_mm + hole.half_z_mm * Math.sin(angle)]);
}

function spriteSheet(colours, depth) {
  const sheet = document.createElement('canvas');
  sheet.width = spriteSize * colours.length;
  sheet.height = spriteSize * shades;
  const context = sheet.getContext('2d');
  colours.forEach((colour, bin) => {
    for (let shade = 0; shade < shades; ++shade) {
      const own = mix(depth, colour, 0.5 + (0.5 * (shade + 1)) / shades);
      const [x, y, r] = [spriteSize * (bin + 0.5), spriteSize * (shade + 0.5), spriteSize / 2 - 1];
      const light = context.createRadialGradient(x - 0.35 * r, y - 0.4 * r, 0.05 * r, x, y, r);
      light.addColorStop(0, mix(own, '#ffffff', 0.45));
      light.addColorStop(0.45, own);
      light.addColorStop(1, mix(own, '#000000', 0.32));
      context.fillStyle = light;
      context.beginPath();
      context.arc(x, y, r, 0, 2 * Math.PI);
      context.fill();
    }
  });
  return sheet;
}

// Paints a run in space on a canvas without WebGL: each ball a shaded picture of its colour, from the back to the front, and the edges of walls.
import { drawChains } from './chains.mjs';
import { mix } from './colours.mjs';
import { placed } from './geometry.mjs';

const shades = 6;   // of a colour, from the back to the front
const spriteSize = 48;
const depthSteps = 4096;
const faded = 0.3;  // of seeds before force chains
const leastRadius = 0.7;  // px

export class SpritePainter {
  /** `parts` as GlPainter has them. */
  constructor(balls, parts) {
    this.balls = balls;
    this.parts = parts;
    this.sprites = new Map();
    this.near = new Float32Array(balls.most);
    this.at = new Float32Array(2 * balls.most);
    this.which = new Uint32Array(balls.most);
  }

  draw({ context }, scene) {
    if (this.frame !== scene.frame) this.balls.fill(scene.frame);
    this.frame = scene.frame;
    this.drawEdges(context, scene, 0.9);
    context.globalAlpha = scene.chains ? faded : 1;
    this.drawBalls(context, scene);
    context.globalAlpha = 1;
    const { camera, chains, ink, least, motion, radius } = scene;
    if (chains) drawChains(context, chains, { colour: ink.chain, radius: radius * camera.scale, least, project: (...at) => camera.project(...placed(motion, at)) });
    this.drawEdges(context, scene, 0.35);
  }

  // Balls on the screen: how many are not cut away; which, where and how near is kept.
  project({ camera, motion, cut }) {
    const { balls: { count, place }, near, at, which } = this;
    let seen = 0;
    for (let k = 0; k < count; ++k) {
      const [x, y, z] = placed(motion, [place[4 * k], place[4 * k + 1], place[4 * k + 2]]);
      if (cut[0] * x + cut[1] * y + cut[2] * z > cut[3]) continue;
      [at[2 * seen], at[2 * seen + 1], near[seen]] = camera.project(x, y, z);
      which[seen++] = k;
    }
    return seen;
  }

  drawBalls(context, scene) {
    const { balls, near, at, which } = this;
    const seen = this.project(scene);
    const [low, high] = nearness(near, seen);
    const sheet = this.sheet(scene.colours, scene.ink.depth);
    for (const k of nearestLast(near, seen)) {
      const shade = Math.min(shades - 1, Math.floor(((near[k] - low) / (high - low || 1)) * shades));
      const ball = which[k];
      const radius = Math.max(leastRadius, balls.place[4 * ball + 3] * scene.camera.scale);
      const bin = scene.bins[balls.grain[ball]];
      context.drawImage(sheet, spriteSize * bin, spriteSize * shade, spriteSize, spriteSize, at[2 * k] - radius, at[2 * k + 1] - radius, 2 * radius, 2 * radius);
    }
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

  drawEdges(context, { camera, poses, time, ink }, alpha) {
    context.save();
    context.globalAlpha = alpha;
    context.lineWidth = 1.5;
    this.parts.forEach(({ walls, rims }, part) => {
      if (!poses[part]) return;
      const lines = (pairs, colour) => {
        context.strokeStyle = colour;
        context.beginPath();
        for (const pair of pairs) {
          const [[x, y], [toX, toY]] = pair.map((at) => camera.project(...placed(poses[part], at)));
          context.moveTo(x, y);
          context.lineTo(toX, toY);
        }
        context.stroke();
      };
      lines(walls.edges.filter(({ opens }) => time < opens).map(({ from, to }) => [from, to]), ink.wall);
      lines(rims, ink.accent);
    });
    context.restore();
  }
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

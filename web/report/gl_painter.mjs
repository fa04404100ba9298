// Paints a run in space with WebGL2: all balls as one draw of instances, each lit and cut out of a square as exact as the screen; floors solid,
// walls of glass, edges, shadows of balls and edges, and force chains. Uploads balls where the frame or the colours are others, and nothing while the
// camera moves; draws the shadows anew where what is lit or the way the light comes is another.
import { Geometry, Mesh, Program, Renderer } from 'ogl';
import { chainLooks } from './chains.mjs';
import { channels } from './colours.mjs';
import { ballShaders, discShaders, lineShaders, wallShaders } from './gl_shaders.mjs';
import { seenByLamp, turnOf } from './lamp.mjs';
import { Shadow } from './shadow.mjs';

const edgeWidth = 1.25;   // px
const rimWidth = 2;
const thinnest = 0.7;     // px, of a chain's line
const darkSides = 0.55;   // of it
const pressed = 0.1;      // of a seed's mean radius that it may sink into a floor and not be seen from below
const faded = 0.7;        // of seeds before force chains, towards the paper
const edgeShade = 0.8;    // of how far a shadow fades, of an edge's width as the lamp sees it: narrower ones fall apart
const black = [0, 0, 0];
const quad = new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]);

// Of 0 to 1.
function unitColour(colour) {
  return channels(colour).map((value) => value / 255);
}

// As four bytes in the order of memory.
function packedColour(colour) {
  const [r, g, b] = channels(colour);
  return (0xff000000 | (b << 16) | (g << 8) | r) >>> 0;
}

const poseOf = ({ x, y, z, angle }) => [x * 1000, y * 1000, z * 1000, angle];

export class GlPainter {
  /** `parts`: of each vessel { walls, rims } (wallsOf; pairs of places). null where there is no WebGL2. */
  static on(canvas, balls, parts) {
    const looks = { alpha: false, depth: true, stencil: false, antialias: true, preserveDrawingBuffer: true };
    return canvas.getContext('webgl2', { ...looks, premultipliedAlpha: false, powerPreference: 'default' }) ? new GlPainter(canvas, balls, parts, looks) : null;
  }

  constructor(canvas, balls, parts, looks) {
    this.renderer = new Renderer({ canvas, webgl: 2, ...looks });
    canvas.removeAttribute('style');  // the page sets its size
    this.gl = this.renderer.gl;
    this.balls = balls;
    const names = ['turn', 'target', 'span', 'pixel', 'pose', 'cut', 'time', 'depths', 'depth', 'paper', 'fading', 'tint', 'glass', 'least', 'bias', 'rounded',
      'lampTurn', 'lampTarget', 'lampSpan', 'soft', 'shadow'];
    this.set = Object.fromEntries(names.map((name) => [name, { value: 0 }]));
    this.shadow = new Shadow(this.gl);
    this.ballMesh = this.mesh(ballShaders, this.ballGeometry());
    this.discMesh = this.mesh(discShaders, this.pointGeometry(), { mode: this.gl.POINTS });
    this.vessels = parts.map(({ walls, rims }) => {
      const edges = this.lineMesh(walls.edges.map(({ from, to, opens }) => [from, to, 0, 0.9, opens]));
      return {
        floors: this.wallMesh(walls, true), glass: this.wallMesh(walls, false), edges, shades: this.mesh(lineShaders, edges?.geometry),
        rims: this.lineMesh(rims.map(([from, to]) => [from, to, 0, 1, Infinity])),
      };
    });
    this.chains = { of: null, mesh: null };
  }

  mesh(shaders, geometry, { seeThrough = false, depthTest = true, mode } = {}) {
    if (!geometry) return null;
    const { gl } = this;
    this.programs = this.programs ?? new Map();
    const key = `${seeThrough} ${depthTest}`;
    const kept = this.programs.get(shaders) ?? this.programs.set(shaders, new Map()).get(shaders);
    if (!kept.has(key)) kept.set(key, new Program(gl, { ...shaders, uniforms: this.set, transparent: seeThrough, cullFace: null, depthTest, depthWrite: !seeThrough }));
    return new Mesh(gl, { geometry, program: kept.get(key), mode: mode ?? (geometry.attributes.index ? gl.TRIANGLES : gl.TRIANGLE_STRIP) });
  }

  ballGeometry() {
    const { gl, balls } = this;
    this.colour = new Uint32Array(balls.most);
    this.place = { size: 4, instanced: 1, data: balls.place, usage: gl.DYNAMIC_DRAW };
    this.tints = { size: 4, instanced: 1, data: new Uint8Array(this.colour.buffer), type: gl.UNSIGNED_BYTE, normalized: true, usage: gl.DYNAMIC_DRAW };
    return new Geometry(gl, { corner: { size: 2, data: quad }, ball: this.place, colour: this.tints });
  }

  // One point a ball, of the places that ballGeometry uploads.
  pointGeometry() {
    const { buffer, data } = this.place;
    return new Geometry(this.gl, { ball: { size: 4, data, buffer } });
  }

  wallMesh(walls, level) {
    const corners = walls.corners.filter((corner) => walls.level[corner] === level);
    if (corners.length === 0) return null;
    const numbers = (values) => new Float32Array(values.flat());
    return this.mesh(wallShaders, new Geometry(this.gl, {
      own: { size: 3, data: numbers(walls.points) }, normal: { size: 3, data: numbers(walls.normals) }, opens: { size: 1, data: numbers(walls.opens) },
      index: { data: new Uint32Array(corners) },
    }), { seeThrough: !level });
  }

  // `lines`: [from, to, width (mm), opacity, opens (s)].
  lineMesh(lines, depthTest = true) {
    if (lines.length === 0) return null;
    const column = (get) => new Float32Array(lines.flatMap(get));
    return this.mesh(lineShaders, new Geometry(this.gl, {
      corner: { size: 2, data: quad }, from: { size: 3, instanced: 1, data: column(([from]) => from) }, to: { size: 3, instanced: 1, data: column(([, to]) => to) },
      look: { size: 3, instanced: 1, data: column(([, , ...look]) => look) },
    }), { seeThrough: true, depthTest });
  }

  paint(mesh, values) {
    if (!mesh) return;
    this.setAll(values);
    mesh.draw();
  }

  /** `scene`: { camera, motion, poses (of the parts; null of a vessel that was not recorded), frame, bins, colours, ink, time, cut, chains, radius (mm), least }. */
  draw(stage, scene) {
    const { gl, renderer } = this;
    const { width, height } = stage.canvas;
    if (gl.canvas.width !== width || gl.canvas.height !== height) Object.assign(gl.canvas, { width, height });
    this.set.time.value = scene.time;
    this.set.cut.value = scene.cut;
    this.drawShadow(scene, this.upload(scene));
    renderer.setViewport(width, height);
    renderer.setDepthMask(true);
    const paper = unitColour(scene.ink.card);
    gl.clearColor(...paper, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    this.look(scene.camera, scene, paper);
    this.drawBalls(scene);
    this.drawWalls(scene, stage.ratio);
    if (scene.chains) this.paint(this.chainMesh(scene), { pose: poseOf(scene.motion), tint: unitColour(scene.ink.chain), least: thinnest * stage.ratio, rounded: darkSides });
  }

  ofEach({ poses }, act) {
    this.vessels.forEach((vessel, k) => { if (poses[k]) act(vessel, poseOf(poses[k])); });
  }

  drawBalls({ motion, chains }) {
    const { gl } = this;
    gl.enable(gl.SAMPLE_ALPHA_TO_COVERAGE);
    this.paint(this.ballMesh, { pose: poseOf(motion), fading: chains ? faded : 0 });
    gl.disable(gl.SAMPLE_ALPHA_TO_COVERAGE);
  }

  drawWalls(scene, ratio) {
    const [wall, floor, accent, clear] = ['wall', 'floor', 'accent', 'glass'].map((name) => unitColour(scene.ink[name]));
    this.ofEach(scene, ({ floors }, pose) => this.paint(floors, { pose, tint: floor, glass: 0, bias: pressed * scene.radius }));
    this.set.rounded.value = 0;
    this.ofEach(scene, ({ edges, rims }, pose) => {
      this.paint(edges, { pose, tint: wall, least: edgeWidth * ratio });
      this.paint(rims, { pose, tint: accent, least: rimWidth * ratio });
    });
    this.ofEach(scene, ({ glass }, pose) => this.paint(glass, { pose, tint: clear, glass: 1, bias: 0 }));
  }

  // Where its balls are others, `anew`, or the lamp, vessels or the cut are elsewhere.
  drawShadow(scene, anew) {
    const { camera: { yaw, pitch }, motion, poses, time, cut } = scene;
    const lit = [yaw, pitch, time, ...cut, ...[motion, ...poses].flatMap((pose) => (pose ? poseOf(pose) : []))].join();
    if (!anew && this.lit === lit) return;
    this.lit = lit;
    const seen = seenByLamp(scene.camera), pixel = this.shadow.pixelOf(seen);
    const least = (edgeShade * this.shadow.softOf(seen, scene.radius)) / pixel;
    this.setAll(this.shadow.uniforms(seen, scene.radius));
    this.setAll({ turn: turnOf(seen), target: seen.target, span: seen.span, pixel, rounded: 0 });
    this.shadow.fill(() => {
      this.paint(this.discMesh, { pose: poseOf(motion) });
      this.ofEach(scene, ({ shades }, pose) => this.paint(shades, { pose, tint: black, least }));
    });
  }

  setAll(values) {
    for (const [name, value] of Object.entries(values)) this.set[name].value = value;
  }

  look(camera, { ink }, paper) {
    const { toward, half } = camera;
    const { set } = this;
    set.turn.value = turnOf(camera);
    set.target.value = camera.target;
    set.span.value = [camera.width / 2 / camera.scale, camera.height / 2 / camera.scale, camera.depth];
    set.pixel.value = camera.width / camera.scale / this.gl.canvas.width;
    const middle = camera.middle.reduce((all, value, axis) => all + (value - camera.target[axis]) * toward[axis], 0);
    const deep = toward.reduce((all, value, axis) => all + Math.abs(value) * half[axis], 0);
    set.depths.value = [middle - deep, middle + deep, 0.7];
    set.depth.value = unitColour(ink.depth);
    set.paper.value = paper;
  }

  // Places where the frame is another, colours where its grains or their colours are; whether places are.
  upload({ frame, bins, colours }) {
    const { balls, ballMesh: { geometry } } = this;
    const moved = this.frame !== frame;
    if (moved) {
      balls.fill(frame);
      this.place.data = balls.place.subarray(0, 4 * balls.count);
      geometry.updateAttribute(this.place);
      geometry.setInstancedCount(balls.count);
      this.discMesh.geometry.setDrawRange(0, balls.count);
    }
    const palette = colours.join();
    if (this.ids !== frame.ids || this.bins !== bins || this.palette !== palette) {
      const packed = colours.map(packedColour);
      for (let k = 0; k < balls.count; ++k) this.colour[k] = packed[bins[balls.grain[k]]];
      this.tints.data = new Uint8Array(this.colour.buffer, 0, 4 * balls.count);
      this.tints.needsUpdate = true;
    }
    Object.assign(this, { frame, ids: frame.ids, bins, palette });
    return moved;
  }

  chainMesh({ chains, radius, least }) {
    if (this.chains.of !== chains) {
      this.chains.mesh?.geometry.remove();
      const looks = chainLooks(least);
      const lines = chains.ends.map((ends, k) => [ends.slice(0, 3), ends.slice(3), looks[chains.kind[k]]]).filter(([, , look]) => look);
      this.chains = { of: chains, mesh: this.lineMesh(lines.map(([from, to, look]) => [from, to, look.width * radius, look.opacity, Infinity]), false) };
    }
    return this.chains.mesh;
  }
}

// Paints a run in space with WebGL2: all balls as one draw of instances, each lit and cut out of a square as exact as the screen; floors solid,
// walls of glass, edges, and force chains. Uploads balls where the frame or the colours are others, and nothing while the camera moves.
import { Geometry, Mesh, Program, Renderer } from 'ogl';
import { chainLooks } from './chains.mjs';
import { channels } from './colours.mjs';

const edgeWidth = 1.25;   // px
const rimWidth = 2;
const thinnest = 0.7;     // px, of a chain's line
const darkSides = 0.55;   // of it
const leastRadius = 0.7;  // px, of a ball
const pressed = 0.1;      // of a seed's mean radius that it may sink into a floor and not be seen from below
const faded = 0.7;        // of seeds before force chains, towards the paper
const quad = new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]);

const common = `#version 300 es
precision highp float;
uniform mat3 turn;    // to right, up, toward
uniform vec3 target;  // mm, as all that follows
uniform vec3 span;    // half of what is seen: across, upwards, in depth
uniform float pixel;
uniform vec4 pose;    // place, and angle in rad
uniform vec4 cut;     // what lies beyond this plane is left out
vec3 placed(vec3 own) {
  float c = cos(pose.w), s = sin(pose.w);
  return vec3(c * own.x - s * own.y, s * own.x + c * own.y, own.z) + pose.xyz;
}
vec3 seen(vec3 at) { return turn * (at - target); }
vec4 onScreen(vec3 at) { return vec4(at.xy / span.xy, -at.z / span.z, 1); }
bool isCut(vec3 at) { return dot(at, cut.xyz) > cut.w; }
const vec4 nowhere = vec4(2, 2, 2, 1);
`;

const fragment = `#version 300 es
precision highp float;
out vec4 painted;
const vec3 light = normalize(vec3(-0.45, 0.75, 0.6));  // to it, as seen
float sky(mat3 turn, vec3 normal) { return 0.5 + 0.5 * dot(normal, turn[1]); }
`;

const ballShaders = {
  vertex: `${common}
in vec2 corner;
in vec4 ball;
in vec4 colour;
out vec2 at;
out vec3 tint;
flat out float near;
flat out float radius;
void main() {
  vec3 middle = placed(ball.xyz);
  vec3 from = seen(middle);
  radius = max(ball.w, ${leastRadius} * pixel);
  at = corner * (1.0 + pixel / radius);
  tint = colour.rgb;
  near = from.z;
  gl_Position = isCut(middle) ? nowhere : onScreen(from + vec3(at * radius, 0));
}`,
  fragment: `${fragment}
uniform mat3 turn;
uniform vec3 span;
uniform vec3 depths;  // mm: the furthest, the nearest; how much of the furthest colour stays
uniform vec3 paper;
uniform vec3 depth;
uniform float fading;
in vec2 at;
in vec3 tint;
flat in float near;
flat in float radius;
void main() {
  float out_ = length(at);
  float cover = clamp((1.0 - out_) / fwidth(out_) + 0.5, 0.0, 1.0);
  if (cover <= 0.0) discard;
  vec3 normal = vec3(at, sqrt(max(0.0, 1.0 - out_ * out_)));
  float z = near + normal.z * radius;
  gl_FragDepth = 0.5 - 0.5 * z / span.z;
  float part = clamp((z - depths.x) / (depths.y - depths.x), 0.0, 1.0);
  vec3 own = mix(depth, tint, mix(depths.z, 1.0, part));
  float lit = 0.46 + 0.26 * sky(turn, normal) + 0.5 * max(0.0, dot(normal, light));
  float shine = pow(max(0.0, dot(normal, normalize(light + vec3(0, 0, 1)))), 40.0);
  vec3 all = own * lit * mix(0.78, 1.0, normal.z) + 0.22 * shine;
  painted = vec4(mix(all, paper, fading), cover);
}`,
};

const wallShaders = {
  vertex: `${common}
in vec3 own;
in vec3 normal;
in float opens;
uniform float time;
uniform float bias;
out vec3 at;
out vec3 facing;
void main() {
  at = placed(own);
  facing = turn * (placed(normal) - placed(vec3(0)));
  gl_Position = time >= opens ? nowhere : onScreen(seen(at) + vec3(0, 0, bias));
}`,
  fragment: `${fragment}
uniform mat3 turn;
uniform vec4 cut;
uniform vec3 tint;
uniform float glass;
in vec3 at;
in vec3 facing;
void main() {
  if (dot(at, cut.xyz) > cut.w) discard;
  vec3 normal = normalize(facing.z < 0.0 ? -facing : facing);
  float lit = 0.62 + 0.3 * sky(turn, normal) + 0.14 * max(0.0, dot(normal, light));
  painted = vec4(tint * lit, glass > 0.5 ? mix(0.34, 0.1, normal.z) : 1.0);
}`,
};

const lineShaders = {
  vertex: `${common}
in vec2 corner;
in vec3 from;
in vec3 to;
in vec3 look;  // width, mm; opacity; when it opens, s
uniform float time;
uniform float least;  // width, px
out vec3 at;
out float opacity;
out vec2 inside;      // from the middle, along and aside
flat out vec2 half_;  // length, width
void main() {
  vec3 begin = placed(from), end = placed(to);
  vec3 a = seen(begin), b = seen(end);
  vec2 along = b.xy - a.xy;
  float length_ = length(along);
  along = length_ > 0.0 ? along / length_ : vec2(1, 0);
  half_ = vec2(0.5 * length_, 0.5 * max(look.x, least * pixel));
  inside = corner * vec2(half_.x + half_.y, half_.y);
  float part = clamp(0.5 + 0.5 * corner.x, 0.0, 1.0);
  at = mix(begin, end, part);
  opacity = look.y;
  vec3 here = vec3(0.5 * (a.xy + b.xy) + along * inside.x + vec2(-along.y, along.x) * inside.y, mix(a.z, b.z, part) + 0.0005 * span.z);
  gl_Position = time >= look.z ? nowhere : onScreen(here);
}`,
  fragment: `${fragment}
uniform vec4 cut;
uniform vec3 tint;
uniform float rounded;  // how dark the sides are
in vec3 at;
in float opacity;
in vec2 inside;
flat in vec2 half_;
void main() {
  float aside = length(vec2(max(0.0, abs(inside.x) - half_.x), inside.y)) / half_.y;
  if (aside > 1.0 || dot(at, cut.xyz) > cut.w) discard;
  painted = vec4(tint * mix(1.0, sqrt(1.0 - aside * aside), rounded), opacity);
}`,
};

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
    const names = ['turn', 'target', 'span', 'pixel', 'pose', 'cut', 'time', 'depths', 'depth', 'paper', 'fading', 'tint', 'glass', 'least', 'bias', 'rounded'];
    this.set = Object.fromEntries(names.map((name) => [name, { value: 0 }]));
    this.ballMesh = this.mesh(ballShaders, this.ballGeometry());
    this.vessels = parts.map(({ walls, rims }) => ({
      floors: this.wallMesh(walls, true), glass: this.wallMesh(walls, false),
      edges: this.lineMesh(walls.edges.map(({ from, to, opens }) => [from, to, 0, 0.9, opens])),
      rims: this.lineMesh(rims.map(([from, to]) => [from, to, 0, 1, Infinity])),
    }));
    this.chains = { of: null, mesh: null };
  }

  mesh(shaders, geometry, { seeThrough = false, depthTest = true } = {}) {
    if (!geometry) return null;
    const { gl } = this;
    this.programs = this.programs ?? new Map();
    const key = `${seeThrough} ${depthTest}`;
    const kept = this.programs.get(shaders) ?? this.programs.set(shaders, new Map()).get(shaders);
    if (!kept.has(key)) kept.set(key, new Program(gl, { ...shaders, uniforms: this.set, transparent: seeThrough, cullFace: null, depthTest, depthWrite: !seeThrough }));
    return new Mesh(gl, { geometry, program: kept.get(key), mode: geometry.attributes.index ? gl.TRIANGLES : gl.TRIANGLE_STRIP });
  }

  ballGeometry() {
    const { gl, balls } = this;
    this.colour = new Uint32Array(balls.most);
    this.place = { size: 4, instanced: 1, data: balls.place, usage: gl.DYNAMIC_DRAW };
    this.tints = { size: 4, instanced: 1, data: new Uint8Array(this.colour.buffer), type: gl.UNSIGNED_BYTE, normalized: true, usage: gl.DYNAMIC_DRAW };
    return new Geometry(gl, { corner: { size: 2, data: quad }, ball: this.place, colour: this.tints });
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
    for (const [name, value] of Object.entries(values)) this.set[name].value = value;
    mesh.draw();
  }

  /** `scene`: { camera, motion, poses (of the parts; null of a vessel that was not recorded), frame, bins, colours, ink, time, cut, chains, radius (mm), least }. */
  draw(stage, scene) {
    const { gl, renderer } = this;
    const { camera, ink } = scene;
    const { width, height } = stage.canvas;
    if (gl.canvas.width !== width || gl.canvas.height !== height) Object.assign(gl.canvas, { width, height });
    renderer.setViewport(width, height);
    renderer.setDepthMask(true);
    const paper = unitColour(ink.card);
    gl.clearColor(...paper, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    this.look(camera, scene, paper);
    this.upload(scene);
    gl.enable(gl.SAMPLE_ALPHA_TO_COVERAGE);
    this.paint(this.ballMesh, { pose: poseOf(scene.motion), fading: scene.chains ? faded : 0 });
    gl.disable(gl.SAMPLE_ALPHA_TO_COVERAGE);
    const wall = unitColour(ink.wall), floor = unitColour(ink.floor), accent = unitColour(ink.accent);
    const ofEach = (act) => this.vessels.forEach((vessel, k) => { if (scene.poses[k]) act(vessel, poseOf(scene.poses[k])); });
    ofEach(({ floors }, pose) => this.paint(floors, { pose, tint: floor, glass: 0, bias: pressed * scene.radius }));
    this.set.rounded.value = 0;
    ofEach(({ edges, rims }, pose) => {
      this.paint(edges, { pose, tint: wall, least: edgeWidth * stage.ratio });
      this.paint(rims, { pose, tint: accent, least: rimWidth * stage.ratio });
    });
    ofEach(({ glass }, pose) => this.paint(glass, { pose, tint: unitColour(ink.glass), glass: 1, bias: 0 }));
    if (scene.chains) this.paint(this.chainMesh(scene), { pose: poseOf(scene.motion), tint: unitColour(ink.chain), least: thinnest * stage.ratio, rounded: darkSides });
  }

  look(camera, { time, cut, ink }, paper) {
    const { right, up, toward, half } = camera;
    const { set } = this;
    set.turn.value = [0, 1, 2].flatMap((axis) => [right[axis], up[axis], toward[axis]]);
    set.target.value = camera.target;
    set.span.value = [camera.width / 2 / camera.scale, camera.height / 2 / camera.scale, camera.depth];
    set.pixel.value = camera.width / camera.scale / this.gl.canvas.width;
    set.cut.value = cut;
    set.time.value = time;
    const middle = camera.middle.reduce((all, value, axis) => all + (value - camera.target[axis]) * toward[axis], 0);
    const deep = toward.reduce((all, value, axis) => all + Math.abs(value) * half[axis], 0);
    set.depths.value = [middle - deep, middle + deep, 0.7];
    set.depth.value = unitColour(ink.depth);
    set.paper.value = paper;
  }

  // Places where the frame is another, colours where its grains or their colours are.
  upload({ frame, bins, colours }) {
    const { balls, ballMesh: { geometry } } = this;
    if (this.frame !== frame) {
      balls.fill(frame);
      this.place.data = balls.place.subarray(0, 4 * balls.count);
      this.place.needsUpdate = true;
      geometry.setInstancedCount(balls.count);
    }
    const palette = colours.join();
    if (this.ids !== frame.ids || this.bins !== bins || this.palette !== palette) {
      const packed = colours.map(packedColour);
      for (let k = 0; k < balls.count; ++k) this.colour[k] = packed[bins[balls.grain[k]]];
      this.tints.data = new Uint8Array(this.colour.buffer, 0, 4 * balls.count);
      this.tints.needsUpdate = true;
    }
    Object.assign(this, { frame, ids: frame.ids, bins, palette });
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

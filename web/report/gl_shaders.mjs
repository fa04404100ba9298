// The shaders of a run in space.
import { lamp } from './lamp.mjs';
import { lightShader } from './shadow.mjs';

const leastRadius = 0.7;     // px, of a ball
const faceOfBall = 0.6;      // of its radius aside, where the light on a ball is asked for
const outOfBall = 1.15;      // and toward the lamp
const skyInShadow = 0.8;     // of the sky's light that a ball in shadow has
const lampInShadow = 0.35;   // and of the lamp's, from all about it
const floorShadow = 0.45;    // of its light that a floor in shadow has not
const leastUpright = 0.25;   // of a floor's normal, toward the lamp: a floor nearer to edge-on has less of a shadow

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
const vec3 light = vec3(${lamp.map((value) => value.toFixed(5)).join()});  // to it, as seen
float sky(mat3 turn, vec3 normal) { return 0.5 + 0.5 * dot(normal, turn[1]); }
`;

/** Balls, cut out of squares. */
export const ballShaders = {
  vertex: `${common}${lightShader}
in vec2 corner;
in vec4 ball;
in vec4 colour;
out vec2 at;
out vec3 tint;
out float reached;
flat out float near;
flat out float radius;
void main() {
  vec3 middle = placed(ball.xyz);
  vec3 from = seen(middle);
  radius = max(ball.w, ${leastRadius} * pixel);
  at = corner * (1.0 + pixel / radius);
  tint = colour.rgb;
  near = from.z;
  reached = lightAt(middle + radius * (${faceOfBall} * vec3(corner, 0) * turn + ${outOfBall} * vec3(0, 0, 1) * lampTurn), vec2(0));
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
in float reached;
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
  float lit = (0.46 + 0.26 * sky(turn, normal)) * mix(${skyInShadow}, 1.0, reached) + 0.5 * mix(${lampInShadow}, 1.0, reached) * max(0.0, dot(normal, light));
  float shine = reached * pow(max(0.0, dot(normal, normalize(light + vec3(0, 0, 1)))), 40.0);
  vec3 all = own * lit * mix(0.78, 1.0, normal.z) + 0.22 * shine;
  painted = vec4(mix(all, paper, fading), cover);
}`,
};

/** The same as the lamp sees them: discs through their middles, so that a ball is not in its own shadow; as points, since software draws instances one by one. */
export const discShaders = {
  vertex: `${common}
in vec4 ball;
void main() {
  vec3 middle = placed(ball.xyz);
  gl_Position = isCut(middle) ? nowhere : onScreen(seen(middle));
  gl_PointSize = max(1.0, 2.0 * ball.w / pixel);
}`,
  fragment: `${fragment}
void main() {
  vec2 at = 2.0 * gl_PointCoord - 1.0;
  if (dot(at, at) > 1.0) discard;
  painted = vec4(1);
}`,
};

/** Faces: floors, and walls of glass, which have no shadow on them. */
export const wallShaders = {
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
  fragment: `${fragment}${lightShader}
uniform mat3 turn;
uniform vec4 cut;
uniform vec3 tint;
uniform float glass;
in vec3 at;
in vec3 facing;
float reached(vec3 normal) {
  vec3 own = lampTurn * (normal * turn);
  float steep = abs(own.z), upright = (own.z < 0.0 ? -1.0 : 1.0) * max(steep, ${leastUpright});
  float dark = 1.0 - lightAt(at, -own.xy / upright);
  return 1.0 - ${floorShadow} * smoothstep(0.0, ${leastUpright}, steep) * dark;
}
void main() {
  if (dot(at, cut.xyz) > cut.w) discard;
  vec3 normal = normalize(facing.z < 0.0 ? -facing : facing);
  float lit = 0.62 + 0.3 * sky(turn, normal) + 0.14 * max(0.0, dot(normal, light));
  if (glass < 0.5) lit *= reached(normal);
  painted = vec4(tint * lit, glass > 0.5 ? mix(0.34, 0.1, normal.z) : 1.0);
}`,
};

/** Lines as wide as they are or as is asked for at least. */
export const lineShaders = {
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

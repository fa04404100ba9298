// The shadow of balls and edges in space: how far the light of one lamp reaches, drawn as the lamp sees it, and read with soft edges (percentage-closer
// filtering; W. T. Reeves, D. H. Salesin, R. L. Cook, Rendering antialiased shadows with depth maps, 1987).
import { RenderTarget } from 'ogl';
import { turnOf } from './lamp.mjs';

const size = 512;       // px of the map
const softness = 1.0;   // of a seed's mean radius, to either side of a shadow's edge
const leastSoft = 1.5;  // px of the map
const bias = 0.001;     // of the depth of what is seen: what lies on an edge is not in its shadow
const tapCount = 12;
const goldenAngle = Math.PI * (3 - Math.sqrt(5));

const taps = Array.from({ length: tapCount }, (_, k) => [Math.sqrt((k + 0.5) / tapCount), goldenAngle * k])
  .map(([radius, angle]) => `vec2(${(radius * Math.cos(angle)).toFixed(5)}, ${(radius * Math.sin(angle)).toFixed(5)})`);

/** GLSL: lightAt(place, slope) is the part of the light that reaches a place, mm; `slope`: how much nearer to the lamp its face comes, a mm to the side. */
export const lightShader = `
uniform mat3 lampTurn;    // to right, up, toward the lamp
uniform vec3 lampTarget;  // mm, as all that follows
uniform vec3 lampSpan;
uniform float soft;
uniform highp sampler2DShadow shadow;
const vec2 taps[${tapCount}] = vec2[${tapCount}](${taps.join()});
float lightAt(vec3 place, vec2 slope) {
  vec3 at = lampTurn * (place - lampTarget);
  float sum = 0.0;
  for (int k = 0; k < ${tapCount}; ++k) {
    vec2 aside = soft * taps[k];
    vec3 here = at + vec3(aside, dot(slope, aside) + ${bias} * lampSpan.z);
    sum += texture(shadow, 0.5 + 0.5 * vec3(here.xy, -here.z) / lampSpan);
  }
  return sum / ${tapCount}.0;
}
`;

export class Shadow {
  constructor(gl) {
    this.gl = gl;
    this.map = new RenderTarget(gl, { width: size, height: size, color: 0, depthTexture: true });
    const { depthTexture } = this.map;
    depthTexture.bind();
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE);
  }

  /** How large one of its pixels is, mm. */
  pixelOf({ span }) {
    return (2 * span[0]) / size;
  }

  /** How far a shadow's edge fades to either side, mm; `radius`: a seed's. */
  softOf(seen, radius) {
    return Math.max(softness * radius, leastSoft * this.pixelOf(seen));
  }

  /** What lightShader asks for. A sampler of shadows keeps unit 0, where a program has its first texture: ogl sets none. */
  uniforms(seen, radius) {
    return {
      lampTurn: turnOf(seen), lampTarget: seen.target, lampSpan: seen.span, shadow: this.map.depthTexture,
      soft: this.softOf(seen, radius),
    };
  }

  /** Calls `draw` to draw into the map. */
  fill(draw) {
    const { gl, map } = this, { renderer } = gl;
    renderer.bindFramebuffer(map);
    renderer.setViewport(size, size);
    renderer.setDepthMask(true);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    draw();
    renderer.bindFramebuffer();
  }
}

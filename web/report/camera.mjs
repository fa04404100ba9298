// How a run in space is looked at: without perspective, turned about an upright and a level axis. Millimetres of the lab: x along, y up, z to the
// back; on the screen pixels, y down, and as the third how near a place is, mm.

const margin = 16;      // px
const closest = 60;     // times as large as the whole
const ofHole = 5;       // radii of a hole to either side of it, when it is looked through
const steepest = Math.PI / 2;

const lengthOf = (values) => Math.hypot(...values);
const kept = (value, low, high) => Math.min(high, Math.max(low, value));

export class Camera {
  /** `box`: what is to be seen (labBox); `holes`: [{ at: [x, y, z], radius }]. */
  constructor(box, holes) {
    this.half = [(box.right - box.left) / 2, (box.high - box.low) / 2, (box.back - box.front) / 2];
    this.middle = [(box.left + box.right) / 2, (box.low + box.high) / 2, (box.front + box.back) / 2];
    this.depth = 4 * lengthOf(this.half);  // to either side of the middle, what is drawn
    this.holes = holes;
    this.look('front');
  }

  /** "front", "corner", "above", or "hole": from below through the `hole`th. */
  look(name, hole = 0) {
    const [w, h, d] = this.half;
    const views = {
      front: { yaw: 0, pitch: 0, span: [w, h] },
      corner: { yaw: -0.5, pitch: 0.42, span: [0.88 * w + 0.48 * d, 0.92 * h + 0.41 * (0.48 * w + 0.88 * d)] },
      above: { yaw: 0, pitch: steepest, span: [w, d] },
    };
    const through = this.holes[hole];
    views.hole = through ? { yaw: 0, pitch: -1.1, span: [ofHole * through.radius, ofHole * through.radius], target: through.at } : views.above;
    const { yaw, pitch, span, target = this.middle } = views[name];
    Object.assign(this, { yaw, pitch, span, target: [...target], zoom: 1 });
    this.turn();
  }

  /** Sets how large the picture is, px. */
  place(width, height) {
    this.width = width;
    this.height = height;
    const [w, h] = this.span;
    this.scale = this.zoom * Math.min((width - 2 * margin) / (2 * w), (height - 2 * margin) / (2 * h));
  }

  /** The height, px, in which the front fills `width`. */
  heightOf(width) {
    const [w, h] = this.half;
    return ((width - 2 * margin) / w) * h + 2 * margin + 24;
  }

  turn() {
    const [cosYaw, sinYaw, cosPitch, sinPitch] = [Math.cos(this.yaw), Math.sin(this.yaw), Math.cos(this.pitch), Math.sin(this.pitch)];
    this.right = [cosYaw, 0, sinYaw];
    this.up = [-sinPitch * sinYaw, cosPitch, sinPitch * cosYaw];
    this.toward = [cosPitch * sinYaw, sinPitch, -cosPitch * cosYaw];
  }

  /** Turns by angles, rad. */
  orbit(yaw, pitch) {
    this.yaw += yaw;
    this.pitch = kept(this.pitch + pitch, -steepest, steepest);
    this.turn();
  }

  /** Moves what is seen by pixels. */
  pan(x, y) {
    this.target = this.target.map((value, axis) => kept(value - (x * this.right[axis] - y * this.up[axis]) / this.scale,
      this.middle[axis] - 2 * this.half[axis] - 1, this.middle[axis] + 2 * this.half[axis] + 1));
  }

  /** Makes all `by` times as large, and what lies at a place of the screen stays there; without one, the middle. */
  zoomBy(by, x = this.width / 2, y = this.height / 2) {
    const before = this.scale;
    const whole = (before / this.zoom) * Math.max(...this.span) / lengthOf(this.half);  // px a mm, with all of it in sight
    const scale = kept(before * by, 0.4 * whole, closest * whole);
    this.zoom *= scale / before;
    this.scale = scale;
    const more = scale / before - 1;
    this.pan((this.width / 2 - x) * more, (this.height / 2 - y) * more);
  }

  /** Where a place is on the screen: x, y, and how near. */
  project(x, y, z) {
    const d = [x - this.target[0], y - this.target[1], z - this.target[2]];
    const along = (axis) => axis[0] * d[0] + axis[1] * d[1] + axis[2] * d[2];
    return [this.width / 2 + this.scale * along(this.right), this.height / 2 - this.scale * along(this.up), along(this.toward)];
  }
}

// The balls of a frame's grains in space: of a clump each of its own. Millimetres of the lab.

// Balls of a clump over the radius of the ball that holds it; null of a grain that is one ball.
function ballsOf(lot) {
  if (!lot.discs?.length) return null;
  const reach = Math.max(...lot.discs.map((ball) => Math.hypot(ball.x_mm, ball.y_mm, ball.z_mm ?? 0) + ball.radius_mm));
  return lot.discs.map((ball) => [ball.x_mm, ball.y_mm, ball.z_mm ?? 0, ball.radius_mm].map((value) => value / reach));
}

// Turns by a quaternion that need not be of length 1: nine numbers, row by row, into `turn`.
function setTurn(turn, w, x, y, z) {
  const s = 2 / (w * w + x * x + y * y + z * z || 1);
  turn[0] = 1 - s * (y * y + z * z); turn[1] = s * (x * y - w * z); turn[2] = s * (x * z + w * y);
  turn[3] = s * (x * y + w * z); turn[4] = 1 - s * (x * x + z * z); turn[5] = s * (y * z - w * x);
  turn[6] = s * (x * z - w * y); turn[7] = s * (y * z + w * x); turn[8] = 1 - s * (x * x + y * y);
}

export class Balls {
  constructor(recording, lots) {
    this.recording = recording;
    this.shapes = lots.map(ballsOf);
    this.most = Math.max(1, ...this.shapes.map((shape) => shape?.length ?? 1)) * recording.mostGrains;
    this.count = 0;
    this.place = new Float32Array(4 * this.most);  // x, y, z and radius of each
    this.grain = new Uint32Array(this.most);       // its place in the frame's list
    this.turn = new Float64Array(9);
  }

  /** Those of a frame. */
  fill(frame) {
    const { recording, place, grain, turn } = this;
    const [mmX, mmY, mmZ] = recording.units.map((unit) => unit * 1000);
    const [xs, ys, zs, ws, as, bs, cs] = frame.values;
    let n = 0;
    for (let k = 0; k < frame.ids.length; ++k) {
      const id = frame.ids[k];
      const x = xs[k] * mmX, y = ys[k] * mmY, z = zs[k] * mmZ, radius = recording.radii[id] * 1000;
      const shape = this.shapes[recording.lots[id]];
      if (!shape) {
        place[4 * n] = x; place[4 * n + 1] = y; place[4 * n + 2] = z; place[4 * n + 3] = radius;
        grain[n++] = k;
        continue;
      }
      if (ws) setTurn(turn, ws[k], as[k], bs[k], cs[k]);
      else setTurn(turn, 1, 0, 0, 0);
      for (const [a, b, c, r] of shape) {
        place[4 * n] = x + radius * (turn[0] * a + turn[1] * b + turn[2] * c);
        place[4 * n + 1] = y + radius * (turn[3] * a + turn[4] * b + turn[5] * c);
        place[4 * n + 2] = z + radius * (turn[6] * a + turn[7] * b + turn[8] * c);
        place[4 * n + 3] = radius * r;
        grain[n++] = k;
      }
    }
    this.count = n;
  }
}

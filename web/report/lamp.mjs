// Where the light of a run in space comes from, and how all looks from there.

const room = 1.05;  // of what is seen

const dot = (a, b) => a.reduce((sum, value, axis) => sum + value * b[axis], 0);
const scaled = (vector, length) => vector.map((value) => (value * length) / Math.hypot(...vector));
const cross = ([a, b, c], [x, y, z]) => [b * z - c * y, c * x - a * z, a * y - b * x];

/** To the lamp, as seen: it stands where it is while the tray is turned, like one on the table. */
export const lamp = scaled([-0.45, 0.75, 0.6], 1);

/** How the lamp sees what a camera looks at, as wide as high: { right, up, toward, target, span }, mm. */
export function seenByLamp({ right, up, toward, middle, half }) {
  const axes = [right, up, toward];
  const to = [0, 1, 2].map((axis) => axes.reduce((sum, one, k) => sum + lamp[k] * one[axis], 0));
  const aside = scaled(right.map((value, axis) => value - dot(right, to) * to[axis]), 1);
  const over = cross(to, aside);
  const [across, upwards, deep] = [aside, over, to].map((axis) => room * axis.reduce((sum, value, k) => sum + Math.abs(value) * half[k], 0));
  const square = Math.max(across, upwards);
  return { right: aside, up: over, toward: to, target: middle, span: [square, square, deep] };
}

/** Three axes as the matrix of a shader that turns to them. */
export function turnOf({ right, up, toward }) {
  return [0, 1, 2].flatMap((axis) => [right[axis], up[axis], toward[axis]]);
}

// Where vessels are at any moment of a run in space.

const keys = ['x', 'y', 'z', 'angle'];

function mixed(a, b, part) {
  return Object.fromEntries(keys.map((key) => [key, a[key] + (b[key] - a[key]) * part]));
}

/** The pose of a vessel, m and rad, `part` of the way from the frame `index` to the next: by its `path` ({ step_s, at: [[x, y, z (mm), angle (rad)]] }), without one straight on. */
export function poseAt(recording, vessel, path, index, part) {
  const here = recording.pose(index, vessel);
  if (part === 0) return here;
  if (!path) return mixed(here, recording.pose(index + 1, vessel), part);
  const time = recording.times[index] + part * (recording.times[index + 1] - recording.times[index]);
  const step = Math.min(path.at.length - 2, Math.floor(time / path.step_s));
  const [from, to] = [path.at[step], path.at[step + 1]].map(([x, y, z, angle]) => ({ x: x / 1000, y: y / 1000, z: z / 1000, angle }));
  return mixed(from, to, Math.min(1, time / path.step_s - step));
}

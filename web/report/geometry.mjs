// Where things are: vessels in the lab, and what of the lab the replay shows. Millimetres, x along, y up, z to the back.

/** A place of a vessel's own frame, in the lab; `pose` in m and rad. */
export function toLab(pose, x, y) {
  const cos = Math.cos(pose.angle), sin = Math.sin(pose.angle);
  return [cos * x - sin * y + pose.x * 1000, sin * x + cos * y + pose.y * 1000];
}

/** The other way about. */
export function toOwn(pose, x, y) {
  const cos = Math.cos(pose.angle), sin = Math.sin(pose.angle);
  const dx = x - pose.x * 1000, dy = y - pose.y * 1000;
  return [cos * dx + sin * dy, cos * dy - sin * dx];
}

/** A place of three coordinates, mm, in the lab. */
export function placed(pose, [x, y, z]) {
  return [...toLab(pose, x, y), z + pose.z * 1000];
}

/** The pose that `inner` has in the lab, where it is given in the frame of `outer`. */
export function composed(outer, inner) {
  const [x, y, z] = placed(outer, [inner.x * 1000, inner.y * 1000, inner.z * 1000]);
  return { x: x / 1000, y: y / 1000, z: z / 1000, angle: outer.angle + inner.angle };
}

/** The lab in a vessel's frame. */
export function inverse(pose) {
  const [x, y] = toOwn(pose, 0, 0);
  return { x: x / 1000, y: y / 1000, z: -pose.z, angle: -pose.angle };
}

/** The pose of a vessel that rests. */
export function restPose({ at_mm: at = [0, 0, 0], tilt_rad: tilt = 0 }) {
  return { x: at[0] / 1000, y: at[1] / 1000, angle: tilt ?? 0 };
}

/** The walls of `vessel` in the frame of `other`, both at rest; without those of gates, which open. */
export function wallsSeenFrom(other, vessel) {
  const walls = (vessel.lines ?? []).filter((line) => typeof line.opens_at_s !== 'number').map((line) => line.points_mm);
  return walls.map((points) => points.map(([x, y]) => toOwn(restPose(other), ...toLab(restPose(vessel), x, y))));
}

/** The mean pose of a vessel over all frames: the place that it shakes about. */
export function meanPose(recording, vessel) {
  const mean = { x: 0, y: 0, z: 0, angle: 0 };
  for (let frame = 0; frame < recording.frames; ++frame) {
    const pose = recording.pose(frame, vessel);
    for (const key of Object.keys(mean)) mean[key] += pose[key] / recording.frames;
  }
  return mean;
}

function widen(box, x, y) {
  box.left = Math.min(box.left, x);
  box.right = Math.max(box.right, x);
  box.low = Math.min(box.low, y);
  box.high = Math.max(box.high, y);
}

/** The lab's part, seen from the side, that holds all vessels in all frames: left, right, low, high; and front, back. */
export function labBox(vessels, recording) {
  const box = { left: Infinity, right: -Infinity, low: Infinity, high: -Infinity, front: 0, back: 0 };
  vessels.forEach((vessel) => {
    const place = recording.vessels.indexOf(vessel.name);
    const points = (vessel.lines ?? []).flatMap((line) => line.points_mm);
    for (let frame = 0; place >= 0 && frame < recording.frames; ++frame) {
      const pose = recording.pose(frame, place);
      for (const [x, y] of points) widen(box, ...toLab(pose, x, y));
      box.back = Math.max(box.back, (vessel.depth_mm ?? 0) + pose.z * 1000);
      box.front = Math.min(box.front, pose.z * 1000);
    }
  });
  return Number.isFinite(box.left) ? box : { left: 0, right: 100, low: 0, high: 50, front: 0, back: 0 };
}

/** Where the floor lies at a hole, in the vessel's frame: the lowest end of a line at one of its rims, else 0. */
export function floorAt(vessel, hole) {
  const near = (x) => [hole.x_mm - hole.half_x_mm, hole.x_mm + hole.half_x_mm].some((rim) => Math.abs(rim - x) < 0.01);
  const ends = (vessel.lines ?? []).flatMap((line) => line.points_mm).filter(([x]) => near(x)).map(([, y]) => y);
  return ends.length ? Math.min(...ends) : 0;
}

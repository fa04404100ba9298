// A simulation under way, given to the replay's view as a recording of the one frame that is shown.

/** Where a vessel rests, in the lab, m and rad. */
export function restPose({ at_mm: at = [0, 0, 0], tilt_rad: tilt = 0 }) {
  return { x: at[0] / 1000, y: at[1] / 1000, z: 0, angle: tilt };
}

/** How far, m, a motion swings to either side: [x, y]; nothing where it does not go to and fro on a line. */
export function swingOf(motion) {
  if (motion?.kind === 'harmonic') return [motion.amplitude_m * Math.cos(motion.direction_rad), motion.amplitude_m * Math.sin(motion.direction_rad)];
  if (motion?.kind === 'sum') return motion.components.map((one) => swingOf({ kind: 'harmonic', ...one })).reduce(([x, y], [dx, dy]) => [x + Math.abs(dx), y + Math.abs(dy)], [0, 0]);
  return [0, 0];
}

/** What `labBox` of the replay asks: each vessel where it rests and at both ends of its swing. */
export function swings(vessels, scene) {
  const ends = vessels.map((vessel) => swingOf(scene[vessel.name]?.motion));
  const pose = (frame, k) => {
    const rest = restPose(vessels[k]), [x, y] = ends[k];
    return { ...rest, x: rest.x + (frame - 1) * x, y: rest.y + (frame - 1) * y };
  };
  return { vessels: vessels.map((vessel) => vessel.name), frames: 3, pose };
}

export class LiveRecording {
  constructor(vessels) {
    Object.assign(this, { rests: vessels.map(restPose), vessels: vessels.map((vessel) => vessel.name), fields: ['x', 'y', 'angle'], units: [1, 1, 1], places: new Uint32Array(0) });
  }

  /** Makes `frame` the one that is shown; returns it as the view takes it. */
  take(frame) {
    const grains = frame.x.length;
    if (this.places.length < grains) this.places = Uint32Array.from({ length: 2 * grains }, (_, k) => k);
    Object.assign(this, { radii: frame.radius, lots: frame.lot, moved: frame.vessels });
    return { ids: this.places.subarray(0, grains), values: [frame.x, frame.y, frame.angle] };
  }

  pose(_, vessel) {
    const rest = this.rests[vessel], moved = this.moved[vessel];
    return moved ? { ...rest, x: rest.x + moved.x_m, y: rest.y + moved.y_m, angle: rest.angle + moved.angle_rad } : rest;
  }
}

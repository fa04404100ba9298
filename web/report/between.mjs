// Moments between the frames of a recording in space: each grain on a cubic through the frames about it, in the tray's frame where it rides on
// the tray, else in the lab. A recording has two or three frames a shake; in the lab alone a grain that rides would cut through walls.

// Where each of the ids stands in another list, -1 where it does not; both ascend.
function placesIn(ids, other) {
  const places = new Int32Array(ids.length);
  for (let k = 0, j = 0; k < ids.length; ++k) {
    while (j < other.length && other[j] < ids[k]) ++j;
    places[k] = other[j] === ids[k] ? j : -1;
  }
  return places;
}

// How far each grain goes through four frames. Over three intervals, since in one the tray may swing out and back.
function ways(at, places) {
  const all = new Float64Array(places[0].length);
  for (let step = 0; step < 3; ++step) {
    const [a, b, here, there] = [at[step], at[step + 1], places[step], places[step + 1]];
    for (let k = 0; k < all.length; ++k) {
      if (here[k] < 0 || there[k] < 0) continue;
      const x = b[3 * k] - a[3 * k], y = b[3 * k + 1] - a[3 * k + 1], z = b[3 * k + 2] - a[3 * k + 2];
      all[k] += Math.sqrt(x * x + y * y + z * z);
    }
  }
  return all;
}

// Coordinates on Catmull and Rom's cubics through four frames.
function along({ at: [before, from, to, after], places: [hasBefore, , hasTo, hasAfter] }, part) {
  const all = new Float64Array(from.length);
  const t2 = part * part, t3 = t2 * part;
  const ofA = 2 * t3 - 3 * t2 + 1, ofSlopeA = t3 - 2 * t2 + part, ofB = 3 * t2 - 2 * t3, ofSlopeB = t3 - t2;
  for (let n = 0; n < all.length; ++n) {
    const k = Math.floor(n / 3), a = from[n], b = to[n];
    const cameFrom = hasBefore[k] >= 0, goesOn = hasAfter[k] >= 0;
    if (hasTo[k] < 0) all[n] = cameFrom ? a + (a - before[n]) * part : a;
    else all[n] = ofA * a + ofSlopeA * (cameFrom ? (b - before[n]) / 2 : b - a) + ofB * b + ofSlopeB * (goesOn ? (after[n] - a) / 2 : b - a);
  }
  return all;
}

// Quaternions the shorter way, not brought to length 1.
function turn({ frames: [, from, to], places: [, , places], values }, part) {
  const fields = [3, 4, 5, 6].filter((field) => field < values.length);
  if (fields.length === 0) return;
  const [w, x, y, z] = fields.map((field) => from.values[field]), [w2, x2, y2, z2] = fields.map((field) => to.values[field]);
  const [ws, xs, ys, zs] = fields.map((field) => values[field]);
  for (let k = 0; k < places.length; ++k) {
    const j = places[k], stays = j < 0;
    const b = stays ? 0 : part * Math.sign(w[k] * w2[j] + x[k] * x2[j] + y[k] * y2[j] + z[k] * z2[j] || 1), a = stays ? 1 : 1 - part;
    ws[k] = a * w[k] + (b && b * w2[j]);
    xs[k] = a * x[k] + (b && b * x2[j]);
    ys[k] = a * y[k] + (b && b * y2[j]);
    zs[k] = a * z[k] + (b && b * z2[j]);
  }
}

const nowhere = { x: 0, y: 0, z: 0, angle: 0 };

export class Between {
  constructor(recording) {
    this.recording = recording;
    this.tray = Math.max(0, recording.vessels.indexOf('tray'));
    this.known = { index: -1 };
  }

  // What is known of the interval after `index` until another is asked for.
  interval(index) {
    if (this.known.index !== index) this.known = { index, made: this.make(index) };
    return this.known.made;
  }

  // Of the four frames about it; at an end of the recording the nearest twice.
  async make(index) {
    const { recording } = this;
    const about = [-1, 0, 1, 2].map((by) => Math.min(recording.frames - 1, Math.max(0, index + by)));
    const frames = await Promise.all(about.map((one) => recording.frame(one)));
    const { ids } = frames[1];
    const places = frames.map((frame) => placesIn(ids, frame.ids));
    const lab = frames.map((frame, k) => this.coordinates(frame, places[k], nowhere));
    const own = frames.map((frame, k) => this.coordinates(frame, places[k], recording.pose(about[k], this.tray)));
    const [inLab, inTray] = [ways(lab, places), ways(own, places)];
    const rides = inLab.map((way, k) => (inTray[k] < way ? 1 : 0));
    lab.forEach((at, frame) => {
      for (let k = 0; k < at.length; ++k) if (rides[Math.floor(k / 3)]) at[k] = own[frame][k];
    });
    const values = recording.fields.map(() => new Float64Array(ids.length));
    return { ids, frames, places, at: lab, rides, values };
  }

  // Millimetres in the frame of a pose, three of each grain of the interval.
  coordinates(frame, places, pose) {
    const [mmX, mmY, mmZ] = this.recording.units.map((unit) => unit * 1000);
    const [xs, ys, zs] = frame.values;
    const cos = Math.cos(pose.angle), sin = Math.sin(pose.angle), left = pose.x * 1000, low = pose.y * 1000, front = pose.z * 1000;
    const at = new Float64Array(3 * places.length);
    for (let k = 0; k < places.length; ++k) {
      const j = places[k];
      if (j < 0) continue;
      const x = xs[j] * mmX - left, y = ys[j] * mmY - low;
      at[3 * k] = cos * x + sin * y;
      at[3 * k + 1] = cos * y - sin * x;
      at[3 * k + 2] = zs[j] * mmZ - front;
    }
    return at;
  }

  /** A frame as Recording.frame gives it, `part` of the way to the one after `index`; `pose`: the tray's at that moment. What leaves goes on as it went. Its values are overwritten by the next. */
  async frame(index, part, pose) {
    const interval = await this.interval(index);
    const { ids, rides, values } = interval;
    const mm = this.recording.units.map((unit) => unit * 1000);
    const cos = Math.cos(pose.angle), sin = Math.sin(pose.angle);
    const left = pose.x * 1000, low = pose.y * 1000, front = pose.z * 1000;
    const [xs, ys, zs] = values;
    const at = along(interval, part);
    for (let k = 0; k < ids.length; ++k) {
      const x = at[3 * k], y = at[3 * k + 1], z = at[3 * k + 2];
      xs[k] = (rides[k] ? cos * x - sin * y + left : x) / mm[0];
      ys[k] = (rides[k] ? sin * x + cos * y + low : y) / mm[1];
      zs[k] = (rides[k] ? z + front : z) / mm[2];
    }
    turn(interval, part);
    return { ids, values };
  }
}

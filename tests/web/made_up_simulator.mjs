// A simulator made up for tests of the studio, with the interface of web/core/simulator.mjs. Seeds lie in rows; each hole lets out
// seeds at a rate that goes with its width and the tray's speed, so that another scene gives other counts.

const framesPerSecond = 30;
const slope = 3600;      // seeds a second, per m of width and m/s of the tray
const gravity = 9.81;    // m/s2
const fall = 0.1;        // m that seeds are seen to fall

function linesOf(vessel) {
  const mm = (metres) => metres * 1000;
  const rims = [0, ...vessel.holes.flatMap((hole) => [hole.centre_m - hole.width_m / 2, hole.centre_m + hole.width_m / 2]), vessel.length_m].map(mm);
  const floor = Array.from({ length: rims.length / 2 }, (_, k) => ({ points_mm: [[rims[2 * k], 0], [rims[2 * k + 1], 0]] }));
  return [0, vessel.length_m].map((x) => ({ points_mm: [[mm(x), 0], [mm(x), mm(vessel.height_m)]] })).concat(floor);
}

function pageVessel(name, vessel) {
  return {
    name, at_mm: [vessel.left_m * 1000, vessel.above_m * 1000, 0], tilt_rad: vessel.tilt_rad, length_mm: vessel.length_m * 1000, height_mm: vessel.height_m * 1000,
    depth_mm: null, lines: linesOf(vessel),
    holes: vessel.holes.map((hole, k) => ({ number: k + 1, x_mm: hole.centre_m * 1000, z_mm: 0, half_x_mm: hole.width_m * 500, half_z_mm: 0, round: false })),
  };
}

function rows(vessel, radius, lots) {
  const count = vessel?.fill?.count ?? 0;
  const across = Math.max(1, Math.floor(vessel ? vessel.length_m / (2 * radius) : 1));
  return Array.from({ length: count }, (_, k) => ({
    x: vessel.left_m + radius * (1 + 2 * (k % across)), y: vessel.above_m + radius * (1 + 2 * Math.floor(k / across)), lot: k % lots, radius,
  }));
}

class Simulator {
  constructor() {
    this.simd = true;
    this.until = Infinity;
  }

  async open(text) {
    this.pause();
    this.next = null;
    const scene = this.asked = JSON.parse(text);
    if (scene.tray.holes.some((hole) => hole.width_m > 0.06)) throw new Error('tray.holes.width: 60 mm is as wide as this made-up simulator goes');
    this.time = 0;
    return this.begin(scene, 0);
  }

  // From a time (s) on; seeds come 0.1 s after the start.
  begin(scene, since) {
    const { duration_s: duration, measure_from_s: from } = scene.run;
    this.scene = { ...scene, run: { duration_s: since + duration, measure_from_s: since + from } };
    Object.assign(this, { since, from: since || 0.1, blocked: null });
    const motion = scene.tray.motion;
    this.speed = motion?.kind === 'harmonic' ? 2 * Math.PI * motion.frequency_hz * motion.amplitude_m : 0.3;
    this.rates = scene.tray.holes.map((hole) => slope * hole.width_m * this.speed * (0.7 + 0.3 * Math.cos(40 * hole.centre_m)));
    const radius = scene.lots[0].diameter_m / 2;
    this.seeds = [scene.tray, scene.hopper].flatMap((vessel) => rows(vessel, radius, scene.lots.length));
    const vessels = [pageVessel('tray', scene.tray), ...(scene.hopper ? [pageVessel('hopper', scene.hopper)] : [])];
    return {
      grains: this.seeds.length, duration_s: since + duration, since_s: since, measure_from_s: since + from, time_step_s: 1e-5, steps: Math.round((since + duration) / 1e-5),
      remarks: [...(scene.made_up_remarks ?? []), ...(scene.tray.holes.some((hole) => hole.width_m < 0.004) ? [{ serious: true, text: 'tray.holes.width: seeds cannot pass' }] : [])],
      lots: scene.lots.map((lot) => ({ name: lot.name, diameter_mm: lot.diameter_m * 1000 })), vessels, holes: scene.tray.holes.length, frame: this.frame(0),
    };
  }

  /** At once where it plays; a hole that moves by more than 60 mm finds no room. */
  async change(text) {
    const { asked: before } = this, scene = JSON.parse(text);
    const differs = (of) => JSON.stringify(of(scene)) !== JSON.stringify(of(before));
    if (differs(({ lots }) => lots)) return 'seeds';
    if (differs(({ numerics }) => numerics)) return 'accuracy';
    if (differs(({ tray }) => tray.holes.length)) return 'holes';
    if (scene.tray.motion?.kind !== 'harmonic') return 'motion';
    if (scene.tray.holes.some((hole) => hole.width_m > 0.06)) return 'plan';
    if (scene.tray.holes.some((hole, k) => Math.abs(hole.centre_m - before.tray.holes[k].centre_m) > 0.06)) this.blocked = this.time + 0.3;
    else this.next = scene;
    return '';
  }

  takeUp(onChange) {
    if (!this.next) return;
    this.asked = this.next;
    this.next = null;
    onChange(this.begin(this.asked, this.time));
  }

  waiting() {
    if (this.blocked === null) return '';
    return this.time < this.blocked ? 'holes' : 'given up';
  }

  counts(time) {
    return this.rates.map((rate) => Math.floor(rate * Math.max(0, time - this.from)));
  }

  falling(time) {
    const { tray, lots } = this.scene;
    return this.rates.flatMap((rate, k) => {
      const last = this.counts(time)[k];
      return Array.from({ length: Math.min(last, 60) }, (_, i) => {
        const since = time - this.from - (last - i) / rate;
        const wobble = Math.sin(12.9898 * (last - i) + k);
        return { x: tray.left_m + tray.holes[k].centre_m + 0.3 * wobble * tray.holes[k].width_m, y: -0.5 * gravity * since * since, lot: (last - i) % lots.length, radius: lots[0].diameter_m / 2 };
      }).filter((seed) => seed.y > -fall);
    });
  }

  frame(speedRatio) {
    const { time } = this;
    const { motion } = this.scene.tray;
    const shift = motion?.kind === 'harmonic' ? motion.amplitude_m * Math.sin(2 * Math.PI * motion.frequency_hz * time) : 0;
    const seeds = [...this.seeds, ...this.falling(time)];
    const of = (key) => Float32Array.from(seeds, (seed) => seed[key]);
    return {
      time_s: time, x: of('x'), y: of('y'), angle: new Float32Array(seeds.length), lot: Uint16Array.from(seeds, (seed) => seed.lot), radius: of('radius'),
      speed: Float32Array.from(seeds, (_, k) => this.speed * Math.abs(Math.sin(k + 20 * time))), counted: this.counts(time), spilled: 0, waiting: this.waiting(), speed_ratio: speedRatio,
      vessels: [{ x_m: shift, y_m: 0, angle_rad: 0 }, { x_m: 0, y_m: 0, angle_rad: 0 }],
    };
  }

  play({ pace, onFrame, onChange, onEnd }) {
    this.pause();
    const slow = this.scene.numerics.accuracy === 'design' ? 4 : 1;
    const step = (pace === null ? 0.5 : pace / framesPerSecond) / slow;
    this.timer = setInterval(() => {
      this.takeUp(onChange);
      this.time = Math.max(this.time, Math.min(this.scene.run.duration_s, this.time + step, this.until));
      onFrame(this.frame(pace ?? 15));
      if (this.time < this.scene.run.duration_s) return;
      this.pause();
      onEnd(this.result('finished'));
    }, 1000 / framesPerSecond);
  }

  limit(until) {
    this.until = until;
  }

  pause() {
    clearInterval(this.timer);
  }

  result(status) {
    const { measure_from_s: from } = this.scene.run;
    const all = this.counts(this.time), before = this.counts(from);
    const span = this.time - from;
    const holes = all.map((count, k) => {
      const counted = Math.max(0, count - before[k]);
      const error = (1.96 * Math.sqrt(counted)) / span;
      const rate = counted / span;
      return span > 0
        ? { hole: k + 1, counted, counted_all: count, seeds_per_s: rate, low: Math.max(0, rate - error), high: rate + error, longest_pause_s: 0.1 }
        : { hole: k + 1, counted: 0, counted_all: count, seeds_per_s: 0, low: 0, high: 1, longest_pause_s: null };
    });
    const total = span > 0 ? holes.reduce((sum, hole) => sum + hole.seeds_per_s, 0) : 0;
    const mean = total / holes.length;
    const cv = 100 * Math.sqrt(holes.reduce((sum, hole) => sum + (hole.seeds_per_s - mean) ** 2, 0) / Math.max(1, holes.length - 1)) / mean;
    return {
      status, end_time_s: this.time, holes, total_seeds_per_s: total, unevenness: span > 0 ? { sentence: 'the holes differ by more than chance', cv_percent: cv } : null,
      guard: 'the deepest contact pressed a grain by 0.3 % of its radius (warned from 5 %)', remarks: [],
    };
  }

  async outcome() {
    return this.result('finished');
  }

  close() {
    this.pause();
  }
}

export async function startSimulator() {
  return new Simulator();
}

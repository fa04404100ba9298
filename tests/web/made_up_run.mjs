// Runs made up for tests of the page: seeds wait in rows on a shaken tray, go to a hole in turn, and fall.
import { encodeRecording } from './encoder.mjs';

const unit = 2e-5;       // m
const angleUnit = 1e-3;  // rad
const quaternionUnit = 1e-4;
const gravity = 9.81;    // m/s2
const duration = 2;      // s
const window = [0.5, 2];
const dropAfter = 0.12;  // s, from a seed's place to its hole
const amplitude = 0.008;  // m, of the shaking
const frequency = 5;     // Hz

const clump = [[-1.3, 1.1], [0, 1.4], [1.3, 1.1]].map(([x_mm, radius_mm]) => ({ x_mm, y_mm: 0, z_mm: 0, radius_mm }));
const reach = 2.4e-3;  // m, of the circle that holds it

const trays = {
  plane: { length: 0.3, holes: [0.06, 0.15, 0.24], half: 0.006, rows: 6, across: 1 },
  space: { length: 0.16, depth: 0.05, holes: [0.04, 0.08, 0.12], half: 0.006, rows: 4, across: 10 },
};

const hopper = { length: 0.05, holes: [0, 0.025] };

// Row above row, so many as hold them.
function placesOf(tray, count) {
  const pitch = 0.005;
  const row = [];
  for (let x = pitch; x < tray.length - pitch / 2; x += pitch) {
    for (let k = 0; k < tray.across; ++k) row.push([x, tray.depth ? (k + 0.5) * pitch : 0]);
  }
  return Array.from({ length: count ?? tray.rows * row.length }, (_, k) => {
    const [x, z] = row[k % row.length];
    return [x, (Math.floor(k / row.length) + 0.5) * pitch, z];
  });
}

function seeds(tray, count) {
  const places = placesOf(tray, count);
  const sizes = (lot) => (lot === 0 ? 2.2e-3 : reach);
  return places.map((place, id) => {
    const lot = id % 3 === 2 ? 1 : 0;
    const hole = tray.holes.reduce((best, x, k) => (Math.abs(x - place[0]) < Math.abs(tray.holes[best] - place[0]) ? k : best), 0);
    const leaves = 0.1 + ((id * 7919) % places.length) / places.length * 3;  // s; the last third stays
    return { id, lot, radius: sizes(lot), place, hole, leaves, through: leaves + dropAfter };
  });
}

function trayAt(time) {
  return [amplitude * Math.sin(2 * Math.PI * frequency * time), 0, 0, 0];
}

// Where a seed is; null once it has fallen out of sight.
function courseOf(seed, time, tray) {
  const shaken = trayAt(time)[0];
  const [x, y, z] = seed.place;
  const target = [tray.holes[seed.hole], 0, tray.depth ? tray.depth / 2 : 0];
  if (time < seed.leaves) return [x + shaken, y + 3e-4 * Math.abs(Math.sin(40 * time + seed.id)), z];
  if (time < seed.through) {
    const part = (time - seed.leaves) / dropAfter;
    return [x + (target[0] - x) * part + shaken, y * (1 - part), z + (target[2] - z) * part];
  }
  const falling = time - seed.through;
  const low = -0.5 * gravity * falling * falling;
  return low < -0.06 ? null : [target[0] + trayAt(seed.through)[0], low, target[2]];
}

function frameOf(all, time, tray, inSpace) {
  const poses = [trayAt(time), [0, 0, 0, 0]];
  const grains = all.flatMap((seed) => {
    const at = courseOf(seed, time, tray);
    if (!at) return [];
    const turned = seed.id + (time > seed.leaves ? 8 * (time - seed.leaves) : 0);
    const counts = at.map((value) => Math.round(value / unit));
    const values = inSpace
      ? [...counts, ...[Math.cos(turned / 2), 0, Math.sin(turned / 2), 0].map((part) => Math.round(part / quaternionUnit))]
      : [counts[0], counts[1], Math.round(turned / angleUnit)];
    return [{ id: seed.id, lot: seed.lot, radius: seed.radius, start: seed.place, values }];
  });
  return { time, poses, grains };
}

// Each waiting seed on the one below it, as heavy as what lies above; those of the lowest row on the floor.
function contactsOf({ grains }, all) {
  const rows = new Map(grains.map((grain, k) => [all[grain.id].place.map((value) => value.toFixed(4)).join(), k]));
  const contacts = { largest: 0.05, pairs: [], touches: [] };
  grains.forEach((grain, k) => {
    const { place: [x, y, z] } = all[grain.id];
    const below = rows.get([x, y - 0.005, z].map((value) => value.toFixed(4)).join());
    const force = Math.round(64 * Math.log10(6 / (6 - Math.min(5, Math.floor(y / 0.005))))) + (grain.id % 7) * 8;
    if (below !== undefined) contacts.pairs.push([Math.min(k, below), Math.max(k, below), force]);
    else if (y < 0.005) contacts.touches.push([k, [0, -100, 0], force]);
  });
  contacts.pairs.sort(([a, b], [c, d]) => a - c || b - d);
  return contacts;
}

// Denser below, and moving to the holes, fastest at the second.
function mapOf(tray) {
  const cell = 0.0066;
  const columns = Math.ceil(tray.length / cell), rows = 4;
  const cells = Array.from({ length: columns * rows }, (_, k) => {
    const [x, y] = [((k % columns) + 0.5) * cell, (Math.floor(k / columns) + 0.5) * cell];
    const hole = tray.holes.reduce((best, at) => (Math.abs(at - x) < Math.abs(best - x) ? at : best));
    const speed = (hole === tray.holes[1] ? 0.2 : 0.12) * Math.exp(-((x - hole) ** 2 + y * y) / (2 * 0.02 ** 2));
    const apart = Math.hypot(hole - x, y);
    return [0.8 - 6 * y - speed, (speed * (hole - x)) / apart, (-speed * y) / apart];
  });
  return { cell_m: cell, columns, rows, view: 'projection', looks: 211, from_s: window[0], to_s: window[1],
    packing: cells.map(([share]) => share), vx: cells.map(([, x]) => x), vy: cells.map(([, , y]) => y) };
}

function vesselsOf(tray, inSpace) {
  const mm = (metres) => Math.round(metres * 1e6) / 1000;
  const rims = [0, ...tray.holes.flatMap((x) => [x - tray.half, x + tray.half]), tray.length].map(mm);
  const floor = rims.flatMap((x, k) => (k % 2 ? [] : [{ points_mm: [[x, 0], [rims[k + 1], 0]] }]));
  const depth = inSpace ? { depth_mm: mm(tray.depth) } : {};
  const walls = [0, mm(tray.length)].map((x) => ({ points_mm: [[x, 0], [x, 60]] }));
  const gates = inSpace ? [] : [{ points_mm: [[rims[1], 0], [rims[2], 0]], opens_at_s: 0.1 }];
  const holes = tray.holes.map((x, k) => ({ number: k + 1, x_mm: mm(x), z_mm: depth.depth_mm ? depth.depth_mm / 2 : 0, half_x_mm: mm(tray.half), half_z_mm: mm(tray.half), round: inSpace }));
  const middle = mm(tray.length) / 2;
  return [
    { name: 'tray', length_mm: mm(tray.length), height_mm: 60, ...depth, lines: [...walls, ...floor, ...gates], holes },
    { name: 'hopper', length_mm: 50, height_mm: 40, ...depth, holes: [],
      lines: [{ points_mm: [[middle - 25, 85], [middle - 25, 70], [middle - 12, 45]] }, { points_mm: [[middle + 25, 85], [middle + 25, 70], [middle + 12, 45]] }] },
  ];
}

// As the program writes them: a floor with round holes, four walls of the tray, and a hopper that is a cone, with a gate that opens.
function facesOf(tray) {
  const [length, depth, height] = [tray.length, tray.depth, 0.06].map((metres) => metres * 1000);
  const plate = (at, e1, e2, size, more) => ({ at_mm: at, e1, e2, size_mm: size, ...more });
  const [x, y, z] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  const middle = [length / 2, 0, depth / 2];
  return {
    tray: [
      plate([0, 0, 0], z, x, [depth, length], { holes_mm: tray.holes.map((at) => [depth / 2, at * 1000, tray.half * 1000]) }),
      plate([0, 0, 0], y, z, [height, depth]), plate([length, 0, 0], z, y, [depth, height]),
      plate([0, 0, 0], x, y, [length, height]), plate([0, 0, depth], y, x, [height, length]),
    ],
    hopper: [
      { at_mm: middle, e1: z, e2: x, rims_mm: [[12, 45], [25, 70]], half_angle_rad: Math.PI },
      { at_mm: middle, e1: z, e2: x, rims_mm: [[0, 45], [12, 45]], half_angle_rad: Math.PI, opens_at_s: 1 },
    ],
  };
}

function holeFigures(events, count) {
  const span = window[1] - window[0];
  return Array.from({ length: count }, (_, k) => {
    const times = events.filter((event) => event.hole === k + 1).map((event) => event.time);
    const inside = times.filter((time) => time >= window[0] && time <= window[1]);
    const gaps = inside.slice(1).map((time, i) => time - inside[i]);
    const error = (1.96 * Math.sqrt(inside.length)) / span;
    return { hole: k + 1, counted: inside.length, counted_all: times.length, rate: inside.length / span, rate_low: inside.length / span - error,
      rate_high: inside.length / span + error, longest_pause_s: Math.max(...gaps) };
  });
}

/** What a page reads of a scene, as the program writes it. */
export function sceneOf(title, [ball, joined], count) {
  const motion = { kind: 'harmonic', direction_rad: 0, amplitude_m: amplitude, frequency_hz: frequency, phase_rad: 0 };
  return {
    title,
    lots: [{ name: ball, diameter_m: 4.4e-3, mass_kg: 4e-5, shape: 'ball', number_fraction: 2 / 3 },
      { name: joined, diameter_m: 2 * reach, mass_kg: 2.5e-5, shape: 'clump', number_fraction: 1 / 3, discs: clump.map(({ x_mm: x, radius_mm: radius }) => ({ x_m: x / 1000, y_m: 0, radius_m: radius / 1000 })) }],
    tray: { motion, fill: { count, packing: 'poured', keep: false }, rain: null }, hopper: { motion: null, fill: { count: 90, packing: 'poured', keep: true }, rain: null }, run: { duration_s: duration },
  };
}

/** data and recording of a run; `names` may replace texts: { title, lots }, { version } of the recording: 1 has no forces, and how many { seeds } there are. */
export function madeUpRun(space, names = {}) {
  const inSpace = space === 'three_dimensional';
  const tray = inSpace ? trays.space : trays.plane;
  const all = seeds(tray, names.seeds);
  const events = all.filter((seed) => seed.through <= duration).map((seed) => ({ time: seed.through, hole: seed.hole + 1, lot: seed.lot })).sort((a, b) => a.time - b.time);
  const times = Array.from({ length: inSpace ? 41 : 101 }, (_, k, all_ = inSpace ? 40 : 100) => (k * duration) / all_);
  const frames = times.map((time, k) => {
    const frame = frameOf(all, time, tray, inSpace);
    return k % 4 === 0 ? { ...frame, contacts: contactsOf(frame, all) } : frame;
  });
  const recording = encodeRecording({
    frames, map: mapOf(tray), hopperMap: mapOf(hopper), version: names.version, perBlock: 25, vessels: ['tray', 'hopper'],
    fields: inSpace ? ['x', 'y', 'z', 'qw', 'qx', 'qy', 'qz'] : ['x', 'y', 'angle'],
    units: inSpace ? [unit, unit, unit, ...Array(4).fill(quaternionUnit)] : [unit, unit, angleUnit],
  });
  const holes = holeFigures(events, tray.holes.length);
  const total = holes.reduce((sum, hole) => sum + hole.rate, 0);
  const lots = names.lots ?? ['wheat', 'wild oat'];
  const data = {
    kind: 'run', program: { name: 'vibrosow', version: '0.2.0' }, title: names.title ?? `A made-up run ${inSpace ? 'in space' : 'in the plane'}`, space,
    headline: `3 holes let out ${total.toFixed(0)} seeds/s in 1.5 s of measuring.`,
    ...(inSpace ? { expected: '6 g/s, expect 3 to 12 g/s until you weigh (95 %); of it chance 5 %, numerics 6.2 %, tolerance 2 %, model 54 %.' } : {}),
    remarks: [{ serious: false, text: 'this run is made up', what_to_do: 'do not use it' }], status: 'finished', end_time_s: duration, window_s: window,
    lots: [{ name: lots[0], diameter_mm: 4.4 }, { name: lots[1], diameter_mm: 2 * reach * 1000, discs: clump }],
    vessels: vesselsOf(tray, inSpace), faces: inSpace ? facesOf(tray) : {}, holes, rate_unit: 'seeds/s',
    hole_table: {
      columns: [{ name: 'hole', unit: '' }, { name: 'lot', unit: '' }, { name: 'grains', unit: '' }, { name: 'rate', unit: '1/s' }, { name: 'longest pause', unit: 's' }, { name: 'note', unit: '' }],
      rows: holes.map((hole) => [String(hole.hole), names.lots ? lots[0] : 'all', String(hole.counted), hole.rate.toPrecision(4), hole.longest_pause_s.toPrecision(3), '']),
    },
    unevenness: { sentence: 'The holes differ by no more than chance lets them.' },
    events: { time_s: events.map((event) => event.time), hole: events.map((event) => event.hole), lot: events.map((event) => event.lot) },
    effects: [{ name: 'friction', present: true, why: 'seeds and walls rub' }, { name: 'damping', present: true, why: 'impacts lose energy' }, { name: 'air', present: false, why: 'the drag on a seed is a hundredth of its weight' }],
    guard: 'The guard watched energy and overlap and found nothing.',
    settings: [{ name: 'step', value: '11.6 µs' }, { name: 'scheme', value: 'velocity Verlet' }, { name: 'law', value: 'elastic shell' }, { name: 'random seed', value: '1' }, { name: 'results version', value: '12' }],
    drill: inSpace ? { rows: [1, 2, 3].map((row) => ({ row, kg_per_ha: 180 + row, low: 170 + row, high: 190 + row })), sentence: 'At 8 km/h the drill sows 182 kg/ha.' } : null,
    scene: sceneOf(names.title ?? 'A made-up run', lots, all.length),
  };
  return { data, recording };
}

/** The template filled as the program fills it. */
export function fillTemplate(template, { data, recording }) {
  const json = JSON.stringify(data).replaceAll('<', '\\u003c');
  return template.replace('@REPORT_DATA@', () => json).replace('@RECORDING@', () => (recording ? recording.toString('base64') : ''));
}

// What colours a grain: its lot, its speed against the tray, the layer that it started in, or the forces on it.
import { layerScale, listColour, speedScale } from './colours.mjs';
import { forceOfGrains } from './contacts.mjs';
import { force, niceAbove, number } from './format.mjs';
import { toOwn } from './geometry.mjs';

const speedSteps = 16;
const layers = 10;
const forceSteps = 15;
const forceDecades = 3;

// Of each grain of a frame a number below 256.
function binsOf(ids, of) {
  const bins = new Uint8Array(ids.length);
  for (let k = 0; k < bins.length; ++k) bins[k] = of(ids[k], k);
  return bins;
}

function byLot(recording, data) {
  return {
    name: 'lot', text: 'Lot', bins: Math.max(1, data.lots.length),
    colours: (theme) => data.lots.map((_, k) => listColour(k, theme)),
    legend: { kind: 'names', names: data.lots.map((lot) => lot.name) },
    of: async (frame) => binsOf(frame.ids, (id) => recording.lots[id]),
  };
}

// Ends of ten layers with as many seeds each, by starting height (m): a bed and a hopper's filling both show stripes.
function layerEnds(recording) {
  const heights = [];
  recording.radii.forEach((radius, id) => { if (radius > 0) heights.push(recording.starts[3 * id + 1]); });
  heights.sort((a, b) => a - b);
  return Array.from({ length: layers + 1 }, (_, k) => heights[Math.min(heights.length - 1, Math.floor((k * heights.length) / layers))] ?? 0);
}

function byStart(recording) {
  const ends = layerEnds(recording);
  const layerOf = (height) => {
    let layer = 0;
    while (layer < layers - 1 && height >= ends[layer + 1]) ++layer;
    return layer;
  };
  const ofId = Uint8Array.from(recording.radii, (_, id) => layerOf(recording.starts[3 * id + 1]));
  return {
    name: 'start', text: 'Starting height', bins: layers, colours: (theme) => layerScale(layers, theme),
    legend: { kind: 'scale', low: `${number(ends[0] * 1000)} mm`, high: `${number(ends[layers] * 1000)} mm`, note: 'starting height, in ten layers of equally many seeds' },
    of: async (frame) => binsOf(frame.ids, (id) => ofId[id]),
  };
}

/** Speeds of a frame's grains in the tray's frame, m/s, by the difference from the frame before; of the first frame from the next. NaN of a grain that is in only one of them. */
export async function speeds(recording, index) {
  const other = index > 0 ? index - 1 : Math.min(1, recording.frames - 1);
  const [frame, beside] = await Promise.all([recording.frame(index), recording.frame(other)]);
  const placeOf = new Map();
  beside.ids.forEach((id, k) => placeOf.set(id, k));
  const tray = Math.max(0, recording.vessels.indexOf('tray'));
  const [here, there] = [recording.pose(index, tray), recording.pose(other, tray)];
  const seconds = Math.abs(recording.times[index] - recording.times[other]);
  const inSpace = recording.fields[2] === 'z';
  const mm = recording.units.map((unit) => unit * 1000);
  const own = (one, k, pose) => {
    const [x, y] = toOwn(pose, one.values[0][k] * mm[0], one.values[1][k] * mm[1]);
    return [x, y, inSpace ? one.values[2][k] * mm[2] - pose.z * 1000 : 0];
  };
  return Float64Array.from(frame.ids, (id, k) => {
    const was = placeOf.get(id);
    if (was === undefined || seconds === 0) return NaN;
    const a = own(frame, k, here), b = own(beside, was, there);
    return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) / 1000 / seconds;
  });
}

// The end of the scale: what 19 of 20 grains of some frames do not pass, rounded up.
async function topSpeed(recording) {
  const seen = [];
  const samples = Math.min(8, recording.frames);
  for (let k = 1; k <= samples; ++k) {
    const found = await speeds(recording, Math.floor((k * (recording.frames - 1)) / samples));
    seen.push(...found.filter((speed) => !Number.isNaN(speed)));
  }
  seen.sort((a, b) => a - b);
  return niceAbove(seen[Math.floor(0.95 * (seen.length - 1))] ?? 0);
}

async function bySpeed(recording) {
  const top = await topSpeed(recording);
  const bin = (speed) => Math.min(speedSteps - 1, Math.floor((speed / top) * speedSteps));
  return {
    name: 'speed', text: 'Speed', bins: speedSteps, colours: (theme) => speedScale(speedSteps, theme),
    legend: { kind: 'scale', low: '0', high: `${number(top)} m/s and more`, note: 'speed against the tray' },
    of: async (frame, index) => Uint8Array.from(await speeds(recording, index), (speed) => (Number.isNaN(speed) ? 0 : bin(speed))),
  };
}

/** Of each grain of one of forceFrames the sum of the normal forces on it, N. */
export async function forcesOn(recording, frame) {
  const [contacts, { ids }] = await Promise.all([recording.contacts(frame), recording.frame(frame)]);
  return forceOfGrains(contacts, ids.length);
}

// The end of the scale: what 99 of 100 grains of some frames do not pass, rounded up.
async function topForce(recording) {
  const kept = recording.forceFrames;
  const seen = [];
  const samples = Math.min(8, kept.length);
  for (let k = 1; k <= samples; ++k) {
    seen.push(...(await forcesOn(recording, kept[Math.floor((k * (kept.length - 1)) / samples)])).filter((sum) => sum > 0));
  }
  seen.sort((a, b) => a - b);
  return niceAbove(seen[Math.floor(0.99 * (seen.length - 1))] ?? 0);
}

async function byForce(recording) {
  const top = await topForce(recording), low = top / 10 ** forceDecades;
  const bin = (sum) => Math.min(forceSteps - 1, Math.max(0, Math.floor((forceSteps * Math.log10(sum / low)) / forceDecades)));
  return {
    name: 'force', text: 'Force', bins: forceSteps, colours: (theme) => speedScale(forceSteps, theme),
    legend: { kind: 'scale', low: `${force(low)} and less`, high: `${force(top)} and more`, note: 'sum of a seed’s normal forces, log scale' },
    of: async (_, index) => Uint8Array.from(await forcesOn(recording, index), (sum) => (sum > 0 ? bin(sum) : 0)),
  };
}

/** Ways to colour: [{ name, text, make, ofForces }], the last where forces are kept; `make` promises { bins, colours(theme), legend, of(frame, index) }. One `ofForces` colours the frames of forceFrames alone. */
export function colourings(recording, data) {
  const made = new Map();
  const once = (name, make) => () => made.get(name) ?? made.set(name, make()).get(name);
  return [
    { name: 'lot', text: 'Lot', make: once('lot', async () => byLot(recording, data)) },
    { name: 'speed', text: 'Speed', make: once('speed', () => bySpeed(recording)) },
    { name: 'start', text: 'Start', make: once('start', async () => byStart(recording)) },
    ...(recording.forceFrames.length ? [{ name: 'force', text: 'Force', ofForces: true, make: once('force', () => byForce(recording)) }] : []),
  ];
}

// A layout: what of a seeder the page lets one change. Lengths in m and angles in rad, as scenes have them; what the controls give
// and get is in mm and degrees. Layouts are never changed: every function gives a new one.
import { degreesOf, metresOf, mmOf, radiansOf, tenths } from './quantities.mjs';

export const asWritten = 'as-written';  // the accuracy of a seeder that names none

const gap = 1;            // mm of floor, at least, between two holes
const narrowest = 1;      // mm
const widest = 200;       // mm
const usualWidth = 12;    // mm, of the first hole of a tray without any
const mostHoles = 40;

const motionRanges = {
  frequency_hz: { least: 0.5, most: 60, step: 0.1 },
  amplitude_mm: { least: 0, most: 30, step: 0.1 },
  direction_degree: { least: -90, most: 90, step: 1 },
};

/** The layout that a seeder comes with. */
export function layoutOf(seeder) {
  const { tray, numerics } = seeder.scene;
  const harmonic = tray.motion?.kind === 'harmonic' ? tray.motion : null;
  return {
    seeder, crop: seeder.crop, accuracy: numerics.accuracy ?? asWritten,
    holes: tray.holes.map(({ centre_m, width_m, open_at_s }) => ({ centre_m, width_m, open_at_s })),
    motion: harmonic && { frequency_hz: harmonic.frequency_hz, amplitude_m: harmonic.amplitude_m, direction_rad: harmonic.direction_rad },
  };
}

/** The layout to begin with: the seeder's own, at draft accuracy where it can be, so that it moves while one looks. */
export function startOf(seeder) {
  const own = layoutOf(seeder);
  return { ...own, accuracy: accuraciesOf(seeder).includes('draft') ? 'draft' : own.accuracy };
}

/** Whether holes may be moved, added and taken away: a tray that turns over and over has none. */
export function hasFloor(seeder) {
  return seeder.scene.tray.motion?.kind !== 'turning';
}

/** The accuracies to choose from: the seeder's own too, and alone where it says its time step, which an accuracy would set. */
export function accuraciesOf(seeder) {
  const { accuracy: own = asWritten, dt_s: step } = seeder.scene.numerics;
  return [...new Set(step === undefined ? ['draft', 'design', own] : [own])];
}

function holding(range, value) {
  return { ...range, least: Math.min(range.least, value), most: Math.max(range.most, value) };
}

/** What the controls reach; the seeder's own values lie within. `motion` is null where it is not harmonic. */
export function rangesOf(seeder) {
  const own = layoutOf(seeder);
  const length = seeder.scene.tray.length_m * 1000;
  const widths = own.holes.map((hole) => hole.width_m * 1000);
  return {
    length_mm: length, holes: Math.max(mostHoles, own.holes.length),
    width_mm: { least: Math.min(narrowest, ...widths), most: Math.max(Math.min(widest, length), ...widths), step: 0.5 },
    motion: own.motion && {
      frequency_hz: holding(motionRanges.frequency_hz, own.motion.frequency_hz),
      amplitude_mm: holding(motionRanges.amplitude_mm, own.motion.amplitude_m * 1000),
      direction_degree: holding(motionRanges.direction_degree, degreesOf(own.motion.direction_rad)),
    },
  };
}

function within(value, low, high) {
  return Math.min(high, Math.max(low, value));
}

// Down to and up to a tenth of a millimetre; what lies on one stays.
function floorTenth(mm) {
  return Math.floor(mm * 10 + 1e-6) / 10;
}

function ceilTenth(mm) {
  return Math.ceil(mm * 10 - 1e-6) / 10;
}

function rims(hole) {
  return [(hole.centre_m - hole.width_m / 2) * 1000, (hole.centre_m + hole.width_m / 2) * 1000];
}

// The stretch of floor, mm, that hole k has to itself.
function strip(layout, k) {
  const { holes, seeder } = layout;
  const left = k > 0 ? rims(holes[k - 1])[1] + gap : 0;
  const right = k + 1 < holes.length ? rims(holes[k + 1])[0] - gap : seeder.scene.tray.length_m * 1000;
  return [left, right];
}

function withHole(layout, k, changes) {
  return { ...layout, holes: layout.holes.map((hole, i) => (i === k ? { ...hole, ...changes } : hole)) };
}

/** Where hole k can be moved to: [least, most], mm, of its centre. */
export function reachOf(layout, k) {
  const [left, right] = strip(layout, k);
  const half = layout.holes[k].width_m * 500;
  return [ceilTenth(left + half), floorTenth(right - half)];
}

/** Hole k at `mm` along the floor, or as near as its neighbours and the walls let it. */
export function moveHole(layout, k, mm) {
  const [low, high] = reachOf(layout, k);
  return low > high ? layout : withHole(layout, k, { centre_m: metresOf(within(tenths(mm), low, high)) });
}

function widestOf(layout, k) {
  const [left, right] = strip(layout, k);
  const centre = layout.holes[k].centre_m * 1000;
  return floorTenth(2 * Math.min(centre - left, right - centre));
}

/** Hole k `mm` wide, or as near to it as there is floor. */
export function widenHole(layout, k, mm) {
  const { least, most } = rangesOf(layout.seeder).width_mm;
  const width = Math.min(within(tenths(mm), least, most), widestOf(layout, k));
  return width < least ? layout : withHole(layout, k, { width_m: metresOf(width) });
}

// The largest width, mm, that all holes can have where they are.
function widestOfAll({ holes, seeder }) {
  const length = seeder.scene.tray.length_m * 1000;
  const centres = holes.map((hole) => hole.centre_m * 1000);
  const pitches = centres.slice(1).map((centre, k) => centre - centres[k] - gap);
  return floorTenth(Math.min(...pitches, ...centres.flatMap((centre) => [2 * centre, 2 * (length - centre)])));
}

/** Every hole `mm` wide, or as near to it as there is floor for the one with least room. */
export function widenAll(layout, mm) {
  const { least, most } = rangesOf(layout.seeder).width_mm;
  const width_m = metresOf(Math.max(least, Math.min(within(tenths(mm), least, most), widestOfAll(layout))));
  return { ...layout, holes: layout.holes.map((hole) => ({ ...hole, width_m })) };
}

/** The one width (mm) of all holes; null where they differ. */
export function commonWidth({ holes }) {
  return holes.length && holes.every((hole) => hole.width_m === holes[0].width_m) ? mmOf(holes[0].width_m) : null;
}

/** { layout, added } with a hole more in the middle of the longest stretch of floor, as wide as its left neighbour; null where there is no room. */
export function addHole(layout) {
  const { holes, seeder } = layout;
  if (holes.length >= rangesOf(seeder).holes) return null;
  const ends = [-gap, ...holes.flatMap(rims), seeder.scene.tray.length_m * 1000 + gap];
  const stretches = Array.from({ length: holes.length + 1 }, (_, k) => [ends[2 * k] + gap, ends[2 * k + 1] - gap]);
  const added = stretches.reduce((best, [left, right], k) => (right - left > stretches[best][1] - stretches[best][0] + 1e-6 ? k : best), 0);
  const like = holes[Math.max(0, added - 1)] ?? { width_m: metresOf(usualWidth), open_at_s: 0 };
  const [left, right] = stretches[added];
  if (right - left < like.width_m * 1000) return null;
  const hole = { ...like, centre_m: metresOf(Math.round((left + right) / 2)) };
  const [low, high] = rims(hole);
  if (low < left || high > right) hole.centre_m = metresOf(mmOf((left + right) / 2000));
  return { added, layout: { ...layout, holes: [...holes.slice(0, added), hole, ...holes.slice(added)] } };
}

/** Without hole k; the last one stays. */
export function removeHole(layout, k) {
  return layout.holes.length > 1 ? { ...layout, holes: layout.holes.filter((_, i) => i !== k) } : layout;
}

function evenRow({ holes, seeder }, count) {
  const length = seeder.scene.tray.length_m * 1000;
  const [first, last] = [holes[0].centre_m * 1000, holes[holes.length - 1].centre_m * 1000];
  if (count === 1) return { first: length / 2, pitch: 0 };
  if (holes.length === 1) return { first: length / (count + 1), pitch: length / (count + 1) };
  return { first, pitch: (last - first) / (count - 1) };
}

function widestIn(holes) {
  return Math.max(...holes.map((hole) => hole.width_m * 1000));
}

/** The most holes that `spreadHoles` has room for. */
export function mostInARow(layout) {
  let count = layout.holes.length;
  const fits = (n) => evenRow(layout, n).pitch >= widestIn(layout.holes) + gap;
  while (count < rangesOf(layout.seeder).holes && fits(count + 1)) ++count;
  return count;
}

/** `count` holes evenly spaced between the outermost ones of now (a single one: over the tray), as wide as the widest of now. */
export function spreadHoles(layout, count) {
  const wanted = within(Math.round(count), 1, mostInARow(layout));
  const { first, pitch } = evenRow(layout, wanted);
  const { open_at_s } = layout.holes[0];
  const width_m = metresOf(floorTenth(widestIn(layout.holes)));
  return { ...layout, holes: Array.from({ length: wanted }, (_, k) => ({ centre_m: metresOf(mmOf((first + k * pitch) / 1000)), width_m, open_at_s })) };
}

/** With other motion: { frequency_hz, amplitude_mm, direction_degree }, any of them, each within its range. */
export function withMotion(layout, changes) {
  const ranges = rangesOf(layout.seeder).motion;
  const inRange = (key) => within(changes[key], ranges[key].least, ranges[key].most);
  return {
    ...layout, motion: {
      frequency_hz: 'frequency_hz' in changes ? inRange('frequency_hz') : layout.motion.frequency_hz,
      amplitude_m: 'amplitude_mm' in changes ? metresOf(inRange('amplitude_mm')) : layout.motion.amplitude_m,
      direction_rad: 'direction_degree' in changes ? radiansOf(inRange('direction_degree')) : layout.motion.direction_rad,
    },
  };
}

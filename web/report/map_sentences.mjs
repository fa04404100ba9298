// What the maps of a run show, in words.
import { list, number } from './format.mjs';

/** Cells that seeds fill to less, in the mean, have no velocity to speak of. */
export const emptyShare = 0.05;

/** Speed by cell, m/s; NaN of nearly empty ones. */
export function speeds(map) {
  return Float32Array.from(map.packing, (share, k) => (share < emptyShare ? NaN : Math.hypot(map.vx[k], map.vy[k])));
}

function largest(values) {
  let best = -1;
  values.forEach((value, k) => { if (!Number.isNaN(value) && (best < 0 || value > values[best])) best = k; });
  return best;
}

// "at hole 3" for a cell that is no more than its edge beside an opening and three above it; else how far along and up.
function placeOf(map, k, vessel) {
  const cell = map.cell * 1000;
  const [x, y] = [((k % map.columns) + 0.5) * cell, (Math.floor(k / map.columns) + 0.5) * cell];
  const holes = (vessel.holes ?? []).filter((hole) => Math.abs(x - hole.x_mm) <= hole.half_x_mm + cell).map((hole) => hole.number);
  if (holes.length && y < 3 * cell) return `at ${holes.length === 1 ? 'hole' : 'holes'} ${list(holes.map(String))}`;
  return `${number(x)} mm from the left end and ${number(y)} mm over the floor`;
}

function direction(vx, vy) {
  if (Math.abs(vy) >= Math.abs(vx)) return vy < 0 ? 'down' : 'up';
  return vx < 0 ? 'to the left' : 'to the right';
}

/** What both maps of a vessel are of; `beside`: other vessels that are drawn with it; `isInHopper`: whether seeds were in a hopper, which has maps of its own. */
export function mapSentence(map, space, { name }, { beside = [], isInHopper = false } = {}) {
  const through = space === 'plane' ? '' : map.view === 'slice' ? ', of a slice through the middle of the depth' : ', through the whole depth';
  const drawnAtRest = beside.length ? ` The ${list(beside.map((vessel) => vessel.name))} is drawn where it stands while nothing shakes.` : '';
  const apart = !isInHopper ? '' : name === 'hopper' ? ' Of the seeds in the hopper alone.' : ' Seeds in the hopper are left out; they have maps of their own.';
  return `The mean of ${map.looks} looks from ${number(map.from)} to ${number(map.to)} s, in the ${name}’s own frame, in cells of ${number(map.cell * 1000)} mm${through}.${apart}${drawnAtRest}`;
}

export function packingSentence(map, vessel) {
  const k = largest(map.packing);
  if (k < 0 || !(map.packing[k] > 0)) return `The ${vessel.name} was empty.`;
  const full = [...map.packing].filter((share) => share >= map.packing[k] / 2);
  const mean = full.reduce((sum, share) => sum + share, 0) / full.length;
  return `Densest, ${number(map.packing[k], 2)}, ${placeOf(map, k, vessel)}; ${number(mean, 2)} in the mean of the cells that are at least half as dense.`;
}

export function velocitySentence(map, vessel) {
  const all = speeds(map);
  const k = largest(all);
  if (k < 0) return 'No cell held seeds for long enough to speak of a velocity.';
  return `Fastest, ${number(all[k], 2)} m/s ${direction(map.vx[k], map.vy[k])}, ${placeOf(map, k, vessel)}; cells that seeds fill to less than ${number(emptyShare)} are left out.`;
}

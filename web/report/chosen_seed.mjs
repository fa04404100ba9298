// What is told of a seed that was chosen.
import { forcesOn, speeds } from './colouring.mjs';
import { clock, force, number } from './format.mjs';

// Of the speed, where there is one.
async function speedOf(recording, seed, index) {
  const place = (await recording.frame(index)).ids.indexOf(seed);
  const speed = place < 0 ? NaN : (await speeds(recording, index))[place];
  return Number.isNaN(speed) ? '' : `${number(speed)} m/s against the tray`;
}

// Of the force on it, at the nearest moment whose forces are kept.
async function forceOf(recording, seed, index) {
  const kept = recording.nearestForces(index);
  if (kept === null) return '';
  const place = (await recording.frame(kept)).ids.indexOf(seed);
  if (place < 0) return '';
  const when = kept === index ? '' : ` at ${clock(recording.times[kept])}`;
  return `normal forces on it ${force((await forcesOn(recording, kept))[place])} together${when}`;
}

function startOf(recording, seed) {
  const [x, y, z] = recording.starts.subarray(3 * seed, 3 * seed + 3);
  return `it was put in at x ${number(x * 1000)} mm, height ${number(y * 1000)} mm, depth ${number(z * 1000)} mm`;
}

/** Seed `seed` of the frame `index`: its number, lot, speed, force, and where it came from. */
export async function seedSentence(recording, data, seed, { index }) {
  const parts = await Promise.all([speedOf(recording, seed, index), forceOf(recording, seed, index), startOf(recording, seed)]);
  const there = (await recording.frame(index)).ids.includes(seed) ? '' : ' (not here now)';
  return `Seed ${seed} of ${data.lots[recording.lots[seed]]?.name ?? 'an unknown lot'}${there}: ${parts.filter(Boolean).join('; ')}.`;
}

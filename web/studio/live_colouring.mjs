// What colours a seed of a simulation under way: its lot or its speed.
import { listColour, speedScale } from '../report/colours.mjs';
import { niceAbove, number } from '../report/format.mjs';

const speedSteps = 16;
const usualSpeed = 1;  // m/s, the scale's end where the tray's own speed is not known

function byLot({ lots }) {
  return {
    colours: (theme) => lots.map((_, k) => listColour(k, theme)), legend: { kind: 'names', names: lots.map((lot) => lot.name) },
    of: (frame) => frame.lot,
  };
}

// The scale ends at twice the tray's own highest speed, rounded up.
function bySpeed(_, motion) {
  const top = niceAbove(motion ? 4 * Math.PI * motion.frequency_hz * motion.amplitude_m || usualSpeed : usualSpeed);
  return {
    colours: (theme) => speedScale(speedSteps, theme), legend: { kind: 'scale', low: '0', high: `${number(top)} m/s and more`, note: 'speed' },
    of: (frame) => Uint8Array.from(frame.speed, (speed) => Math.min(speedSteps - 1, Math.floor((speed / top) * speedSteps))),
  };
}

/** Ways to colour; `make(prepared, motion)` gives { colours(theme), legend, of(frame) }. */
export const liveColourings = [{ text: 'Lot', make: byLot }, { text: 'Speed', make: bySpeed }];

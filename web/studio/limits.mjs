// What a page can simulate while someone waits for it.
import { number } from '../report/format.mjs';

const mostGrains = 20_000;
const mostGrainSteps = 5e10;

function words(grains) {
  return `${grains} seeds are more than the ${mostGrains} that a page can follow; vibrosow run simulates them.`;
}

function grainsOf({ tray, hopper }) {
  return [tray, hopper].reduce((sum, vessel) => sum + (vessel?.fill?.count ?? 0), 0);
}

/** Why a scene is not even prepared; empty where it may be. */
export function tooLarge(scene) {
  const grains = grainsOf(scene);
  return grains > mostGrains ? words(grains) : '';
}

/** Why a seeder that takes so many steps as it is written is not played; empty where it is. */
export function tooLongAsWritten({ scene, steps }) {
  return tooLong({ grains: grainsOf(scene), steps: steps ?? 0 });
}

/** Why a prepared scene is not played; empty where it is. */
export function tooLong({ grains, steps }) {
  if (grains > mostGrains) return words(grains);
  const billions = (grains * steps) / 1e9;
  if (billions <= mostGrainSteps / 1e9) return '';
  return `${grains} seeds in ${steps} steps, ${number(billions)} billion seed-steps, are more than the ${number(mostGrainSteps / 1e9)} billion that a page can simulate; vibrosow run does it.`;
}

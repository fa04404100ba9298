// Why a run does not go on with a change, in a few words: those of the core (src/simulation/live_run.hpp), by their names.

const obstacles = {
  seeds: 'other seeds', accuracy: 'another accuracy', holes: 'more or fewer holes', vessels: 'another tray', motion: 'the motion is not harmonic',
  stiffness: 'this shake needs stiffer seeds', plan: 'another plan of the run', 'given up': 'seeds stay in the way of a hole',
};

/** "Starts again: other seeds" */
export function startsAgain(obstacle) {
  return `Starts again: ${obstacles[obstacle] ?? 'it cannot go on'}`;
}

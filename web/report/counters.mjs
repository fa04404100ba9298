// How many seeds each hole has let out by a moment of the run.

/** `events`: time_s and hole of every seed, by time. Index 0 counts what was spilled. */
export class Counters {
  constructor(events, holes) {
    this.times = events.time_s;
    const numbers = [0, ...holes.map((hole) => hole.hole)];
    this.of = new Map(numbers.map((number) => [number, events.time_s.filter((_, k) => events.hole[k] === number)]));
  }

  /** Seeds of a hole until `time` (s), that moment with them. */
  until(hole, time) {
    const times = this.of.get(hole) ?? [];
    let low = 0, high = times.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (times[middle] <= time) low = middle + 1;
      else high = middle;
    }
    return low;
  }
}

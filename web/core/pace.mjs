// How far a run should be by the clock: simulated seconds a second at most, or as fast as it can.

const mostOwed = 100; // ms of the clock: a run that is later than that does not catch up with the rest

export class Pace {
  /** `pace`: simulated seconds a second at most; null: as fast as it can. From `now` (ms) and `simulated` (s). */
  constructor(pace, now, simulated) {
    Object.assign(this, { pace, began: now, simulated });
  }

  /** Simulated time (s) to be reached by `now`. */
  due(now) {
    return this.pace === null ? Infinity : this.simulated + (this.pace * (now - this.began)) / 1e3;
  }

  /** Of a run that is at `simulated` (s) only so much stays owed that it does not wait, if it is always too slow. */
  forgive(now, simulated) {
    if (this.pace === null) return;
    this.simulated -= Math.max(0, this.due(now) - simulated - (this.pace * mostOwed) / 1e3);
  }
}

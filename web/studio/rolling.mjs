// The rate of the last shakes, while a run goes on: of whole periods, so that it does not swing with the tray.

const longest = 1;    // s that the rate is of, at most, unless a shake takes longer
const shortest = 0.1; // s that it is of, at least, where nothing shakes to and fro
const z = 1.96;       // of a 95 % interval

/**
 * 95 % interval of the mean of a count, as if seeds came independently of each other: Byar's approximation of the exact interval
 * (Breslow, Day 1987, Statistical Methods in Cancer Research II, chapter 2).
 */
export function countInterval(count) {
  const end = (n, side) => n * (1 - 1 / (9 * n) + (side * z) / (3 * Math.sqrt(n))) ** 3;
  return { low: count > 0 ? end(count, -1) : 0, high: end(count + 1, 1) };
}

function rate(count, seconds) {
  const { low, high } = countInterval(count);
  return { seeds_per_s: count / seconds, low: low / seconds, high: high / seconds };
}

export class RollingRate {
  /** `period`: s of a shake; null of a tray that does not shake to and fro. `since`: s, when counting began. */
  constructor(period, since = 0) {
    Object.assign(this, { period, since });
    this.past = [];  // { time_s, counted }, from then on
  }

  /** Takes the counts at the holes of a moment, `counted`, which is later than those before. */
  take({ time_s, counted }) {
    const { past } = this;
    if (past.length && time_s <= past[past.length - 1].time_s) return;
    past.push({ time_s, counted });
    const reach = Math.max(longest, this.period ?? 0);
    while (past.length > 2 && past[1].time_s <= time_s - reach - 1e-9) past.shift();
  }

  // How long the window should be so long (s) after counting began, s; 0 before the first shake is over.
  wanted(time) {
    if (this.period === null) return time < shortest ? 0 : Math.min(time, longest);
    const most = Math.max(1, Math.floor(longest / this.period + 1e-9));
    return this.period * Math.min(most, Math.floor(time / this.period + 1e-9));
  }

  /** { shakes (null where none are told), from_s, until_s, holes: [{ hole, seeds_per_s, low, high }], all }; null before the first shake is over. */
  now() {
    const { past, period } = this;
    const last = past[past.length - 1];
    const wanted = last ? this.wanted(last.time_s - this.since) : 0;
    if (wanted === 0) return null;
    const first = past.reduce((best, one) => (Math.abs(last.time_s - wanted - one.time_s) < Math.abs(last.time_s - wanted - best.time_s) ? one : best));
    const seconds = last.time_s - first.time_s;
    const counts = last.counted.map((count, k) => count - first.counted[k]);
    return {
      shakes: period && Math.round(seconds / period), from_s: first.time_s, until_s: last.time_s,
      holes: counts.map((count, k) => ({ hole: k + 1, ...rate(count, seconds) })), all: rate(counts.reduce((sum, count) => sum + count, 0), seconds),
    };
  }
}

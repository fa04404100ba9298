// Error against cost: what a work-precision diagram says, as numbers and a sentence.
import { number } from './format.mjs';

/** The levels that have an error and a time, each with the ends of |error|: low is 0 where the interval holds 0. */
export function pointsOf(levels) {
  return levels.filter(({ error, cpu_s }) => error && cpu_s > 0).map((level) => {
    const size = Math.abs(level.error.percent), band = level.error.band ?? null;
    return { level, size, low: band === null ? null : Math.max(0, size - band), high: band === null ? null : size + band };
  });
}

/** Powers of ten that hold all positive `values`. */
export function decades(values) {
  const positive = values.filter((value) => value > 0);
  if (positive.length === 0) return [0.1, 10];
  const low = 10 ** Math.floor(Math.log10(Math.min(...positive)) + 1e-9), high = 10 ** Math.ceil(Math.log10(Math.max(...positive)) - 1e-9);
  return [low, high > low ? high : low * 10];
}

/** How many settings are shown to err less than wanted, and the quickest of these. */
export function precisionSentence(data, points) {
  if (points.length === 0) return 'No setting has both an error and a time.';
  const shown = points.filter(({ high }) => high !== null && high <= data.within_percent);
  const within = `${number(data.within_percent)} % of ${data.against}`;
  const slowest = Math.max(...points.map(({ level }) => level.cpu_s));
  if (shown.length === 0) return `None of ${points.length} settings is shown to err by less than ${within}.`;
  const quickest = shown.reduce((a, b) => (b.level.cpu_s < a.level.cpu_s ? b : a));
  return `${shown.length} of ${points.length} settings ${shown.length === 1 ? 'is' : 'are'} shown to err by less than ${within}; the quickest, setting ${quickest.level.number}, takes ${number(quickest.level.cpu_s)} s a run, the slowest of all ${number(slowest)} s.`;
}

// One sentence about the outflow of the holes.
import { duration, list, number } from './format.mjs';

/** From the data of the page: rates over the window, the longest pause and where. */
export function outflowSentence(data) {
  const [from, to] = data.window_s;
  const rated = data.holes.filter((hole) => Number.isFinite(hole.rate));
  if (rated.length === 0) return 'No hole has let out anything in the measured time.';
  const most = rated.reduce((a, b) => (b.rate > a.rate ? b : a)), least = rated.reduce((a, b) => (b.rate < a.rate ? b : a));
  const rate = (hole) => `${number(hole.rate)} ${data.rate_unit}`;
  const rates = rated.length === 1 ? `hole ${most.hole} let out ${rate(most)}` : `hole ${most.hole} let out most, ${rate(most)}, and hole ${least.hole} least, ${rate(least)}`;
  const paused = rated.filter((hole) => Number.isFinite(hole.longest_pause_s));
  const longest = paused.length ? paused.reduce((a, b) => (b.longest_pause_s > a.longest_pause_s ? b : a)) : null;
  const same = longest ? paused.filter((hole) => hole.longest_pause_s === longest.longest_pause_s).map((hole) => hole.hole) : [];
  const where = rated.length > 1 ? `, at ${same.length > 1 ? 'holes' : 'hole'} ${list(same)}` : '';
  const pause = longest ? `; the longest time without a seed was ${duration(longest.longest_pause_s)}${where}` : '';
  return `From ${number(from)} to ${number(to)} s ${rates}${pause}.`;
}

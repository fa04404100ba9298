// A decision and a search for a front, made up of the layouts of a made-up sweep.
import { notes } from '../../web/report/light.mjs';
import { madeUpSweep } from './made_up_sweep.mjs';

const asked = [{ name: 'goal', value: 'rate: mass flow, most' }, { name: 'wanted', value: 'confidence of 95 %' }];
const cost = ['Cost: 120 runs, 3 billion grain-steps.', 'The 12 runs of this command took 31.2 s, up to 2 side by side.'];
const rate = { name: 'rate_g_per_s', heading: 'g/s', unit: 'g/s', description: 'mass flow, most', has_interval: true, wanted: 'high' };
const power = { name: 'power_W_per_kg', unit: 'W/kg', description: 'greatest power, least', has_interval: true, wanted: 'low' };
const clogged = { name: 'clogged_percent', unit: '%', description: 'share of its runs that clogged', has_interval: false, words: 'clogged', wanted: 'low' };

function standingInDecision({ number, status }, isSure) {
  if (status !== 'ok') return { status: 'failed', standing: 'failed' };
  if (number % 5 === 0) return { status: 'misses the rate', standing: 'misses the rate' };
  if (!isSure) return { status: 'ok', standing: 'undecided' };
  return { status: 'ok', standing: number === 11 ? 'best' : number % 7 === 0 ? 'not shown to be worse' : 'worse' };
}

/** Layout 11 is the best, or with `isSure` false none is known to be. `names`: { title, layout } may replace texts. */
export function madeUpDecision(space, { isSure = true, ...names } = {}) {
  const { data } = madeUpSweep(space, 20, names);
  const layouts = data.layouts.map((layout) => ({
    ...layout, ...standingInDecision(layout, isSure), replicates: 3 + layout.number,
    means: { rate_g_per_s: layout.means.rate_g_per_s, clogged_percent: { mean: layout.number % 3, half_width: null } }, holes: [],
  }));
  return {
    data: {
      ...data, kind: 'decision', layouts, asked, cost, confidence: 'confidence of 95 %', figures: [{ ...rate, judged: true }, clogged],
      wanted: { figure: 'rate_g_per_s', low: 12, high: 16 }, headline: 'Layout 11 is the best: rate 13.4 ± 0.9 g/s.', remarks: notes(['That is no guarantee.', 'layout 4 failed: hole 3 lies beyond the rim']),
    },
    recording: null,
  };
}

function standingInSearch({ number, status }) {
  if (status !== 'ok') return { status: 'misses the rate', standing: 'misses the rate', first_by_means: false };
  const standing = number % 6 === 1 ? 'on the front' : number % 6 === 2 ? 'may be on the front' : 'dominated';
  return { status: 'ok', standing, first_by_means: standing === 'on the front', at_edge: number === 7 ? [1] : [] };
}

/** `goals`: 1 or 2 */
export function madeUpFront(space, { goals = 2, ...names } = {}) {
  const { data } = madeUpSweep(space, 20, names);
  const layouts = data.layouts.map((layout) => ({
    ...layout, ...standingInSearch(layout), holes: [],
    means: { rate_g_per_s: layout.means.rate_g_per_s, power_W_per_kg: { mean: 1 + ((layout.number * 37) % 19), half_width: null }, clogged_percent: { mean: 0, half_width: null } },
  }));
  const marked = [{ ...rate, goal: true }, ...(goals > 1 ? [{ ...power, goal: true }] : [])];
  return {
    data: {
      ...data, kind: 'front', layouts, asked, cost, figures: [...marked, clogged], headline: '3 layouts are on the front of rate and power.',
      remarks: notes(['That no better layout exists within the ranges is not promised.']),
    },
    recording: null,
  };
}

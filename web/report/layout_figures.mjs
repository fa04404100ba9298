// The figures of layouts: which there are, what a layout has of one, and how that is written.
import { number, plusMinus } from './format.mjs';
import { wordsOf } from './layout_words.mjs';

const misfit = {
  name: 'misfit_percent', unit: '%', has_interval: true, description: 'misfit to the measured outflow; empty without a measurement',
};

// Of these a tray should have little; of all others much.
const wantedLow = /(^|_)(cv|pause|spilled|misfit)(_|$)/;

/**
 * Those to choose from. The ends of a pooled figure's interval belong to it: they are not figures of their own, and stand
 * for it where no layout's value is resolved.
 */
export function figuresOf(data) {
  const names = new Set(data.figures.map((figure) => figure.name));
  const own = data.figures.flatMap((figure) => {
    const [, of, end] = /^(.*)_(low|high)$/.exec(figure.name) ?? [];
    if (!end || !names.has(`${of}_low`) || !names.has(`${of}_high`)) return [{ ...figure, with_ends: names.has(`${figure.name}_high`) }];
    if (end === 'low' || names.has(of)) return [];
    return [{ ...figure, name: of, description: 'too small to be resolved in any layout', with_ends: true }];
  });
  const known = data.layouts.some((layout) => layout.misfit_percent) ? [...own, misfit] : own;
  return known.map((figure) => ({ ...figure, words: figure.words ?? wordsOf(figure.name).words, wanted_low: figure.wanted ? figure.wanted === 'low' : wantedLow.test(figure.name) }));
}

/** As { words, unit }: "rate, g/s" */
export function titleOf({ words, unit }) {
  return unit ? `${words}, ${unit}` : words;
}

function endsOf(layout, { name }) {
  const [low, high] = ['low', 'high'].map((end) => layout.means[`${name}_${end}`]?.mean ?? null);
  return { low, high };
}

/**
 * { value, low, high, half_width, below }, or null without a value. Low and high: the 95 % interval, null where there is none.
 * `below`: the value is too small to be resolved and stands for 0; it lies below `high`.
 */
export function valueOf(layout, figure) {
  const given = figure.name === misfit.name ? layout.misfit_percent : layout.means[figure.name];
  const ends = figure.with_ends ? endsOf(layout, figure) : { low: null, high: null };
  const mean = given?.mean ?? null;
  if (mean === null) return ends.high === null ? null : { value: 0, low: ends.low ?? 0, high: ends.high, half_width: null, below: true };
  if (figure.with_ends) return { value: mean, ...ends, half_width: null, below: false };
  const half = given.half_width ?? null;
  return { value: mean, low: half === null ? null : mean - half, high: half === null ? null : mean + half, half_width: half, below: false };
}

/** "20.6 ± 1.2", "12.1 (9 to 15)", "below 4.2"; "–" without a value. */
export function textOf(value) {
  if (!value) return '–';
  if (value.below) return `below ${number(value.high)}`;
  if (value.half_width === null && value.low !== null && value.high !== null) return `${number(value.value)} (${number(value.low)} to ${number(value.high)})`;
  return plusMinus(value.value, value.half_width ?? NaN);
}

/** The same with the figure's unit. */
export function textWithUnit(value, figure) {
  const text = textOf(value);
  return figure.unit && value ? `${text} ${figure.unit}` : text;
}

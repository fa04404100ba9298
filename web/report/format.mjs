// Numbers as people read them, the same as on a terminal (src/report/number_text.hpp, tests/report/numbers.json): three significant
// digits unless told, never an exponent, thousands apart, and a space before the unit.

// The place of the first digit of `value` when it is rounded to `digits` of them.
function placeOf(value, digits) {
  return Number(Math.abs(value).toExponential(digits - 1).split('e')[1]);
}

// Rounded to a place, 10 ** place; from ten thousand on with its thousands apart.
function atPlace(value, place) {
  const unit = 10 ** Math.max(0, place);
  const whole = Math.sign(value) * Math.round(Math.abs(value) / unit) * unit;
  const [digits, decimals] = (place < 0 ? value.toFixed(Math.min(-place, 12)) : whole.toFixed(0)).split('.');
  const apart = digits.replace('-', '').length < 5 ? digits : digits.replace(/\B(?=(\d{3})+$)/g, '\u202f');
  return decimals ? `${apart}.${decimals}` : apart;
}

/** `value` to `digits` significant digits; "–" for what is not a number. */
export function number(value, digits = 3) {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  if (value === 0) return '0';
  const text = atPlace(value, placeOf(value, digits) - digits + 1);
  return text.includes('.') ? text.replace(/\.?0+$/, '') : text;
}

/** A length in mm: to a tenth of a millimetre, or finer where it is short. */
export function millimetres(mm) {
  return number(mm, Math.abs(mm) < 100 ? 3 : 4);
}

/** Seconds in the unit that suits them. */
export function duration(seconds) {
  if (seconds === null || seconds === undefined || !Number.isFinite(seconds)) return '–';
  const [unit, name] = [[1, 's'], [1e-3, 'ms']].find(([one]) => Math.abs(seconds) >= 0.1 * one || seconds === 0) ?? [1e-6, 'µs'];
  return `${number(seconds / unit)} ${name}`;
}

/** Newtons, or a thousandth or millionth of them. */
export function force(newtons) {
  if (newtons === 0) return '0 N';
  const [unit, factor] = [['N', 1], ['mN', 1e3], ['µN', 1e6]].find(([, times]) => newtons * times >= 1) ?? ['nN', 1e9];
  return `${number(newtons * factor)} ${unit}`;
}

/** A moment of the replay, always with two decimals, so that it does not jump about while it runs. */
export function clock(seconds) {
  return `${seconds.toFixed(2)} s`;
}

/** "1, 2 and 3" */
export function list(words) {
  return words.length < 2 ? words.join('') : `${words.slice(0, -1).join(', ')} and ${words[words.length - 1]}`;
}

/** `text` with a capital first, unless that is a key such as contact.friction, and an end; empty stays empty. */
export function sentence(text) {
  if (!text) return '';
  const first = /^[a-z_]+\.[a-z_]/.test(text) ? text[0] : text[0].toUpperCase();
  return first + text.slice(1) + (/[.!?]$/.test(text) ? '' : '.');
}

/** The next of 1, 2, 5, 10, 20 ... that is not below `value`; for the ends of scales. */
export function niceAbove(value) {
  if (!(value > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  return [1, 2, 5, 10].map((step) => step * power).find((step) => step >= value * (1 - 1e-9));
}

/** "19.2 ± 3.8": the interval's half width to two digits and the mean to the same place; without one, the mean alone. */
export function plusMinus(mean, halfWidth) {
  if (halfWidth === null || !Number.isFinite(halfWidth)) return number(mean);
  const rounding = 1e-9;  // what is left of equal values
  if (halfWidth <= rounding * Math.abs(mean)) return `${number(mean)} ± 0`;
  const place = placeOf(halfWidth, 2) - 1;
  return `${atPlace(mean, place)} ± ${atPlace(halfWidth, place)}`;
}

/** Round steps that cover low to high, about `count` of them: { low, high, step, ticks }. */
export function axisScale(low, high, count = 5) {
  const step = niceAbove((high - low) / count || Math.abs(high) / count || 1);
  const first = Math.floor(low / step + 1e-9), last = Math.max(first + 1, Math.ceil(high / step - 1e-9));
  const ticks = Array.from({ length: last - first + 1 }, (_, k) => Number(((first + k) * step).toPrecision(12)));
  return { low: ticks[0], high: ticks[ticks.length - 1], step, ticks };
}

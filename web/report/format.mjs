// Numbers as people read them: three significant digits unless told, never an exponent, and a space before the unit.

/** `value` to `digits` significant digits; "–" for what is not a number. */
export function number(value, digits = 3) {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  if (value === 0) return '0';
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(Math.abs(value))));
  const text = value.toFixed(Math.min(decimals, 12));
  return text.includes('.') ? text.replace(/\.?0+$/, '') : text;
}

/** Seconds, in milliseconds when they are fewer than a tenth. */
export function duration(seconds) {
  if (seconds === null || seconds === undefined || !Number.isFinite(seconds)) return '–';
  return Math.abs(seconds) < 0.1 && seconds !== 0 ? `${number(seconds * 1000)} ms` : `${number(seconds)} s`;
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

/** "19.2 ± 3.8": the interval's half width to two digits and the mean to the same decimals; without one, the mean alone. */
export function plusMinus(mean, halfWidth) {
  if (!Number.isFinite(halfWidth)) return number(mean, 4);
  if (halfWidth <= 0) return `${number(mean, 4)} ± 0`;
  const decimals = Math.min(12, Math.max(0, 1 - Math.floor(Math.log10(halfWidth))));
  return `${mean.toFixed(decimals)} ± ${halfWidth.toFixed(decimals)}`;
}

/** Round steps that cover low to high, about `count` of them: { low, high, step, ticks }. */
export function axisScale(low, high, count = 5) {
  const step = niceAbove((high - low) / count || Math.abs(high) / count || 1);
  const first = Math.floor(low / step + 1e-9), last = Math.max(first + 1, Math.ceil(high / step - 1e-9));
  const ticks = Array.from({ length: last - first + 1 }, (_, k) => Number(((first + k) * step).toPrecision(12)));
  return { low: ticks[0], high: ticks[ticks.length - 1], step, ticks };
}

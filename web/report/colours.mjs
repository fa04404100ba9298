// Colours of lots, holes and scales. Scales grow evenly in lightness, so that they also read in grey.

// Gold first; told apart by people with any colour vision: found so that the closest two differ by 13 (CIEDE2000) for each dichromat.
const ofLots = {
  light: ['#b27d0e', '#3a86c8', '#66875d', '#a33b22', '#6a3fa0', '#0e4a4f'],
  dark: ['#e4ac2f', '#007cfc', '#94d58d', '#d9694a', '#b79be0', '#e6f0ee'],
};

// Viridis (S. van der Walt, N. Smith), ten of its stops; batlow (F. Crameri), ten of its stops.
const viridis = ['#440154', '#482878', '#3e4a89', '#31688e', '#26828e', '#1f9e89', '#35b779', '#6ece58', '#b5de2b', '#fde725'];
const batlow = ['#011959', '#10375c', '#1c5a62', '#3c6d56', '#687b3e', '#9d892b', '#d29343', '#f8a17b', '#fdb7bc', '#faccfa'];

/** Red, green and blue of "#rrggbb", 0 to 255. */
export function channels(colour) {
  return [1, 3, 5].map((k) => parseInt(colour.slice(k, k + 2), 16));
}

function hex(values) {
  return `#${values.map((value) => Math.round(Math.min(255, Math.max(0, value))).toString(16).padStart(2, '0')).join('')}`;
}

/** Between two colours, `part` of the way. */
export function mix(from, to, part) {
  const a = channels(from), b = channels(to);
  return hex(a.map((value, k) => value + (b[k] - value) * part));
}

function along(stops, part) {
  const place = Math.min(1, Math.max(0, part)) * (stops.length - 1);
  const k = Math.min(stops.length - 2, Math.floor(place));
  return mix(stops[k], stops[k + 1], place - k);
}

// The end that would vanish into the paper is left out.
function scale(stops, count, theme) {
  const [from, to] = theme === 'dark' ? [0.14, 1] : [0, 0.9];
  return Array.from({ length: count }, (_, k) => along(stops, from + ((to - from) * k) / Math.max(1, count - 1)));
}

/** `count` colours from slow to fast. */
export function speedScale(count, theme) {
  return scale(viridis, count, theme);
}

/** `count` colours from low to high. */
export function layerScale(count, theme) {
  return scale(batlow, count, theme);
}

/** The colour of a lot or a hole, by its place in the list; they come round again after six. */
export function listColour(index, theme) {
  const colours = ofLots[theme];
  return colours[index % colours.length];
}

export const listColours = ofLots.light.length;

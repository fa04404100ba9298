// Colours that are told apart by people with any colour vision, and seen on what they lie on: computed from the style sheet's own values.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import test from 'node:test';
import { listColour, listColours } from '../../web/report/colours.mjs';

const leastDifference = 10;  // CIEDE2000 of any two colours of lots or holes
const leastContrast = 3;     // WCAG 2.2, 1.4.11, of what is not text
const leastOfText = 4.5;     // 1.4.3
const themes = ['light', 'dark'];

const linear = (value) => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4);
const linearOf = (colour) => [1, 3, 5].map((k) => linear(parseInt(colour.slice(k, k + 2), 16) / 255));
const times = (matrix, vector) => matrix.map((row) => row.reduce((sum, value, k) => sum + value * vector[k], 0));

// What dichromats see, in linear sRGB: G. M. Machado, M. M. Oliveira, L. A. F. Fernandes 2009, severity 1 (doi 10.1109/TVCG.2009.113).
const visions = {
  trichromat: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  protanope: [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
  deuteranope: [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.01182, 0.04294, 0.968881]],
  tritanope: [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.3039]],
};

// CIELAB of linear sRGB, white point D65 (IEC 61966-2-1, CIE 15).
const toXyz = [[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.072175], [0.0193339, 0.119192, 0.9503041]];
const white = [0.95047, 1, 1.08883];

function labOf(rgb) {
  const [x, y, z] = times(toXyz, rgb).map((value, k) => {
    const part = value / white[k];
    return part > 216 / 24389 ? Math.cbrt(part) : ((24389 / 27) * part + 16) / 116;
  });
  return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
}

const radians = (degree) => (degree * Math.PI) / 180;
const hueOf = (a, b) => (a === 0 && b === 0 ? 0 : (((Math.atan2(b, a) * 180) / Math.PI) + 360) % 360);

// CIEDE2000 of two colours of CIELAB, as G. Sharma, W. Wu, E. N. Dalal 2005 write it (doi 10.1002/col.20070).
function difference([l1, a1, b1], [l2, a2, b2]) {
  const g = (chroma) => 0.5 * (1 - Math.sqrt(chroma ** 7 / (chroma ** 7 + 25 ** 7)));
  const stretch = 1 + g((Math.hypot(a1, b1) + Math.hypot(a2, b2)) / 2);
  const [c1, c2] = [Math.hypot(stretch * a1, b1), Math.hypot(stretch * a2, b2)];
  const [h1, h2] = [hueOf(stretch * a1, b1), hueOf(stretch * a2, b2)];
  const grey = c1 * c2 === 0, apart = Math.abs(h1 - h2) > 180;
  const turn = grey ? 0 : h2 - h1 - (apart ? 360 * Math.sign(h2 - h1) : 0);
  const lightness = (l1 + l2) / 2, chroma = (c1 + c2) / 2;
  const hue = grey ? h1 + h2 : (h1 + h2 + (apart ? (h1 + h2 < 360 ? 360 : -360) : 0)) / 2;
  const weight = 1 - 0.17 * Math.cos(radians(hue - 30)) + 0.24 * Math.cos(radians(2 * hue)) + 0.32 * Math.cos(radians(3 * hue + 6)) - 0.2 * Math.cos(radians(4 * hue - 63));
  const dl = (l2 - l1) / (1 + (0.015 * (lightness - 50) ** 2) / Math.sqrt(20 + (lightness - 50) ** 2));
  const dc = (c2 - c1) / (1 + 0.045 * chroma);
  const dh = (2 * Math.sqrt(c1 * c2) * Math.sin(radians(turn / 2))) / (1 + 0.015 * chroma * weight);
  const rotation = -2 * Math.sqrt(chroma ** 7 / (chroma ** 7 + 25 ** 7)) * Math.sin(radians(60 * Math.exp(-(((hue - 275) / 25) ** 2))));
  return Math.sqrt(dl ** 2 + dc ** 2 + dh ** 2 + rotation * dc * dh);
}

function luminance(colour) {
  return times(toXyz, linearOf(colour))[1];
}

function contrast(a, b) {
  const [light, dark] = [luminance(a), luminance(b)].sort((one, other) => other - one);
  return (light + 0.05) / (dark + 0.05);
}

const sheet = readFileSync(new URL('../../web/report/style.css', import.meta.url), 'utf8');
const variables = Object.fromEntries(themes.map((theme) => {
  const block = (theme === 'light' ? /:root \{([^}]*)\}/ : /:root\[data-theme="dark"\] \{([^}]*)\}/).exec(sheet)[1];
  return [theme, Object.fromEntries([...block.matchAll(/--([\w-]+): (#[0-9a-f]{6})/g)].map(([, name, value]) => [name, value]))];
}));

test('differences of colours are those of the published pairs', () => {
  for (const [a, b, published] of [
    [[50, 2.6772, -79.7751], [50, 0, -82.7485], 2.0425], [[50, 2.49, -0.001], [50, -2.49, 0.0011], 7.2195], [[50, 2.5, 0], [73, 25, -18], 27.1492],
    [[60.2574, -34.0099, 36.2677], [60.4626, -34.1751, 39.4387], 1.2644], [[2.0776, 0.0795, -1.135], [0.9033, -0.0636, -0.5514], 0.9082],
  ]) assert.equal(difference(a, b).toFixed(4), published.toFixed(4));
});

for (const theme of themes) {
  test(`lots and holes are told apart by anybody, ${theme}`, () => {
    const colours = Array.from({ length: listColours }, (_, k) => listColour(k, theme));
    for (const [who, matrix] of Object.entries(visions)) {
      const seen = colours.map((colour) => labOf(times(matrix, linearOf(colour)).map((value) => Math.min(1, Math.max(0, value)))));
      const pairs = seen.flatMap((a, i) => seen.slice(0, i).map((b, j) => [difference(a, b), colours[i], colours[j]]));
      const [least, ...which] = pairs.reduce((a, b) => (b[0] < a[0] ? b : a));
      assert.ok(least > leastDifference, `${who}: ${which} differ by ${least.toFixed(1)}`);
    }
  });

  test(`what is no text is seen on paper and card, ${theme}`, () => {
    const { paper, card, ...rest } = variables[theme];
    const seen = [...['accent', 'bar', 'edge', 'wall', 'control', 'chain', 'good'].map((name) => [name, rest[name]]), ...Array.from({ length: listColours }, (_, k) => [`list ${k}`, listColour(k, theme)])];
    for (const [name, colour] of seen) {
      for (const below of [paper, card]) assert.ok(contrast(colour, below) >= leastContrast, `${name} ${colour} on ${below}: ${contrast(colour, below).toFixed(2)}`);
    }
  });

  test(`text is read, ${theme}`, () => {
    const { paper, card, window, accent, ...rest } = variables[theme];
    for (const [text, below] of [...['ink', 'muted', 'link'].flatMap((name) => [paper, card].map((one) => [rest[name], one])), [rest.ink, window], [rest['on-accent'], accent]]) {
      assert.ok(contrast(text, below) >= leastOfText, `${text} on ${below}: ${contrast(text, below).toFixed(2)}`);
    }
  });
}

test('no control has a border of the faint line', () => {
  for (const selector of ['.round', '.quiet', '.choice-row', 'select', '.number-field', '.link-field']) {
    const sheets = sheet + readFileSync(new URL('../../web/studio/style.css', import.meta.url), 'utf8');
    const rule = new RegExp(`^${selector.replace('.', '\\.')} \\{([^}]*)\\}`, 'm').exec(sheets)[1];
    assert.match(rule, /border: 1px solid var\(--control\)/, selector);
  }
});

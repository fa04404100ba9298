// Words for layouts, keys and figures, from the names that the program gives them.

// How the program ends the names of columns that have a unit (src/input/key_units.cpp), longest first.
const units = [
  ['kg_per_m3', 'kg/m³'], ['W_per_kg', 'W/kg'], ['g_per_min', 'g/min'], ['mm_per_s', 'mm/s'], ['km_per_h', 'km/h'], ['g_per_s', 'g/s'], ['m_per_s', 'm/s'],
  ['percent', '%'], ['degree', '°'], ['per_s', '1/s'], ['rpm', 'rpm'], ['MPa', 'MPa'], ['mN', 'mN'], ['mm', 'mm'], ['Hz', 'Hz'],
  ['g', 'g'], ['s', 's'],
];

const named = { cv: 'CV' };

/** "tray.holes.span_mm" -> { words: "span", unit: "mm" } */
export function wordsOf(name) {
  const last = name.split('.').pop();
  const [suffix, unit] = units.find(([end]) => last.endsWith(`_${end}`)) ?? ['', ''];
  const words = suffix ? last.slice(0, -suffix.length - 1) : last;
  return { words: words.split('_').map((word) => named[word] ?? word).join(' '), unit };
}

/** The words of every key; a key whose last word another has too keeps the word before it. */
export function keyWords(keys) {
  const short = keys.map(wordsOf);
  return short.map(({ words, unit }, k) => {
    const alone = short.filter((other) => other.words === words).length === 1;
    const before = keys[k].split('.').slice(-2, -1);
    return { words: alone ? words : [...before, words].join(' '), unit };
  });
}

/** "300 mm", "3°"; "–" for an empty value. */
export function withUnit(value, unit) {
  if (value === '') return '–';
  return `${value}${unit && unit !== '°' ? ' ' : ''}${unit}`;
}

/** "Layout 7 cannot be built: hole 3 lies beyond the rim." */
export function sentenceWithNote(what, note) {
  return note ? `${what}: ${note.replace(/\.$/, '')}.` : `${what}.`;
}

/** A layout's own name, else its values: "5 · 300 mm · 9 Hz". */
export function layoutName(data, layout) {
  const words = keyWords(data.keys);
  return layout.name || layout.values.map((value, k) => withUnit(value, words[k]?.unit ?? '')).join(' · ');
}

/** "layout 7 (5 · 300 mm)", or without the brackets where there is nothing to tell. */
export function layoutInSentence(data, layout) {
  const name = layoutName(data, layout);
  return name ? `layout ${layout.number} (${name})` : `layout ${layout.number}`;
}

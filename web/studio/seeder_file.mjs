// The seeder file of a layout, TOML: the seeder's own text with the keys replaced that the layout changes.
import { parse, stringify } from 'smol-toml';
import { asWritten, layoutOf } from './layout.mjs';
import { angleText, lengthText } from './quantities.mjs';
import { fillsOf, otherCrop } from './scene_edit.mjs';

// One value for all where they agree, as a file may have it.
function oneOrAll(values) {
  return values.every((value) => value === values[0]) ? values[0] : values;
}

function differ(before, now) {
  return JSON.stringify(before) !== JSON.stringify(now);
}

function saysDiameters(value) {
  return [value].flat().some((text) => typeof text === 'string' && text.includes('diameter'));
}

// A list in the file is one value a hole, and no longer fits another number of holes.
function isStale(written, before, now) {
  return differ(oneOrAll(before), oneOrAll(now)) || (Array.isArray(written) && before.length !== now.length);
}

function changeHoles(tree, layout, crop) {
  const own = layoutOf(layout.seeder).holes;
  const values = (holes, key) => holes.map((hole) => hole[key]);
  const holes = tree.tray.holes ?? {};
  const changed = [];
  if (differ(values(own, 'centre_m'), values(layout.holes, 'centre_m'))) {
    for (const key of ['count', 'span', 'pitch', 'centre']) delete holes[key];
    holes.at = layout.holes.map((hole) => lengthText(hole.centre_m));
    changed.push('places of the holes');
  }
  if (isStale(holes.width, values(own, 'width_m'), values(layout.holes, 'width_m')) || (crop && saysDiameters(holes.width))) {
    holes.width = oneOrAll(layout.holes.map((hole) => lengthText(hole.width_m)));
    changed.push('widths of the holes');
  }
  if (isStale(holes.open_at, values(own, 'open_at_s'), values(layout.holes, 'open_at_s'))) {
    holes.open_at = oneOrAll(layout.holes.map((hole) => `${hole.open_at_s} s`));
    changed.push('opening times of the holes');
  }
  if (changed.length) tree.tray.holes = holes;
  if (own.length !== layout.holes.length && Array.isArray(tree.drill?.hole_to_row)) {
    delete tree.drill.hole_to_row;
    changed.push('rows of the drill that the holes feed');
  }
  return changed;
}

function changeMotion(tree, layout) {
  const own = layoutOf(layout.seeder).motion;
  if (!layout.motion) return [];
  const texts = { frequency: ['frequency_hz', (hz) => `${hz} Hz`], amplitude: ['amplitude_m', lengthText], direction: ['direction_rad', angleText] };
  return Object.entries(texts).filter(([, [key]]) => layout.motion[key] !== own[key]).map(([name, [key, text]]) => {
    tree.tray.motion[name] = text(layout.motion[key]);
    return name;
  });
}

function changeCrop(tree, layout, crops) {
  const crop = otherCrop(layout, crops);
  if (!crop) return [];
  Object.assign(tree, structuredClone({ seeds: crop.toml.seeds, contact: crop.toml.contact }));
  const fills = fillsOf(layout, crops);
  for (const name of ['tray', 'hopper']) {
    if (fills[name] === undefined) continue;
    tree[name].fill.count = fills[name];
    delete tree[name].fill.height;  // whose count the page has made its own
  }
  const { hopper } = layout.seeder.scene;
  if (hopper && saysDiameters(tree.hopper.holes?.width)) tree.hopper.holes.width = oneOrAll(hopper.holes.map((hole) => lengthText(hole.width_m)));
  return ['crop'];
}

function changeAccuracy(tree, layout) {
  if (layout.accuracy === layoutOf(layout.seeder).accuracy) return [];
  if (layout.accuracy === asWritten) delete tree.accuracy;
  else tree.accuracy = layout.accuracy;
  return ['accuracy'];
}

// A comment of one line, whatever a title says.
function comment(text) {
  return `# ${text.replace(/[\u0000-\u001f\u007f]+/g, ' ')}\n`;
}

function cropText(layout, crops) {
  const crop = crops.find((one) => one.name === layout.crop);
  return crop ? `crop ${crop.name} (${crop.title})` : 'its own seeds';
}

/** The text of the file. Throws an Error for a seeder whose own text is not TOML. */
export function seederFile(layout, crops) {
  const { seeder } = layout;
  const tree = parse(seeder.toml);
  const changed = [
    ...changeAccuracy(tree, layout), ...changeCrop(tree, layout, crops), ...changeHoles(tree, layout, otherCrop(layout, crops)), ...changeMotion(tree, layout),
  ];
  return comment(`From the studio: the seeder ${seeder.name}, ${seeder.title || 'without a title'}; ${cropText(layout, crops)}.`)
    + comment(changed.length ? `Changed: ${changed.join(', ')}.` : 'Nothing is changed but how it is written.')
    + `${stringify(tree)}\n`;
}

/** A name for the file that any system takes. */
export function fileName({ seeder }) {
  return `${seeder.name.replace(/[^A-Za-z0-9._-]+/g, '-').replace(/^[.-]+/, '') || 'seeder'}.toml`;
}

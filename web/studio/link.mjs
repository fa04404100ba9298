// Layouts in the fragment of a link: JSON, deflated, as base64url. What a link says is checked before anything is made of it.
import { bytesOfBase64 } from '../report/page_data.mjs';
import { accuraciesOf, layoutOf, rangesOf } from './layout.mjs';
import { radiansOf } from './quantities.mjs';

const mark = '#s=';
const mostPacked = 64 * 1024;     // characters
const mostUnpacked = 256 * 1024;  // bytes
const mostText = 200;             // characters of a name or a title
const slack = 1e-9;               // of a range's ends, for what was rounded

function base64url(bytes) {
  let text = '';
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text).replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '');
}

function ownSeeder({ name, title, toml, crop, scene }) {
  return { name, title, toml, crop, scene };
}

function packed({ seeder, crop, accuracy, holes, motion }) {
  return { seeder: seeder.own ? ownSeeder(seeder) : seeder.name, crop, accuracy, holes, motion };
}

/** A text that is the same for the same layouts. */
export function textOfLayouts(layouts) {
  return JSON.stringify({ layouts: layouts.map(packed) });
}

/** The fragment, "#s=...", of one or two layouts. Throws an Error where they are too much for a link. */
export async function fragmentOf(layouts) {
  const bytes = new TextEncoder().encode(textOfLayouts(layouts));
  const stream = new Blob([bytes]).stream().pipeThrough(new CompressionStream('deflate-raw'));
  const text = base64url(new Uint8Array(await new Response(stream).arrayBuffer()));
  if (bytes.length > mostUnpacked || text.length > mostPacked) throw new Error('the seeder is too large for a link; save its file instead');
  return mark + text;
}

async function inflated(bytes) {
  const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate-raw')).getReader();
  const parts = [];
  let length = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return new Blob(parts).text();
    length += value.length;
    if (length > mostUnpacked) {
      await reader.cancel();
      throw new Error('it unpacks to more than 256 KB');
    }
    parts.push(value);
  }
}

async function readJson(text) {
  if (text.length > mostPacked) throw new Error('it is longer than 64 KB');
  if (!/^[A-Za-z0-9_-]+$/.test(text)) throw new Error('it is cut off or changed');
  let json;
  try {
    json = await inflated(bytesOfBase64(text.replaceAll('-', '+').replaceAll('_', '/')));
  } catch (error) {
    throw error.message.includes('256 KB') ? error : new Error('it is cut off or changed');
  }
  try {
    return JSON.parse(json);
  } catch {
    throw new Error('it is cut off or changed');
  }
}

function isObject(value) {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}

// An object of exactly these keys.
function keysOf(value, keys, what) {
  if (!isObject(value)) throw new Error(`${what} is not what it should be`);
  const unknown = Object.keys(value).find((key) => !keys.includes(key));
  if (unknown !== undefined) throw new Error(`it says something unknown about ${what}`);
  const missing = keys.find((key) => !Object.hasOwn(value, key));
  if (missing !== undefined) throw new Error(`it does not say the ${missing} of ${what}`);
  return value;
}

function textOf(value, most, what) {
  if (typeof value !== 'string' || value.length > most) throw new Error(`${what} is not a text of at most ${most} characters`);
  return value;
}

function numberOf(value, low, high, what) {
  if (typeof value !== 'number' || !(value >= low - slack && value <= high + slack)) throw new Error(`${what} is out of its range`);
  return value;
}

function oneOf(value, allowed, what) {
  if (!allowed.includes(value)) throw new Error(`${what} is none that this page has`);
  return value;
}

// What this page itself reads of a scene; all else is read, and refused, by the program.
function checkVessel(vessel, what) {
  const isVessel = isObject(vessel) && Array.isArray(vessel.holes) && vessel.holes.every(isObject);
  if (!isVessel) throw new Error(`${what} is not what it should be`);
  numberOf(vessel.length_m, 1e-3, 100, `the length of ${what}`);
  for (const hole of vessel.holes) for (const key of ['centre_m', 'width_m']) numberOf(hole[key], 0, 100, `a hole of ${what}`);
  for (const hole of vessel.holes) numberOf(hole.open_at_s, 0, 1e6, `a gate of ${what}`);
  if ((vessel.fill ?? null) !== null) numberOf(vessel.fill.count, 1, 1e9, `the fill of ${what}`);
}

function checkLot(lot) {
  if (!isObject(lot) || (lot.discs !== undefined && !(Array.isArray(lot.discs) && lot.discs.every(isObject)))) throw new Error('a lot is not what it should be');
  textOf(lot.name, mostText, "a lot's name");
  numberOf(lot.diameter_m, 1e-6, 1, "a lot's diameter");
  numberOf(lot.number_fraction, 0, 1, "a lot's fraction");
  for (const disc of lot.discs ?? []) for (const key of ['x_m', 'y_m', 'radius_m']) numberOf(disc[key], -1, 1, 'a disc of a seed');
}

function checkScene(scene) {
  if (!isObject(scene) || !Array.isArray(scene.lots) || !scene.lots.length || !isObject(scene.numerics) || !isObject(scene.run)) throw new Error('its scene is not one');
  if ((scene.space ?? 'plane') !== 'plane') throw new Error('its scene is in 3D, which this page only shows as recorded');
  scene.lots.forEach(checkLot);
  checkVessel(scene.tray, 'the tray');
  if (scene.hopper !== null && scene.hopper !== undefined) checkVessel(scene.hopper, 'the hopper');
  const { motion } = scene.tray;
  if (motion?.kind === 'harmonic') for (const key of ['frequency_hz', 'amplitude_m', 'direction_rad']) numberOf(motion[key], -1e6, 1e6, `the motion's ${key}`);
  return scene;
}

function seederOf(given, data) {
  if (typeof given === 'string') return oneOf(data.seeders.find((seeder) => seeder.name === given), data.seeders.filter((seeder) => seeder.live), 'its seeder');
  const own = keysOf(given, ['name', 'title', 'toml', 'crop', 'scene'], 'its seeder');
  textOf(own.name, mostText, "the seeder's name");
  textOf(own.title, mostText, "the seeder's title");
  textOf(own.toml, mostUnpacked, "the seeder's file");
  oneOf(own.crop, ['', ...data.crops.map((crop) => crop.name)], 'its crop');
  checkScene(own.scene);
  return { ...own, space: 'plane', live: true, why_not: '', own: true };
}

function checkHoles(holes, seeder) {
  const { length_mm: length, width_mm: width, holes: most } = rangesOf(seeder);
  if (!Array.isArray(holes) || holes.length > most) throw new Error('its holes are not what they should be');
  let end = -Infinity;
  return holes.map((given) => {
    const { centre_m, width_m, open_at_s } = keysOf(given, ['centre_m', 'width_m', 'open_at_s'], 'a hole');
    numberOf(width_m * 1000, width.least, width.most, 'the width of a hole');
    numberOf(centre_m * 1000, Math.max(0, end) + width_m * 500, length - width_m * 500, 'the place of a hole');
    end = (centre_m + width_m / 2) * 1000;
    return { centre_m, width_m, open_at_s: numberOf(open_at_s, 0, 1e6, 'the opening time of a hole') };
  });
}

function checkMotion(motion, seeder) {
  const ranges = rangesOf(seeder).motion;
  if (ranges === null) {
    if (motion !== null) throw new Error('its seeder has no motion to be changed');
    return null;
  }
  const { frequency_hz, amplitude_m, direction_rad } = keysOf(motion, ['frequency_hz', 'amplitude_m', 'direction_rad'], 'the motion');
  const [lowest, highest] = [ranges.direction_degree.least, ranges.direction_degree.most].map(radiansOf);
  numberOf(frequency_hz, ranges.frequency_hz.least, ranges.frequency_hz.most, 'the frequency');
  numberOf(amplitude_m * 1000, ranges.amplitude_mm.least, ranges.amplitude_mm.most, 'the amplitude');
  if (direction_rad !== layoutOf(seeder).motion.direction_rad) numberOf(direction_rad, lowest, highest, 'the direction');
  return { frequency_hz, amplitude_m, direction_rad };
}

function checkLayout(given, data) {
  const { seeder: named, crop, accuracy, holes, motion } = keysOf(given, ['seeder', 'crop', 'accuracy', 'holes', 'motion'], 'a layout');
  const seeder = seederOf(named, data);
  return {
    seeder, crop: oneOf(crop, [seeder.crop, ...data.crops.map((one) => one.name)], 'its crop'), accuracy: oneOf(accuracy, accuraciesOf(seeder), 'its accuracy'),
    holes: checkHoles(holes, seeder), motion: checkMotion(motion, seeder),
  };
}

/** Whether a fragment says that it holds layouts. */
export function isLink(fragment) {
  return fragment.startsWith(mark);
}

/** The layouts, one or two, of a fragment; null of one that holds none. Throws an Error that says what is wrong. */
export async function layoutsOf(fragment, data) {
  if (!isLink(fragment)) return null;
  const { layouts } = keysOf(await readJson(fragment.slice(mark.length)), ['layouts'], 'the page');
  if (!Array.isArray(layouts) || layouts.length < 1 || layouts.length > 2) throw new Error('it holds neither one layout nor two');
  return layouts.map((layout) => checkLayout(layout, data));
}

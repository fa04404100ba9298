// What a result was simulated of, in words: the seeds, the tray, its holes, how it is shaken, how it is filled.
import { different, stepOf } from './dimensions.mjs';
import { element } from './dom.mjs';
import { list, millimetres, number } from './format.mjs';

const gravity = 9.80665;  // m/s2
const mostPlaces = 6;     // that are named one by one
const level = 1e-6;       // rad
const order = ['Seeds', 'Mixture', 'Holes', 'Shaking', 'Level of seeds', 'Tray', 'Hopper'];

const mm = (metres) => millimetres(1e3 * metres);
const degrees = (radians) => number((radians * 180) / Math.PI);
const counted = (count, one, many = `${one}s`) => `${number(count, 6)} ${count === 1 ? one : many}`;

function lotWords({ name, diameter_m: diameter, mass_kg: mass, shape, discs, sizes, number_fraction: share }, isMixed) {
  const vary = sizes && sizes.distribution !== 'single' ? ', of several sizes' : '';
  const what = shape === 'clump' ? `${discs.length} joined ${discs.length === 1 ? 'ball' : 'balls'} within ${mm(diameter)} mm` : `balls of ${mm(diameter)} mm`;
  return `${name}: ${what}${vary}, ${number(1e6 * mass)} mg${isMixed ? `, ${number(100 * share)} % of the seeds` : ''}`;
}

/** "level", or which end is lower. */
export function tiltWords(tilt) {
  if (Math.abs(tilt) < level) return 'level';
  return `${degrees(Math.abs(tilt))}° steep, its ${tilt > 0 ? 'left' : 'right'} end lower`;
}

function trayWords({ length_mm: length, height_mm: height, depth_mm: depth, tilt_rad: tilt }, space) {
  const size = `${millimetres(length)} mm long, ${Number.isFinite(depth) ? `${millimetres(depth)} mm deep, ` : ''}${millimetres(height)} mm high`;
  return `${size}; ${tiltWords(tilt ?? 0)}${space === 'plane' ? '; simulated in 2D, as a slice one seed thick' : ''}`;
}

function holeKind({ half_x_mm: x, half_z_mm: z, round }, space) {
  if (round) return `round hole|round holes|${millimetres(2 * x)} mm`;
  return `slot|slots|${millimetres(2 * x)}${space === 'plane' || !(z > 0) ? '' : ` × ${millimetres(2 * z)}`} mm`;
}

// "5 slots of 12 mm", each kind by itself.
function kindWords(holes, space) {
  const kinds = new Map();
  for (const hole of holes) kinds.set(holeKind(hole, space), (kinds.get(holeKind(hole, space)) ?? 0) + 1);
  return list([...kinds].map(([kind, count]) => {
    const [one, many, size] = kind.split('|');
    return `${counted(count, one, many)} of ${size}`;
  }));
}

/** "5 slots of 12 mm, 90 mm apart" of a vessel's holes; of several kinds each. */
export function holeWords(holes, space) {
  if (holes.length === 0) return 'none';
  const places = different(holes.map(({ x_mm: x }) => x)), step = stepOf(places), rows = different(holes.map(({ z_mm: z }) => z)).length;
  const apart = step !== null ? `${millimetres(step)} mm apart` : places.length <= mostPlaces ? `at ${list(places.map((x) => millimetres(x)))} mm` : `from ${millimetres(places[0])} to ${millimetres(places[places.length - 1])} mm`;
  return `${kindWords(holes, space)}, ${apart}${rows > 1 ? `, in ${rows} rows` : ''}`;
}

function directionWords({ direction_rad: direction, across_rad: across = 0 }) {
  if (Math.abs(across) > level) return 'askew across the tray';
  const turn = Math.abs(((direction % Math.PI) + Math.PI) % Math.PI);
  if (turn < level || Math.PI - turn < level) return 'to and fro';
  return Math.abs(turn - Math.PI / 2) < level ? 'up and down' : `${degrees(turn)}° over the level`;
}

function harmonicWords(motion) {
  const peak = motion.amplitude_m * (2 * Math.PI * motion.frequency_hz) ** 2 / gravity;
  return `${number(motion.frequency_hz, 4)} Hz, ${mm(motion.amplitude_m)} mm to either side, ${directionWords(motion)}: ${number(peak)} g at most`;
}

const motionWords = {
  harmonic: harmonicWords,
  sum: ({ components }) => list(components.map(harmonicWords)),
  rocking: ({ frequency_hz: frequency, angle_rad: angle }) => `rocked at ${number(frequency, 4)} Hz, ${degrees(angle)}° to either side`,
  table: ({ time_s: times }) => `moved as a table of ${number(times[times.length - 1] - times[0])} s says`,
  turning: ({ angular_velocity_rad_per_s: speed }) => `turned at ${number((Math.abs(speed) * 30) / Math.PI, 4)} rpm`,
};

/** How a vessel of the scene moves: "9 Hz, 10 mm to either side, to and fro: 3.26 g at most". */
export function shakingWords(motion) {
  return motion ? motionWords[motion.kind](motion) : 'not shaken';
}

function fillWords({ fill, rain }) {
  const parts = [
    fill?.count > 0 ? `${counted(fill.count, 'seed')}${fill.keep ? ', kept topped up' : ''}` : null,
    rain ? `${number(rain.rate_per_s, 4)} seeds/s rain in` : null,
  ].filter(Boolean);
  return parts.join('; ') || 'empty at first';
}

/** [{ name, text }] of a scene (its JSON, or null where the page has none) and its vessels as they are drawn. */
export function inputRows({ scene, vessels, space }) {
  const tray = vessels.find(({ name }) => name === 'tray') ?? vessels[0], hopper = vessels.find((vessel) => vessel !== tray);
  const ofScene = scene?.lots && scene.tray ? [
    { name: scene.lots.length === 1 ? 'Seeds' : 'Mixture', text: scene.lots.map((lot) => lotWords(lot, scene.lots.length > 1)).join('; ') },
    { name: 'Shaking', text: shakingWords(scene.tray.motion) },
    { name: 'Level of seeds', text: `${fillWords(scene.tray)}${scene.hopper ? `; in the hopper ${fillWords(scene.hopper)}` : ''}` },
  ] : [];
  const ofVessels = tray ? [
    { name: 'Holes', text: holeWords(tray.holes, space) }, { name: 'Tray', text: trayWords(tray, space) },
    ...(hopper?.holes.length ? [{ name: 'Hopper', text: `over the tray, with ${kindWords(hopper.holes, space)}` }] : []),
  ] : [];
  return [...ofScene, ...ofVessels].sort((a, b) => order.indexOf(a.name) - order.indexOf(b.name));
}

/** The same as a list under a heading. */
export function inputList(inputs) {
  return element('div', { class: 'inputs' }, element('h2', {}, 'What was simulated'),
    element('dl', {}, inputRows(inputs).map(({ name, text }) => element('div', {}, element('dt', {}, name), element('dd', {}, text)))));
}

// The studio's data made up for tests: seeders as the program reads them, and the page with a made-up simulator in it.
import { fileURLToPath } from 'node:url';
import { makePage } from '../../web/make_page.mjs';

const contact = {
  law: 'elastic-shell', shell_compression: 3e-5, seed: { friction: 0.45, restitution: 0.5 }, wall: { friction: 0.36, restitution: 0.5 }, drag_kg_per_s: 0,
  rotation: true, friction_arm: 'contact-point',
};
const wheatLot = { name: 'wheat', diameter_m: 0.00357, mass_kg: 2.96e-5, shape: 'ball', number_fraction: 1 };
const soybeanLot = { name: 'soybean', diameter_m: 0.00714, mass_kg: 2.3e-4, shape: 'ball', number_fraction: 1 };
const guard = { warn_relative_overlap: 0.05, stop_relative_overlap: 0.5, energy_tolerance: 0.2 };
const numerics = { integrator: 'velocity-verlet', steps_per_contact: 20, allow_long_step: false };

const hole = (centre_m, width_m, open_at_s = 0) => ({ centre_m, width_m, open_at_s });

function vessel(changes) {
  return {
    left_m: 0, above_m: 0, length_m: 0.5, height_m: 0.12, tilt_rad: 0, funnel_rad: 0, depth_m: null, holes: [], pieces: [], box: true, sides: 'walls', fill: null,
    rain: null, motion: null, ...changes,
  };
}

export const wheatText = `# A tray.
title = "Wheat tray, five holes, fed from a hopper"

[seeds.wheat]
crop = "wheat"

[contact]
model = "wheat-steel"

[tray]
length = "50 cm"
height = "12 cm"
fill   = { count = 560, packing = "poured" }  # four layers

[tray.holes]
count = 5
width = "12 mm"
span  = "36 cm"

[tray.motion]
kind      = "harmonic"
direction = "0 degree"
amplitude = "1 cm"
frequency = "540 rpm"
ramp      = "0.2 s"

[hopper]
left   = "21 cm"
above  = "3 cm"
length = "8 cm"
height = "15 cm"
holes  = { at = ["4 cm"], width = "8 diameters" }
fill   = { count = 200, packing = "poured", keep = true }

[run]
duration     = "4 s"
measure_from = "1 s"

[drill]
row_spacing = "15 cm"
speed       = "8 km/h"
hole_to_row = [1, 1, 2, 2, 3]
`;

const wheatScene = {
  title: 'Wheat tray, five holes, fed from a hopper', lots: [wheatLot], contact,
  tray: vessel({
    holes: [0.07, 0.16, 0.25, 0.34, 0.43].map((centre) => hole(centre, 0.012)), fill: { count: 560, packing: 'poured', keep: false },
    motion: { kind: 'harmonic', direction_rad: 0, amplitude_m: 0.01, frequency_hz: 9, phase_rad: 0, ramp_s: 0.2, stop_s: null, stop_ramp_s: 0 },
  }),
  hopper: vessel({ left_m: 0.21, above_m: 0.03, length_m: 0.08, height_m: 0.15, holes: [hole(0.04, 0.02856)], fill: { count: 200, packing: 'poured', keep: true } }),
  numerics, guard, run: { duration_s: 4, measure_from_s: 1, count_below_m: 0.02, start: 'at-rest' },
};

const mixedText = `title = "Two lots that rock"
accuracy = "draft"

[seeds.grain]
diameter = "8 mm"
mass = "0.6 g"
number_fraction = 0.5

[seeds.stone]
diameter = "4 mm"
mass = "0.1 g"
number_fraction = 0.5

[contact]
shell_compression = 0.01

[tray]
length = "30 cm"
height = "10 cm"
fill   = { count = 120, packing = "layers" }

[tray.holes]
at      = ["10 cm", "20 cm"]
width   = ["3 diameters", "30 mm"]
open_at = ["0.5 s", "1 s"]

[tray.motion]
kind      = "rocking"
pivot     = ["15 cm", "0 cm"]
angle     = "4 degree"
frequency = "3 Hz"

[run]
duration = "2 s"
`;

const mixedScene = {
  title: 'Two lots that rock',
  lots: [{ name: 'grain', diameter_m: 0.008, mass_kg: 6e-4, shape: 'ball', number_fraction: 0.5 }, { name: 'stone', diameter_m: 0.004, mass_kg: 1e-4, shape: 'ball', number_fraction: 0.5 }],
  contact: { ...contact, shell_compression: 0.01 },
  tray: vessel({
    length_m: 0.3, height_m: 0.1, holes: [hole(0.1, 0.024, 0.5), hole(0.2, 0.03, 1)], fill: { count: 120, packing: 'layers', jitter: 1e-3, keep: false },
    motion: { kind: 'rocking', pivot_m: [0.15, 0], angle_rad: 0.07, frequency_hz: 3, ramp_s: 0, stop_s: null, stop_ramp_s: 0 },
  }),
  hopper: null, numerics: { accuracy: 'draft', ...numerics }, guard, run: { duration_s: 2, measure_from_s: 0, count_below_m: 0.02, start: 'at-rest' },
};

export const whyNot3d = 'A tray in space takes some fifty times as long as a page can give.';

/** `names` may replace texts: { title, lot }. */
export function madeUpStudio(names = {}) {
  const wheat = { name: 'wheat-tray', title: names.title ?? wheatScene.title, toml: wheatText, crop: 'wheat', space: 'plane', live: true, why_not: '', scene: structuredClone(wheatScene) };
  if (names.lot) wheat.scene.lots[0].name = names.lot;
  return {
    kind: 'studio', program: { name: 'vibrosow', version: '0.2.0' }, opened: 'wheat-tray',
    seeders: [
      wheat, { name: 'two-lots', title: mixedScene.title, toml: mixedText, crop: '', space: 'plane', live: true, why_not: '', scene: mixedScene },
      { name: 'wheat-tray-3d', title: 'Wheat tray in space', toml: '', crop: 'wheat', space: 'three_dimensional', live: false, why_not: whyNot3d, scene: {} },
    ],
    crops: [
      { name: 'wheat', title: 'Wheat', diameter_m: 0.00357, toml: { seeds: { wheat: { crop: 'wheat' } }, contact: { model: 'wheat-steel' } }, lots: [wheatLot], contact },
      { name: 'soybean', title: 'Soybean', diameter_m: 0.00714, toml: { seeds: { soybean: { crop: 'soybean' } }, contact: { model: 'soybean-steel' } }, lots: [soybeanLot],
        contact: { ...contact, shell_compression: 1e-4 } },
    ],
  };
}

const simulator = fileURLToPath(new URL('made_up_simulator.mjs', import.meta.url));

/** The studio's template with the made-up simulator in place of the real one. */
export function studioTemplate() {
  const plugin = { name: 'made-up simulator', setup: (build) => build.onResolve({ filter: /core\/simulator\.mjs$/ }, () => ({ path: simulator })) };
  return makePage('studio', { plugins: [plugin], markers: ['@STUDIO_DATA@'], parts: [['@SIMULATOR_SIMD@', ''], ['@SIMULATOR_SCALAR@', '']] });
}

/** The template filled as the program fills it. */
export function fillStudio(template, data) {
  return template.replace('@STUDIO_DATA@', () => JSON.stringify(data).replaceAll('<', '\\u003c'));
}

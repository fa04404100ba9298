// The scene of a layout: the seeder's own, with what the layout says in its place.
import { asWritten } from './layout.mjs';

const scanLines = 400;
const mostOfAFill = 5000;

// The length, m, of the line at x that lies in a clump's discs.
function chord(discs, x) {
  const spans = discs.filter((disc) => Math.abs(x - disc.x_m) < disc.radius_m)
    .map((disc) => [disc.y_m, Math.sqrt(disc.radius_m ** 2 - (x - disc.x_m) ** 2)]).map(([y, half]) => [y - half, y + half])
    .sort((a, b) => a[0] - b[0]);
  let length = 0, end = -Infinity;
  for (const [from, to] of spans) {
    length += Math.max(0, to - Math.max(from, end));
    end = Math.max(end, to);
  }
  return length;
}

/** The area (m2) of a seed of the lot as the plane sees it; of a clump overlaps count once. */
export function seedArea(lot) {
  if (!lot.discs?.length) return (Math.PI / 4) * lot.diameter_m ** 2;
  const left = Math.min(...lot.discs.map((disc) => disc.x_m - disc.radius_m)), right = Math.max(...lot.discs.map((disc) => disc.x_m + disc.radius_m));
  const step = (right - left) / scanLines;
  return Array.from({ length: scanLines }, (_, k) => step * chord(lot.discs, left + (k + 0.5) * step)).reduce((sum, area) => sum + area, 0);
}

function meanArea(lots) {
  return lots.reduce((sum, lot) => sum + lot.number_fraction * seedArea(lot), 0);
}

/** The crop that replaces the seeder's own seeds; null where the layout keeps those. */
export function otherCrop(layout, crops) {
  return layout.crop === layout.seeder.crop ? null : crops.find((crop) => crop.name === layout.crop);
}

/** Counts of the fills that make as deep beds of the layout's crop as the seeder's are: { tray, hopper }, undefined where there is no fill. */
export function fillsOf(layout, crops) {
  const { scene } = layout.seeder;
  const crop = otherCrop(layout, crops);
  const ratio = crop ? meanArea(scene.lots) / meanArea(crop.lots) : 1;
  const scaled = (fill) => fill && (crop ? Math.min(mostOfAFill, Math.max(1, Math.round(fill.count * ratio))) : fill.count);
  return { tray: scaled(scene.tray.fill ?? undefined), hopper: scaled(scene.hopper?.fill ?? undefined) };
}

function holesOf({ holes, seeder: { scene } }) {
  const own = scene.tray.holes;
  return holes.map((hole, k) => ({ ...(own[k] ?? own[own.length - 1]), ...hole }));
}

function vesselWith(vessel, count, changes = {}) {
  if (!vessel) return vessel;
  return { ...vessel, ...changes, fill: vessel.fill ? { ...vessel.fill, count } : vessel.fill };
}

/** The scene to simulate, an object; `crops` as the page's data have them. */
export function sceneOf(layout, crops) {
  const { scene } = layout.seeder;
  const crop = otherCrop(layout, crops);
  const fills = fillsOf(layout, crops);
  const { accuracy, ...numerics } = scene.numerics;
  const motion = layout.motion ? { motion: { ...scene.tray.motion, ...layout.motion } } : {};
  return {
    ...scene, ...(crop ? { lots: crop.lots, contact: crop.contact } : {}),
    tray: vesselWith(scene.tray, fills.tray, { holes: holesOf(layout), ...motion }), hopper: vesselWith(scene.hopper, fills.hopper),
    numerics: layout.accuracy === asWritten ? numerics : { accuracy: layout.accuracy, ...numerics },
  };
}

/** What a change of crop has kept, in one sentence; empty where the crop is the seeder's own. */
export function keptSentence(layout, crops) {
  const crop = otherCrop(layout, crops);
  if (!crop) return '';
  const fills = fillsOf(layout, crops), { tray, hopper } = layout.seeder.scene;
  const changed = [['tray', tray.fill?.count, fills.tray], ['hopper', hopper?.fill?.count, fills.hopper]].filter(([, before]) => before !== undefined)
    .map(([name, before, now]) => `${now} seeds in the ${name} instead of ${before}`);
  const beds = changed.length ? `, and the beds are as deep as they were: ${changed.join(', ')}` : '';
  return `Holes, motion and vessels are kept${beds}.`;
}

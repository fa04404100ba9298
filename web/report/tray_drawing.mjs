// A tray drawn to scale with its dimensions: from the side, and in space from above too. All layouts of a page are drawn to one scale.
import { aboveDimensions, dimensionRows, hopperDimensions, sideDimensions } from './dimensions.mjs';
import { element, shape } from './dom.mjs';
import { list } from './format.mjs';
import { floorAt, restPose, toLab } from './geometry.mjs';

const rims = 48;  // corners of a round hole

function fromTheSide(vessel) {
  const pose = restPose(vessel);
  return (vessel.lines ?? []).map((line) => ({ points: line.points_mm.map(([x, y]) => toLab(pose, x, y)), opens: typeof line.opens_at_s === 'number' }));
}

function fromAbove(vessel, corners) {
  const pose = restPose(vessel);
  return corners.map(([x, z, y = 0]) => [toLab(pose, x, y)[0], z + (vessel.at_mm?.[2] ?? 0)]);
}

function outlineAbove(vessel) {
  const { length_mm: length, depth_mm: depth } = vessel;
  return fromAbove(vessel, [[0, 0], [length, 0], [length, depth], [0, depth]]);
}

function holeAbove(vessel, hole) {
  const corners = hole.round
    ? Array.from({ length: rims }, (_, k) => [Math.cos((2 * Math.PI * k) / rims), Math.sin((2 * Math.PI * k) / rims)])
    : [[-1, -1], [1, -1], [1, 1], [-1, 1]];
  const floor = floorAt(vessel, hole);
  return fromAbove(vessel, corners.map(([a, b]) => [hole.x_mm + a * hole.half_x_mm, hole.z_mm + b * hole.half_z_mm, floor]));
}

function boxOf(points) {
  return points.reduce(([left, low, right, high], [x, y]) => [Math.min(left, x), Math.min(low, y), Math.max(right, x), Math.max(high, y)], [Infinity, Infinity, -Infinity, -Infinity]);
}

// mm: of a broad drawing a part of its width, of one that is narrow and high of its height, for that limits it then.
function textSize([left, low, right, high]) {
  return Math.max(0.034 * (right - left), 0.07 * (high - low));
}

// A place of a vessel's own frame in a picture, whose y goes down.
function placing(vessel) {
  return ([x, y]) => {
    const [a, b] = toLab(restPose(vessel), x, y);
    return [a, -b];
  };
}

function trayOf(vessels) {
  return vessels.find((vessel) => vessel.name === 'tray') ?? vessels[0];
}

/**
 * What every drawing of several trays has to hold: { side, above }, boxes [left, low, right, high] in mm, null where nothing is
 * drawn, and the lines of numbers under the holes. `trays`: the vessels of each.
 */
export function boxesOf(trays, space) {
  const vessels = trays.flat();
  const side = boxOf(vessels.flatMap((vessel) => fromTheSide(vessel).flatMap((line) => line.points)));
  const deep = space === 'plane' ? [] : vessels.filter((vessel) => Number.isFinite(vessel.depth_mm));
  const above = boxOf(deep.flatMap(outlineAbove));
  const lines = Math.max(0, ...trays.flatMap((tray) => holeLabels(tray, textSize(side)).map(({ line }) => line + 1)));
  return { lines, side: Number.isFinite(side[0]) ? side : null, above: Number.isFinite(above[0]) ? above : null };
}

function path(points, closed = false) {
  return `M${points.map(([x, y]) => `${x.toFixed(3)} ${(-y).toFixed(3)}`).join('L')}${closed ? 'Z' : ''}`;
}

// Numbers under the holes, [{ x, y, text, line }], in as many lines as they need to stay apart. Holes of one place along
// the tray share a label.
function holeLabels(vessels, size) {
  const tray = trayOf(vessels);
  const places = new Map();
  for (const hole of tray?.holes ?? []) {
    const [x, y] = toLab(restPose(tray), hole.x_mm, floorAt(tray, hole));
    const place = x.toFixed(1);
    if (!places.has(place)) places.set(place, { x, y, numbers: [] });
    places.get(place).numbers.push(hole.number);
  }
  const ends = [];
  return [...places.values()].sort((a, b) => a.x - b.x).map(({ x, y, numbers }) => {
    const text = numbers.join(', ');
    const half = 0.32 * size * text.length + 0.2 * size;
    let line = 0;
    while (ends[line] !== undefined && ends[line] > x - half) ++line;
    ends[line] = x + half;
    return { x, y, text, line };
  });
}

// `below` and `right`: mm for what stands beside the box.
function picture(name, [left, low, right, high], { below, right: beside }, parts) {
  const edge = 0.02 * (right - left);
  const view = [left - edge, -high - edge, right - left + 2 * edge + beside, high - low + 2 * edge + below];
  return shape('svg', { class: 'drawing', viewBox: view.map((value) => value.toFixed(2)).join(' '), role: 'img', 'aria-label': name }, parts);
}

const beside = (size) => 3.4 * size;

function sideView(name, vessels, box, labelLines) {
  const size = textSize(box), tray = trayOf(vessels);
  const lines = vessels.flatMap(fromTheSide).map(({ points, opens }) => shape('path', { class: opens ? 'wall gate' : 'wall', d: path(points) }));
  const numbers = tray.holes.map((hole) => hole.number);
  const said = `${name} from the side, to scale: ${numbers.length === 1 ? 'hole' : 'holes'} ${list(numbers.map(String))}`;
  const labels = holeLabels(vessels, size).map(({ x, y, text, line }) => shape('text', { x, y: -y + (1.2 + 1.1 * line) * size, 'font-size': size, 'text-anchor': 'middle' }, text));
  const below = (0.3 + 1.1 * labelLines) * size;
  const dimensions = [sideDimensions(tray, placing(tray), size, below), vessels.filter((vessel) => vessel !== tray).map((vessel) => hopperDimensions(tray, vessel, placing(vessel), size))];
  return picture(said, box, { below: below + (1.5 * dimensionRows(vessels) + 0.6) * size, right: beside(size) }, [dimensions, ...lines, ...labels]);
}

function aboveView(name, vessels, box) {
  const deep = vessels.filter((vessel) => Number.isFinite(vessel.depth_mm));
  const tray = trayOf(deep);
  if (!tray) return null;
  const size = textSize(box);
  const parts = deep.map((vessel) => shape('path', { class: vessel === tray ? 'wall' : 'wall over', d: path(outlineAbove(vessel), true) }));
  const holes = tray.holes.map((hole) => shape('path', { class: 'hole', d: path(holeAbove(tray, hole), true) }));
  const labels = tray.holes.map((hole) => {
    const [[x, z]] = fromAbove(tray, [[hole.x_mm, hole.z_mm - hole.half_z_mm]]);
    return shape('text', { x, y: -z + size, 'font-size': 0.9 * size, 'text-anchor': 'middle' }, String(hole.number));
  });
  const place = ([x, z]) => fromAbove(tray, [[x, z]]).map(([a, b]) => [a, -b])[0];
  return picture(`${name} from above, to scale; the front is below`, box, { below: 0.5 * size, right: beside(size) }, [aboveDimensions(tray, place, size), ...parts, ...holes, ...labels]);
}

/** The drawings of a tray and what stands over it, in the boxes of boxesOf; a sentence where there is nothing to draw. `name`: what it is, such as "Layout 7". */
export function trayDrawing(name, vessels, boxes) {
  if (vessels.length === 0 || !boxes.side) return element('p', { class: 'muted' }, 'This layout cannot be built, so there is nothing to draw.');
  const above = boxes.above ? aboveView(name, vessels, boxes.above) : null;
  const dashed = vessels.some((vessel) => fromTheSide(vessel).some((line) => line.opens)) ? ' Dashed: gates, which open.' : '';
  return element('figure', { class: 'drawings' }, sideView(name, vessels, boxes.side, boxes.lines), above,
    element('figcaption', { class: 'muted' }, `${above ? 'From the side and from above' : 'From the side'}, to scale, in mm; the holes by their numbers.${dashed}${above && vessels.length > 1 ? ' Thin: the hopper above the tray.' : ''}`));
}

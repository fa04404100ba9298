// What of a run's map is of the tray. The map is in the tray's own frame, in which a hopper swings to and fro: its seeds smear through its
// walls there and say nothing of where they are.
import { toLab, toOwn } from './geometry.mjs';

const looks = 24;                  // frames at which the other vessels are looked for
const near = 0.001, far = 0.999;  // of a cell's side: a cell that only touches a wall is not covered

// Where walls cross the height y: [leftmost, rightmost], of a vessel's own frame.
function spanAt(vessel, y) {
  const crossings = (vessel.lines ?? []).flatMap(({ points_mm: points }) => points.slice(1).flatMap(([x1, y1], k) => {
    const [x0, y0] = points[k];
    return (y0 <= y) === (y1 <= y) ? [] : [x0 + ((x1 - x0) * (y - y0)) / (y1 - y0)];
  }));
  return crossings.length < 2 ? null : [Math.min(...crossings), Math.max(...crossings)];
}

function holds(vessel, x, y) {
  const span = spanAt(vessel, y);
  return span !== null && x >= span[0] && x <= span[1];
}

// For each look the places of the other vessels: [{ vessel, own(x, y) }], which takes a place of the tray's frame to the vessel's own.
function othersOf(vessels, recording) {
  const poseOf = (frame, { name }) => recording.pose(frame, recording.vessels.indexOf(name));
  const [tray, ...others] = vessels.filter(({ name }) => recording.vessels.includes(name));
  const count = Math.min(looks, recording.frames);
  const frames = Array.from({ length: count }, (_, k) => Math.floor((k * recording.frames) / count));
  return frames.flatMap((frame) => others.map((vessel) => ({
    vessel, own: (x, y) => toOwn(poseOf(frame, vessel), ...toLab(poseOf(frame, tray), x, y)),
  })));
}

/** The map without the cells that another vessel covers, wholly or in part, at some time; { map, leftOut: how many of those held seeds }. */
export function mapOfTray(map, vessels, recording) {
  const others = othersOf(vessels, recording);
  const side = map.cell * 1000;
  const covered = (k) => {
    const [left, low] = [(k % map.columns) * side, Math.floor(k / map.columns) * side];
    const corners = [[near, near], [far, near], [near, far], [far, far]].map(([x, y]) => [left + x * side, low + y * side]);
    return others.some(({ vessel, own }) => corners.some(([x, y]) => holds(vessel, ...own(x, y))));
  };
  const [packing, vx, vy] = [map.packing, map.vx, map.vy].map((values) => Float32Array.from(values));
  let leftOut = 0;
  map.packing.forEach((share, k) => {
    if (!(share > 0) || !covered(k)) return;
    packing[k] = 0, vx[k] = vy[k] = NaN;
    ++leftOut;
  });
  return { map: { ...map, packing, vx, vy }, leftOut };
}

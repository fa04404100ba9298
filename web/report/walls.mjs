// The faces of vessels in space as triangles and edges. Millimetres of the vessel's own frame.
import earcut from 'earcut';
import { floorAt } from './geometry.mjs';

const aRound = 64;        // pieces of a circle
const levelFrom = 0.87;   // of the upright part of a normal: steeper faces are walls, seen through
const flat = (points) => points.flat();

const cross = ([a, b, c], [x, y, z]) => [b * z - c * y, c * x - a * z, a * y - b * x];

// Along the vectors, so much of each.
function sum(at, ...parts) {
  return at.map((value, axis) => parts.reduce((all, [factor, vector]) => all + factor * vector[axis], value));
}

function circle(u, v, radius) {
  return Array.from({ length: aRound }, (_, k) => (2 * Math.PI * k) / aRound).map((angle) => [u + radius * Math.cos(angle), v + radius * Math.sin(angle)]);
}

function ringEdges(points) {
  return points.map((point, k) => [point, points[(k + 1) % points.length]]);
}

function plate({ at_mm: at, e1, e2, size_mm: [u, v], round, holes_mm: holes = [] }) {
  const outline = round ? circle(u / 2, v / 2, u / 2) : [[0, 0], [u, 0], [u, v], [0, v]];
  const rings = [outline, ...holes.map(([x, y, radius]) => circle(x, y, radius))];
  const starts = rings.map((_, k) => rings.slice(0, k).reduce((before, ring) => before + ring.length, 0));
  const points = rings.flat();
  const place = ([x, y]) => sum(at, [x, e1], [y, e2]);
  const normal = cross(e1, e2);
  return {
    points: points.map(place), normals: points.map(() => normal), corners: earcut(flat(points), starts.slice(1)),
    edges: rings.flatMap(ringEdges).map((edge) => edge.map(place)), level: Math.abs(normal[1]) > levelFrom,
  };
}

function revolved({ at_mm: at, e1, e2, rims_mm: [[radiusA, heightA], [radiusB, heightB]], half_angle_rad: half }) {
  const axis = cross(e1, e2), length = Math.hypot(radiusB - radiusA, heightB - heightA) || 1;
  const [out, along] = [(heightB - heightA) / length, (radiusA - radiusB) / length];  // of the normal
  const pieces = Math.max(4, Math.ceil((aRound * half) / Math.PI));
  const points = [], normals = [], corners = [], edges = [];
  for (let k = 0; k <= pieces; ++k) {
    const angle = half * ((2 * k) / pieces - 1);
    const direction = sum([0, 0, 0], [Math.cos(angle), e1], [Math.sin(angle), e2]);
    points.push(sum(at, [radiusA, direction], [heightA, axis]), sum(at, [radiusB, direction], [heightB, axis]));
    normals.push(...Array(2).fill(sum([0, 0, 0], [out, direction], [along, axis])));
    if (k === 0) continue;
    const now = 2 * k, before = now - 2;
    corners.push(before, now, before + 1, before + 1, now, now + 1);
    edges.push([points[before], points[now]], [points[before + 1], points[now + 1]]);
  }
  if (half < Math.PI * 0.999) edges.push([points[0], points[1]], [points.at(-2), points.at(-1)]);
  return { points, normals, corners, edges: edges.filter(([a, b]) => Math.hypot(...a.map((value, k) => value - b[k])) > 1e-9), level: Math.abs(along * axis[1]) > levelFrom };
}

// Of a page that was written without faces: the walls that the side shows, drawn out across.
function facesOfLines(vessel) {
  const depth = vessel.depth_mm ?? 0;
  return (vessel.lines ?? []).flatMap(({ points_mm: points, opens_at_s }) => points.slice(1).map(([x, y], k) => {
    const from = points[k], length = Math.hypot(x - from[0], y - from[1]) || 1;
    return { at_mm: [...from, 0], e1: [0, 0, 1], e2: [(x - from[0]) / length, (y - from[1]) / length, 0], size_mm: [depth, length], opens_at_s };
  }));
}

/** Walls of a vessel: { points, normals (three numbers each), opens (s, of each point), level (whether its face is), corners, edges: [{ from, to, opens }] }. */
export function wallsOf(vessel, faces = facesOfLines(vessel)) {
  const walls = { points: [], normals: [], opens: [], level: [], corners: [], edges: [] };
  for (const face of faces) {
    const opens = face.opens_at_s ?? Infinity, first = walls.points.length;
    const made = face.size_mm ? plate(face) : revolved(face);
    walls.points.push(...made.points);
    walls.normals.push(...made.normals);
    walls.corners.push(...made.corners.map((corner) => first + corner));
    walls.opens.push(...made.points.map(() => opens));
    walls.level.push(...made.points.map(() => made.level));
    walls.edges.push(...made.edges.map(([from, to]) => ({ from, to, opens })));
  }
  return walls;
}

/** Holes of a vessel in its own frame: [{ number, at, radius, rim }], mm. */
export function holesOf(vessel) {
  return (vessel?.holes ?? []).map((hole) => {
    const y = floorAt(vessel, hole);
    const rim = hole.round ? circle(hole.x_mm, hole.z_mm, hole.half_x_mm)
      : [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([a, b]) => [hole.x_mm + a * hole.half_x_mm, hole.z_mm + b * hole.half_z_mm]);
    return { number: hole.number, at: [hole.x_mm, y, hole.z_mm], radius: Math.max(hole.half_x_mm, hole.half_z_mm), rim: rim.map(([x, z]) => [x, y, z]) };
  });
}

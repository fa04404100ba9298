// Parts of the replay in space: where things are on the screen, and what walls and balls are made of.
import assert from 'node:assert/strict';
import test from 'node:test';
import { Balls } from '../../web/report/balls.mjs';
import { Between } from '../../web/report/between.mjs';
import { Camera } from '../../web/report/camera.mjs';
import { composed, inverse, placed } from '../../web/report/geometry.mjs';
import { poseAt } from '../../web/report/path.mjs';
import { Player } from '../../web/report/player.mjs';
import { lamp, seenByLamp } from '../../web/report/lamp.mjs';
import { wallsOf } from '../../web/report/walls.mjs';

const near = (a, b, slack = 1e-9) => a.forEach((value, k) => assert.ok(Math.abs(value - b[k]) <= slack, `${a} is not ${b}`));

function camera() {
  const made = new Camera({ left: 0, right: 200, low: -20, high: 80, front: 0, back: 60 }, [{ at: [50, 0, 30], radius: 6 }]);
  made.place(800, 500);
  return made;
}

test('each view shows its own axes, and all that there is', () => {
  const corners = [0, 200].flatMap((x) => [-20, 80].flatMap((y) => [0, 60].map((z) => [x, y, z])));
  const one = camera();
  for (const name of ['front', 'corner', 'above']) {
    one.look(name);
    one.place(800, 500);
    for (const at of corners) {
      const [x, y] = one.project(...at);
      assert.ok(x >= 0 && x <= 800 && y >= 0 && y <= 500, `${name}: ${at} is at ${x}, ${y}`);
    }
  }
  one.look('front');
  one.place(800, 500);
  const [x, y, toward] = one.project(100, 30, 30);
  near([x, y, toward], [400, 250, 0]);
  assert.ok(one.project(110, 30, 30)[0] > x && one.project(100, 40, 30)[1] < y && one.project(100, 30, 20)[2] > toward);
  one.look('above');
  assert.ok(one.project(100, 40, 30)[2] > 0 && one.project(100, 30, 40)[1] < 250);
  one.look('hole', 0);
  one.place(800, 500);
  near(one.project(50, 0, 30), [400, 250, 0]);
  assert.ok(one.project(50, -1, 30)[2] > 0);
});

test('what lies under the pointer stays there while it zooms', () => {
  const one = camera();
  one.orbit(0.4, 0.3);
  const at = [30, 20, 10];
  const before = one.project(...at);
  one.zoomBy(1.7, before[0], before[1]);
  near(one.project(...at).slice(0, 2), before.slice(0, 2), 1e-6);
  assert.ok(Math.abs(one.project(31, 20, 10)[0] - before[0]) > 1);
  const scale = one.scale;
  one.place(800, 500);
  assert.equal(one.scale, scale);
});

test('it moves by as many pixels as the pointer', () => {
  const one = camera();
  one.orbit(0.4, 0.3);
  const before = one.project(100, 30, 30);
  one.pan(12, -7);
  near(one.project(100, 30, 30).slice(0, 2), [before[0] + 12, before[1] - 7], 1e-6);
});

test('the lamp sees all that there is, along three axes at right angles, from where it stands as seen', () => {
  const one = camera();
  for (const [yaw, pitch] of [[0, 0], [0.7, 0.4], [2, -1.1], [0, Math.PI / 2]]) {
    Object.assign(one, { yaw, pitch });
    one.turn();
    const { right, up, toward, target, span } = seenByLamp(one);
    const dot = (a, b) => a.reduce((sum, value, axis) => sum + value * b[axis], 0);
    near([one.right, one.up, one.toward].map((axis) => dot(axis, toward)), lamp);
    near([dot(right, up), dot(right, toward), dot(up, toward), dot(right, right), dot(up, up)], [0, 0, 0, 1, 1]);
    for (const corner of [0, 200].flatMap((x) => [-20, 80].flatMap((y) => [0, 60].map((z) => [x, y, z])))) {
      const from = corner.map((value, axis) => value - target[axis]);
      [right, up, toward].forEach((axis, k) => assert.ok(Math.abs(dot(axis, from)) < span[k], `${corner} is outside`));
    }
  }
});

test('a pose and its inverse undo each other', () => {
  const pose = { x: 0.01, y: 0.02, z: -0.005, angle: 0.3 };
  near(placed(composed(inverse(pose), pose), [3, 4, 5]), [3, 4, 5]);
  near(placed(pose, placed(inverse(pose), [3, 4, 5])), [3, 4, 5]);
});

// Whether the point is in a triangle, all in one plane, by x and z.
function covered({ points, corners }, [x, z]) {
  const side = ([ax, , az], [bx, , bz]) => (bx - ax) * (z - az) - (bz - az) * (x - ax);
  return Array.from({ length: corners.length / 3 }, (_, k) => corners.slice(3 * k, 3 * k + 3).map((corner) => points[corner]))
    .some(([a, b, c]) => [side(a, b), side(b, c), side(c, a)].every((value, _, all) => value * all[0] > 0));
}

test('a floor is open at its round holes and nowhere else', () => {
  const floor = { at_mm: [0, 0, 0], e1: [0, 0, 1], e2: [1, 0, 0], size_mm: [50, 160], holes_mm: [[25, 40, 6], [20, 100, 9]] };
  const walls = wallsOf({}, [floor]);
  for (const [x, z, radius] of [[40, 25, 6], [100, 20, 9]]) {
    for (let angle = 0.1; angle < 6.2; angle += 0.37) {
      const at = (part) => [x + part * radius * Math.cos(angle), z + part * radius * Math.sin(angle)];
      assert.equal(covered(walls, at(0.95)), false);
      assert.equal(covered(walls, at(1.05)), true);
    }
  }
  assert.ok(walls.level.every(Boolean));
  assert.ok(walls.points.every(([, y]) => y === 0));
});

test('a cone goes round its axis from rim to rim, its normals at right angles to it, and a gate says when it opens', () => {
  const face = { at_mm: [10, 0, 20], e1: [0, 0, 1], e2: [1, 0, 0], rims_mm: [[4, 5], [12, 25]], half_angle_rad: Math.PI, opens_at_s: 0.5 };
  const { points, normals, opens, level } = wallsOf({}, [face]);
  points.forEach(([x, y, z], k) => {
    const radius = Math.hypot(x - 10, z - 20);
    near([radius], [4 + (8 * (y - 5)) / 20]);
    const along = [(8 / 20) * (x - 10) / radius, 1, (8 / 20) * (z - 20) / radius];
    near([normals[k].reduce((sum, value, axis) => sum + value * along[axis], 0)], [0]);
  });
  assert.ok(opens.every((time) => time === 0.5));
  assert.ok(!level.some(Boolean));
});

test('a clump is its balls, turned and in place', () => {
  const recording = { units: [1e-5, 1e-5, 1e-5, 1e-4, 1e-4, 1e-4, 1e-4], radii: [2e-3, 3e-3], lots: [0, 1], mostGrains: 2 };
  const lots = [{ discs: [{ x_mm: 1, y_mm: 0, z_mm: 0, radius_mm: 1 }, { x_mm: -1, y_mm: 0, z_mm: 0, radius_mm: 1 }] }, {}];
  const balls = new Balls(recording, lots);
  const half = Math.round(1e4 * Math.SQRT1_2);
  const columns = [[1000, 0], [2000, 0], [3000, 100], [half, 10000], [0, 0], [0, 0], [half, 0]];  // the first turned by a right angle about z
  balls.fill({ ids: [0, 1], values: columns });
  assert.equal(balls.count, 3);
  near([...balls.place.subarray(0, 12)], [10, 21, 30, 1, 10, 19, 30, 1, 0, 0, 1, 3], 1e-5);
  assert.deepEqual([...balls.grain.subarray(0, 3)], [0, 0, 1]);
});

// Ten frames of a tray that swings along by 4 mm, 2.5 frames a swing, with a seed that rides on it, one that rests in the lab, and one that falls and
// is gone after the seventh frame.
function swinging() {
  const unit = 1e-6, step = 0.04, swing = (time) => 4 * Math.sin((2 * Math.PI * time) / 0.1);
  const fall = (time) => 50 - 0.5 * 9810 * time * time * 0.01;
  const frames = Array.from({ length: 10 }, (_, frame) => {
    const time = frame * step;
    const at = [[20 + swing(time), 3, 5], [70, 90, 5], ...(frame < 7 ? [[40, fall(time), 5]] : [])];
    return { ids: at.map((__, id) => id), values: [0, 1, 2].map((axis) => at.map((place) => Math.round(place[axis] / 1e3 / unit))) };
  });
  const recording = {
    frames: frames.length, times: frames.map((_, k) => k * step), units: [unit, unit, unit], fields: ['x', 'y', 'z'], vessels: ['tray'],
    frame: async (k) => frames[k], pose: (k) => ({ x: swing(k * step) / 1e3, y: 0, z: 0, angle: 0 }),
  };
  const at = Array.from({ length: 400 }, (_, k) => [swing(k * 1e-3), 0, 0, 0]);
  return { recording, swing, fall, step, path: { step_s: 1e-3, at } };
}

test('between frames a seed that rides moves with the tray, one that rests stays, one that falls goes on falling', async () => {
  const { recording, swing, fall, step, path } = swinging();
  const between = new Between(recording);
  for (const index of [2, 3, 4, 5]) {
    for (const part of [0.1, 0.4, 0.5, 0.9]) {
      const time = (index + part) * step;
      const pose = poseAt(recording, 0, path, index, part);
      near([pose.x * 1e3], [swing(time)], 0.03);
      const { ids, values } = await between.frame(index, part, pose);
      assert.deepEqual([...ids], [0, 1, 2]);
      near([values[0][0], values[0][1], values[0][2]].map((count) => count / 1e3), [20 + swing(time), 70, 40], 0.04);
      near([values[1][2] / 1e3], [fall(time)], 0.1);
    }
  }
  const { values } = await between.frame(6, 0.5, poseAt(recording, 0, path, 6, 0.5));
  assert.ok(values[1][2] / 1e3 < fall(6 * step), 'what leaves has stopped');
});

test('without its path a vessel goes straight from frame to frame', () => {
  const { recording } = swinging();
  near([poseAt(recording, 0, undefined, 2, 0.25).x], [0.75 * recording.pose(2).x + 0.25 * recording.pose(3).x]);
  assert.deepEqual(poseAt(recording, 0, undefined, 2, 0), recording.pose(2));
});

test('a player that is smooth tells of every moment, and of its frames alone where it is not', () => {
  const ticks = [];
  globalThis.requestAnimationFrame = (tick) => ticks.push(tick);
  for (const [smooth, expected] of [[true, [0, 0.25, 0.75, 1]], [false, [0, 1]]]) {
    const player = new Player([0, 1, 2]);
    const told = [];
    Object.assign(player, { smooth });
    player.onChange(() => told.push(player.moment));
    player.play();
    for (const now of [0, 250, 750, 1000]) ticks.shift()(now);
    player.pause();
    ticks.length = 0;
    assert.deepEqual([...new Set(told)], expected);
  }
  delete globalThis.requestAnimationFrame;
});

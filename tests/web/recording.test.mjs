// The reader of recordings against an encoder of its own.
import assert from 'node:assert/strict';
import test from 'node:test';
import { decodeContacts, forceOfGrains } from '../../web/report/contacts.mjs';
import { openRecording, RecordingError } from '../../web/report/recording.mjs';
import { encodeRecording } from './encoder.mjs';

const fields = ['x', 'y', 'angle'];

// Grains come and go, one comes back, and values jump both ways and far.
function frames() {
  const present = [[0, 1, 2, 3], [0, 2, 3, 4], [2, 3, 4], [2, 3, 4, 1], [], [5, 2], [5, 2, 6]];
  return present.map((ids, k) => ({
    time: 0.125 * k,
    poses: [[0.01 * k, -0.02, 0, 0.1], [1, 2, 3, -k]],
    grains: ids.map((id) => ({
      id, lot: id % 2, radius: 0.5 * (id + 1), start: [id, -id, 0.25 * id],
      values: [100000 * id - 37 * k * k, -12 * id + (k % 2 ? 900000 : -900000), (id === 3 ? -1 : 1) * (k + 1)],
    })),
  }));
}

function encoded(perBlock, given = frames()) {
  return encodeRecording({ frames: given, fields, units: [1e-5, 1e-5, 1e-3], vessels: ['tray', 'hopper'], perBlock });
}

async function placesOf(recording, index) {
  const frame = await recording.frame(index);
  return new Map([...frame.ids].map((id, k) => [id, frame.values.map((values) => values[k])]));
}

for (const perBlock of [1, 3, 7]) {
  test(`every value comes back, with ${perBlock} frames in a block`, async () => {
    const recording = await openRecording(encoded(perBlock));
    const given = frames();
    assert.equal(recording.frames, given.length);
    for (const index of [6, 0, 3, 1, 5, 2, 4]) {
      assert.deepEqual(await placesOf(recording, index), new Map(given[index].grains.map((grain) => [grain.id, grain.values])));
    }
  });
}

test('the order of a frame: who stays keeps its place, who enters comes last', async () => {
  const recording = await openRecording(encoded(7));
  assert.deepEqual([...(await recording.frame(1)).ids], [0, 2, 3, 4]);
  assert.deepEqual([...(await recording.frame(3)).ids], [2, 3, 4, 1]);
});

test('times, poses, lots, radii and starts', async () => {
  const recording = await openRecording(encoded(3));
  assert.deepEqual([...recording.times], frames().map((frame) => frame.time));
  assert.deepEqual(recording.pose(4, 1), { x: 1, y: 2, z: 3, angle: -4 });
  assert.deepEqual([...recording.lots], [0, 1, 0, 1, 0, 1, 0]);
  assert.deepEqual([...recording.radii], [0.5, 1, 1.5, 2, 2.5, 3, 3.5]);
  assert.deepEqual([...recording.starts.subarray(9, 12)], [3, -3, 0.75]);
});

test('no bytes are no recording', async () => {
  assert.equal(await openRecording(new Uint8Array(0)), null);
});

test('what is not a recording, or is cut off, is refused', async () => {
  const bytes = encoded(3);
  await assert.rejects(openRecording(Buffer.from('VBSWREC9 and more')), RecordingError);
  await assert.rejects(openRecording(bytes.subarray(0, bytes.length - 1)), RecordingError);
  await assert.rejects(openRecording(bytes.subarray(0, 20)), RecordingError);
});

const contacts = { largest: 2, pairs: [[0, 1, 0], [0, 3, 64], [1, 2, 255]], touches: [[2, [-100, 50], 128], [3, [0, -127], 1]] };

function withContacts() {
  return frames().map((frame, k) => (k === 0 || k === 3 ? { ...frame, contacts } : frame));
}

test('contacts come back with their forces and places', async () => {
  const recording = await openRecording(encoded(3, withContacts()));
  assert.deepEqual(recording.forceFrames, [0, 3]);
  const read = await recording.contacts(3);
  assert.deepEqual([[...read.grain], [...read.partner], [...read.touched]], [[0, 0, 1], [1, 3, 2], [2, 3]]);
  [2, 0.2, 2 * 10 ** (-255 / 64)].forEach((force, k) => assert.ok(Math.abs(read.force[k] / force - 1) < 1e-12));
  assert.deepEqual(read.place.map((places) => [...places]), [[-1, 0], [0.5, -1.27]]);
  const sums = forceOfGrains(read, 4);
  const expected = [2.2, 2 + read.force[2], read.force[2] + 0.02, 0.2 + read.touch[1]];
  expected.forEach((sum, k) => assert.ok(Math.abs(sums[k] - sum) < 1e-12, `grain ${k}`));
});

test('the nearest frame with forces', async () => {
  const recording = await openRecording(encoded(3, withContacts()));
  assert.deepEqual([0, 1, 2, 3, 6].map((frame) => recording.nearestForces(frame)), [0, 0, 3, 3, 3]);
  assert.equal((await openRecording(encoded(3))).nearestForces(2), null);
});

test('contacts that are cut off or of grains that are not there are refused', async () => {
  const bad = frames();
  bad[4].contacts = contacts;  // a frame without grains
  await assert.rejects((await openRecording(encoded(3, bad))).contacts(4), /not there/);
  assert.throws(() => decodeContacts(new Uint8Array(17), 4, false), /cut off/);
});

test('maps come back, and a recording of the first version has none', async () => {
  const map = { cell_m: 0.006, columns: 2, rows: 1, view: 'projection', looks: 7, from_s: 1, to_s: 2, packing: [0.5, 0], vx: [0.25, NaN], vy: [-0.5, NaN] };
  const options = { frames: frames(), fields, units: [1e-5, 1e-5, 1e-3], vessels: ['tray', 'hopper'], perBlock: 3 };
  const hopperMap = { ...map, packing: [0.25, 0.75], vx: [0, 0.5], vy: [-1, 0.125] };
  const both = await openRecording(encodeRecording({ ...options, map, hopperMap }));
  for (const [vessel, given] of [['tray', map], ['hopper', hopperMap]]) {
    const { packing, vx, vy } = await both.map(vessel);
    assert.deepEqual([[...packing], [...vx], [...vy]], [given.packing, given.vx, given.vy]);
  }
  const read = await both.map();
  assert.deepEqual([read.cell, read.columns, read.looks, read.to], [0.006, 2, 7, 2]);
  const first = await openRecording(encodeRecording({ ...options, version: 1 }));
  assert.deepEqual([first.forceFrames, await first.map(), await first.map('hopper')], [[], null, null]);
});

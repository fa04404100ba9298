// Reads a recording of a run, VBSWREC1: quantised places of all grains, each frame as what differs from a straight
// course of the frames before; of some frames the contacts; and maps. Little-endian throughout; blocks of frames, contacts
// of a frame and maps are zlib streams that stand by themselves.
import { decodeContacts } from './contacts.mjs';

const magic = 'VBSWREC1';
const bytesOfPose = 4 * 8;
const bytesOfEntering = 4 + 2 + 4 + 3 * 4;
const valuesKept = 24e6;  // of decoded frames, 100 MB
const contactsKept = 8;   // frames

export class RecordingError extends Error {}

async function inflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function readHeader(bytes) {
  const name = String.fromCharCode(...bytes.subarray(0, magic.length));
  if (name !== magic || bytes.length < 12) throw new RecordingError(`it does not begin with ${magic}`);
  const length = new DataView(bytes.buffer, bytes.byteOffset).getUint32(magic.length, true);
  const end = magic.length + 4 + length;
  if (end > bytes.length) throw new RecordingError('its header is cut off');
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(magic.length + 4, end)));
  if (![1, 2].includes(header.version)) throw new RecordingError(`its version is ${header.version}; this page reads versions 1 and 2`);
  return { header, end };
}

// Calls visit(head) for each frame of an inflated block. `residuals` is where a frame's residuals begin.
function walkFrames(bytes, frames, vessels, fields, visit) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  let at = 0;
  for (let k = 0; k < frames; ++k) {
    const time = view.getFloat64(at, true);
    const poses = at + 8;
    const counts = poses + vessels * bytesOfPose;
    const leaving = view.getUint32(counts, true), entering = view.getUint32(counts + 4, true), present = view.getUint32(counts + 8, true);
    const left = counts + 12;
    const entered = left + 4 * leaving;
    const residuals = entered + bytesOfEntering * entering;
    at = residuals + 4 * fields * present;
    if (at > bytes.length) throw new RecordingError('a block of it is cut off');
    visit({ view, time, poses, leaving, entering, present, left, entered, residuals });
  }
}

// Which places of the list before stay, in their order.
function staying(head, before) {
  const kept = new Int32Array(before - head.leaving);
  let next = 0, leaver = 0;
  let gone = head.leaving > 0 ? head.view.getUint32(head.left, true) : -1;
  for (let k = 0; k < before; ++k) {
    if (k !== gone) kept[next++] = k;
    else gone = ++leaver < head.leaving ? head.view.getUint32(head.left + 4 * leaver, true) : -1;
  }
  return kept;
}

function residual(bytes, at, count) {
  const coded = bytes[at] | (bytes[at + count] << 8) | (bytes[at + 2 * count] << 16) | (bytes[at + 3 * count] << 24);
  return (coded >>> 1) ^ -(coded & 1);
}

// A frame from the one before it: { ids, values: [Int32Array of each field], older: the same one frame earlier, age }.
// `age` counts the frames of this block that hold a grain before this one: 0, 1 or 2.
function nextFrame(bytes, head, before, fields) {
  const kept = staying(head, before.ids.length);
  const count = head.present;
  if (kept.length + head.entering !== count) throw new RecordingError('its counts of grains do not agree');
  const ids = new Int32Array(count), age = new Uint8Array(count);
  for (let k = 0; k < kept.length; ++k) {
    ids[k] = before.ids[kept[k]];
    age[k] = Math.min(2, before.age[kept[k]] + 1);
  }
  for (let k = 0; k < head.entering; ++k) ids[kept.length + k] = head.view.getUint32(head.entered + k * bytesOfEntering, true);
  const values = [], older = [];
  for (let field = 0; field < fields; ++field) {
    const now = new Int32Array(count), last = new Int32Array(count);
    const from = head.residuals + field * 4 * count;
    for (let k = 0; k < count; ++k) {
      let predicted = 0;
      if (age[k] > 0) {
        last[k] = before.values[field][kept[k]];
        predicted = age[k] > 1 ? 2 * last[k] - before.older[field][kept[k]] : last[k];
      }
      now[k] = predicted + residual(bytes, from + k, count);
    }
    values.push(now);
    older.push(last);
  }
  return { ids, age, values, older };
}

function decodeBlock(bytes, frames, vessels, fields) {
  const nothing = Array.from({ length: fields }, () => new Int32Array(0));
  let before = { ids: new Int32Array(0), age: new Uint8Array(0), values: nothing, older: nothing };
  const decoded = [];
  walkFrames(bytes, frames, vessels, fields, (head) => {
    before = nextFrame(bytes, head, before, fields);
    decoded.push({ ids: before.ids, values: before.values });
  });
  return decoded;
}

class Recording {
  constructor(bytes, header, start) {
    this.bytes = bytes;
    this.header = header;
    this.start = start;
    this.frames = header.frames;
    this.fields = header.fields;
    this.units = header.field_units;
    this.vessels = header.vessels;
    this.times = new Float64Array(header.frames);                             // s
    this.poses = new Float64Array(header.frames * header.vessels.length * 4);  // x, y, z in m, angle in rad
    this.lots = new Uint16Array(header.grains);                               // of each id, as the next two
    this.radii = new Float32Array(header.grains);                             // m; 0 of an id that never enters
    this.starts = new Float32Array(3 * header.grains);                        // m
    this.mostGrains = 0;                                                      // in a frame
    this.forceFrames = (header.contacts ?? []).map(({ frame }) => frame);      // ascending
    this.keptContacts = new Map();
    this.blockFrom = [];
    this.kept = new Map();                                                    // decoded blocks, the latest used last
  }

  inflated({ offset, bytes }) {
    const from = this.start + offset;
    if (from + bytes > this.bytes.length) throw new RecordingError('it ends early');
    return inflate(this.bytes.subarray(from, from + bytes));
  }

  // Times, poses and what is said of a grain once, of all frames.
  async survey() {
    let frame = 0;
    for (let block = 0; block < this.header.blocks.length; ++block) {
      this.blockFrom.push(frame);
      walkFrames(await this.inflated(this.header.blocks[block]), this.header.blocks[block].frames, this.vessels.length, this.fields.length, (head) => this.note(frame++, head));
    }
    if (frame !== this.frames) throw new RecordingError(`it has ${frame} frames and says ${this.frames}`);
  }

  note(frame, { view, time, poses, entering, entered, present }) {
    this.times[frame] = time;
    this.mostGrains = Math.max(this.mostGrains, present);
    const values = this.vessels.length * 4;
    for (let k = 0; k < values; ++k) this.poses[frame * values + k] = view.getFloat64(poses + 8 * k, true);
    for (let k = 0; k < entering; ++k) {
      const at = entered + k * bytesOfEntering;
      const id = view.getUint32(at, true);
      if (id >= this.header.grains) throw new RecordingError('a grain has a number that is too large');
      this.lots[id] = view.getUint16(at + 4, true);
      this.radii[id] = view.getFloat32(at + 6, true);
      for (let axis = 0; axis < 3; ++axis) this.starts[3 * id + axis] = view.getFloat32(at + 10 + 4 * axis, true);
    }
  }

  blockOf(frame) {
    let block = this.blockFrom.length - 1;
    while (this.blockFrom[block] > frame) --block;
    return block;
  }

  block(index) {
    const known = this.kept.get(index);
    if (known) {
      this.kept.delete(index);
      this.kept.set(index, known);
      return known.decoded;
    }
    const frames = this.header.blocks[index].frames;
    const kept = { values: 0 };
    kept.decoded = this.inflated(this.header.blocks[index]).then((bytes) => {
      const decoded = decodeBlock(bytes, frames, this.vessels.length, this.fields.length);
      kept.values = decoded.reduce((sum, frame) => sum + frame.ids.length * (this.fields.length + 1), 0);
      this.forgetOld();
      return decoded;
    });
    this.kept.set(index, kept);
    return kept.decoded;
  }

  forgetOld() {
    let sum = [...this.kept.values()].reduce((values, one) => values + one.values, 0);
    for (const [index, one] of this.kept) {
      if (sum <= valuesKept || this.kept.size <= 2) return;
      sum -= one.values;
      this.kept.delete(index);
    }
  }

  /** A frame: ids of the grains there, and per field their counts of its unit. */
  async frame(index) {
    const block = this.blockOf(index);
    return (await this.block(block))[index - this.blockFrom[block]];
  }

  /** The frame nearest to a frame, in time, of those whose contacts are kept; null where none is. */
  nearestForces(index) {
    const far = (frame) => Math.abs(this.times[frame] - this.times[index]);
    return this.forceFrames.reduce((best, frame) => (best === null || far(frame) < far(best) ? frame : best), null);
  }

  /** The contacts of one of forceFrames, as decodeContacts has them. */
  contacts(index) {
    if (!this.keptContacts.has(index)) {
      const entry = this.header.contacts[this.forceFrames.indexOf(index)];
      const grains = this.frame(index).then((frame) => frame.ids.length);
      this.keptContacts.set(index, Promise.all([this.inflated(entry), grains])
        .then(([bytes, count]) => decodeContacts(bytes, count, this.fields.includes('z'))));
      if (this.keptContacts.size > contactsKept) this.keptContacts.delete(this.keptContacts.keys().next().value);
    }
    return this.keptContacts.get(index);
  }

  /** Packing fraction and velocity (m/s) by cell, rows from the floor, of what is in the "tray" or in the "hopper", in its own frame; null where the run kept none. */
  async map(vessel = 'tray') {
    const head = { tray: this.header.map, hopper: this.header.hopper_map }[vessel];
    if (!head) return null;
    const bytes = await this.inflated(head);
    const cells = head.columns * head.rows;
    if (bytes.length !== 3 * 4 * cells) throw new RecordingError('its maps are cut off');
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const [packing, vx, vy] = [0, 1, 2].map((k) => Float32Array.from({ length: cells }, (_, cell) => view.getFloat32(4 * (k * cells + cell), true)));
    return { cell: head.cell_m, columns: head.columns, rows: head.rows, view: head.view, looks: head.looks, from: head.from_s, to: head.to_s, packing, vx, vy };
  }

  /** Where a vessel was in a frame: x, y, z in m and angle in rad. */
  pose(index, vessel) {
    const at = (index * this.vessels.length + vessel) * 4;
    return { x: this.poses[at], y: this.poses[at + 1], z: this.poses[at + 2], angle: this.poses[at + 3] };
  }
}

/** Opens a recording; null of no bytes. Throws a RecordingError that says what is wrong with it. */
export async function openRecording(bytes) {
  if (bytes.length === 0) return null;
  const { header, end } = readHeader(bytes);
  const recording = new Recording(bytes, header, end);
  await recording.survey();
  return recording;
}

// Writes recordings as the program does, for tests: VBSWREC1.
import { deflateSync } from 'node:zlib';

class Bytes {
  constructor() {
    this.parts = [];
  }

  put(size, write, value) {
    const part = Buffer.alloc(size);
    part[write](value);
    this.parts.push(part);
  }

  double(value) { this.put(8, 'writeDoubleLE', value); }
  float(value) { this.put(4, 'writeFloatLE', value); }
  word(value) { this.put(4, 'writeUInt32LE', value); }
  half(value) { this.put(2, 'writeUInt16LE', value); }

  all() {
    return Buffer.concat(this.parts);
  }
}

const zigzag = (value) => ((value << 1) ^ (value >> 31)) >>> 0;

function planes(words) {
  const bytes = Buffer.alloc(4 * words.length);
  words.forEach((word, k) => { for (let plane = 0; plane < 4; ++plane) bytes[plane * words.length + k] = (word >>> (8 * plane)) & 255; });
  return bytes;
}

// `list`: ids in order; `history`: id -> its values in the last two frames of this block, the latest first.
function putFrame(bytes, { time, poses, grains }, list, history, fields) {
  const here = new Map(grains.map((grain) => [grain.id, grain]));
  const leaving = [...list.keys()].filter((k) => !here.has(list[k]));
  const stay = list.filter((id) => here.has(id));
  const entering = grains.filter((grain) => !stay.includes(grain.id));
  const now = [...stay, ...entering.map((grain) => grain.id)];
  bytes.double(time);
  poses.flat().forEach((value) => bytes.double(value));
  [leaving.length, entering.length, now.length].forEach((count) => bytes.word(count));
  leaving.forEach((k) => bytes.word(k));
  for (const grain of entering) {
    bytes.word(grain.id);
    bytes.half(grain.lot);
    [grain.radius, ...grain.start].forEach((value) => bytes.float(value));
    history.set(grain.id, []);
  }
  for (let field = 0; field < fields; ++field) {
    bytes.parts.push(planes(now.map((id) => {
      const [last, older] = history.get(id).map((values) => values[field]);
      const predicted = older !== undefined ? 2 * last - older : last ?? 0;
      return zigzag(here.get(id).values[field] - predicted);
    })));
  }
  for (const id of now) history.set(id, [here.get(id).values, ...history.get(id)].slice(0, 2));
  leaving.forEach((k) => history.delete(list[k]));
  return now;
}

function differences(places) {
  return places.map((place, k) => place - (k ? places[k - 1] : 0));
}

// `pairs`: [grain, partner, force code] and `touches`: [grain, place of each axis in 1/100, force code], grains as places in the list.
function contactBytes({ largest, pairs, touches }, axes) {
  const bytes = new Bytes();
  bytes.double(largest);
  [pairs.length, touches.length].forEach((count) => bytes.word(count));
  bytes.parts.push(planes(differences(pairs.map(([grain]) => grain))), planes(pairs.map(([grain, partner]) => partner - grain)),
    Buffer.from(pairs.map(([, , force]) => force)), planes(differences(touches.map(([grain]) => grain))));
  for (let axis = 0; axis < axes; ++axis) bytes.parts.push(Buffer.from(Int8Array.from(touches, ([, place]) => place[axis]).buffer));
  bytes.parts.push(Buffer.from(touches.map(([, , force]) => force)));
  return bytes.all();
}

function mapBytes({ packing, vx, vy }) {
  const bytes = new Bytes();
  [packing, vx, vy].flat().forEach((value) => bytes.float(value));
  return bytes.all();
}

/** `frames`: [{ time, poses: [[x, y, z, angle]], grains: [{ id, lot, radius, start, values: counts of each field }], contacts }], the last of
 *  some; `map` and `hopperMap`: { cell_m, columns, rows, view, looks, from_s, to_s, packing, vx, vy } or none. */
export function encodeRecording({ frames, fields, units, vessels, perBlock, map, hopperMap, version = 2 }) {
  const blocks = [];
  for (let from = 0; from < frames.length; from += perBlock) {
    const bytes = new Bytes();
    const history = new Map();
    const some = frames.slice(from, from + perBlock);
    some.reduce((list, frame) => putFrame(bytes, frame, list, history, fields.length), []);
    blocks.push({ frames: some.length, bytes: deflateSync(bytes.all()) });
  }
  let offset = 0;
  const index = blocks.map((block) => {
    const entry = { frames: block.frames, offset, bytes: block.bytes.length };
    offset += block.bytes.length;
    return entry;
  });
  const add = (bytes) => {
    const stream = deflateSync(bytes);
    const entry = { offset, bytes: stream.length };
    blocks.push({ bytes: stream });
    offset += stream.length;
    return entry;
  };
  const axes = fields.includes('z') ? 3 : 2;
  const contacts = frames.flatMap((frame, k) => (frame.contacts ? [{ frame: k, ...add(contactBytes(frame.contacts, axes)) }] : []));
  const entryOf = (one) => (one ? { ...one, packing: undefined, vx: undefined, vy: undefined, ...add(mapBytes(one)) } : undefined);
  const maps = { map: entryOf(map), hopper_map: entryOf(hopperMap) };
  const grains = 1 + Math.max(-1, ...frames.flatMap((frame) => frame.grains.map((grain) => grain.id)));
  const header = Buffer.from(JSON.stringify({
    version, frames: frames.length, frames_per_block: perBlock, unit_m: units[0], fields, field_units: units, vessels, grains, blocks: index, ...(version > 1 ? { contacts, ...maps } : {}),
  }));
  const length = Buffer.alloc(4);
  length.writeUInt32LE(header.length);
  return Buffer.concat([Buffer.from('VBSWREC1'), length, header, ...blocks.map((block) => block.bytes)]);
}

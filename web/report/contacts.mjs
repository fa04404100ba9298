// Contacts of a frame, with their normal forces: of two grains, by their places in the frame's list; and of a grain alone,
// with a wall or across a periodic boundary, by where it is touched.

const forcesPerDecade = 64;
const placesPerRadius = 100;
const bytesOfHead = 8 + 4 + 4;

function plane(bytes, at, count) {
  return Uint32Array.from({ length: count }, (_, k) => bytes[at + k] + bytes[at + count + k] * 2 ** 8 + bytes[at + 2 * count + k] * 2 ** 16 + bytes[at + 3 * count + k] * 2 ** 24);
}

function summed(steps) {
  let last = 0;
  return steps.map((step) => { last += step; return last; });
}

/**
 * Of inflated bytes and so many grains: { largest (N), grain, partner, force (N), touched, place: [of each axis, in radii], touch (N) }.
 * A force of the 255th step is that or less.
 */
export function decodeContacts(bytes, grains, inSpace) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const axes = inSpace ? 3 : 2;
  const largest = view.getFloat64(0, true), pairs = view.getUint32(8, true), touches = view.getUint32(12, true);
  if (bytes.length !== bytesOfHead + 9 * pairs + (5 + axes) * touches) throw new Error('the contacts of a frame are cut off');
  const force = (at, count) => Float64Array.from({ length: count }, (_, k) => largest * 10 ** (-bytes[at + k] / forcesPerDecade));
  const grain = summed(plane(bytes, bytesOfHead, pairs));
  const partner = plane(bytes, bytesOfHead + 4 * pairs, pairs).map((beyond, k) => grain[k] + beyond);
  const from = bytesOfHead + 9 * pairs;
  const touched = summed(plane(bytes, from, touches));
  if ([grain, partner, touched].some((places) => places.some((place) => place >= grains))) throw new Error('a contact is of a grain that is not there');
  const place = Array.from({ length: axes }, (_, axis) => Float64Array.from({ length: touches }, (__, k) => view.getInt8(from + (4 + axis) * touches + k) / placesPerRadius));
  return { largest, grain, partner, force: force(bytesOfHead + 8 * pairs, pairs), touched, place, touch: force(from + (4 + axes) * touches, touches) };
}

/** Of each grain the sum of the normal forces of its contacts, N. */
export function forceOfGrains(contacts, grains) {
  const sum = new Float64Array(grains);
  contacts.force.forEach((force, k) => {
    sum[contacts.grain[k]] += force;
    sum[contacts.partner[k]] += force;
  });
  contacts.touch.forEach((force, k) => { sum[contacts.touched[k]] += force; });
  return sum;
}

// Films of a page: pictures that a browser makes small, one after the other in an animated WebP, which a document shows as any picture.
// The format: https://developers.google.com/speed/webp/docs/riff_container

const loopForEver = 0;

function chunk(name, ...parts) {
  const data = Buffer.concat(parts);
  const head = Buffer.alloc(8);
  head.write(name, 'latin1');
  head.writeUInt32LE(data.length, 4);
  return Buffer.concat([head, data, Buffer.alloc(data.length % 2)]);
}

function numbers(size, ...values) {
  const bytes = Buffer.alloc(size * values.length);
  values.forEach((value, k) => bytes.writeUIntLE(value, size * k, size));
  return bytes;
}

// The compressed picture of a WebP of one picture, without what is said of its colours; one with transparent parts has its alpha apart.
function pictureChunk(webp) {
  const found = new Map();
  for (let at = 12; at < webp.length;) {
    const bytes = 8 + webp.readUInt32LE(at + 4);
    found.set(webp.toString('latin1', at, at + 4), webp.subarray(at, at + bytes + (bytes % 2)));
    at += bytes + (bytes % 2);
  }
  const picture = found.get('VP8 ') ?? found.get('VP8L');
  if (!picture || found.has('ALPH')) throw new Error(`a frame is no plain picture but ${[...found.keys()].join(', ')}`);
  return picture;
}

function frameChunk({ webp, duration }, { width, height }) {
  const replaced = 2;  // what was shown before is not blended with it
  return chunk('ANMF', numbers(3, 0, 0, width - 1, height - 1, Math.round(duration)), Buffer.from([replaced]), pictureChunk(webp));
}

/** `frames`: [{ webp, duration in ms }], all of one size. */
export function filmOf(frames, size) {
  const isAnimated = 2;
  const head = chunk('VP8X', Buffer.from([isAnimated, 0, 0, 0]), numbers(3, size.width - 1, size.height - 1));
  const play = chunk('ANIM', Buffer.from([255, 255, 255, 255]), numbers(2, loopForEver));
  return chunk('RIFF', Buffer.from('WEBP'), head, play, ...frames.map((frame) => frameChunk(frame, size)));
}

/** A picture drawn so many pixels wide, by a page that is there for it: { bytes, width, height }. `type`: "image/webp" or "image/jpeg", of so much `quality`, 0 to 1. */
export async function drawnSmaller(page, picture, { type, width, quality }) {
  const made = await page.evaluate(async ([base64, [kind, wide, good]]) => {
    const image = await createImageBitmap(await (await fetch(`data:;base64,${base64}`)).blob());
    const canvas = Object.assign(document.createElement('canvas'), { width: wide, height: Math.round((image.height * wide) / image.width) });
    const context = canvas.getContext('2d', { alpha: false });
    context.imageSmoothingQuality = 'high';
    context.drawImage(image, 0, 0, canvas.width, canvas.height);
    return { height: canvas.height, address: canvas.toDataURL(kind, good) };
  }, [picture.toString('base64'), [type, width, quality]]);
  return { bytes: Buffer.from(made.address.split(',')[1], 'base64'), width, height: made.height };
}

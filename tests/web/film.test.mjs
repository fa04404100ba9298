// Films of pages, and pictures drawn smaller, read back by a browser.
import assert from 'node:assert/strict';
import test, { after } from 'node:test';
import * as in_ from './browser.mjs';
import { drawnSmaller, filmOf } from './film.mjs';

const browser = await in_.startBrowser();
after(() => browser.close());

async function pictureOf(colour) {
  const page = await browser.newPage({ viewport: { width: 80, height: 51 } });
  await page.setContent(`<body style="background: ${colour}">`);
  const png = await page.screenshot();
  await page.close();
  return png;
}

// Of each frame its duration, ms, its size, and the colour of its middle.
const framesOf = async (base64) => {
  const data = Uint8Array.from(atob(base64), (one) => one.charCodeAt(0));
  const decoder = new ImageDecoder({ data, type: 'image/webp' });
  await decoder.tracks.ready;
  const context = Object.assign(document.createElement('canvas'), { width: 1, height: 1 }).getContext('2d');
  const all = [];
  for (let frameIndex = 0; frameIndex < decoder.tracks.selectedTrack.frameCount; ++frameIndex) {
    const { image } = await decoder.decode({ frameIndex });
    context.drawImage(image, 20, 12, 1, 1, 0, 0, 1, 1);
    all.push({ ms: image.duration / 1000, size: [image.displayWidth, image.displayHeight], colour: [...context.getImageData(0, 0, 1, 1).data].map((value) => Math.round(value / 51)) });
  }
  return { all, times: decoder.tracks.selectedTrack.repetitionCount };
};

test('a film has its pictures in their order, each for its time, again and again', async () => {
  const frames = [], page = await browser.newPage();
  await page.goto(import.meta.url);  // any file: elsewhere a browser has no decoder
  for (const [colour, duration] of [['#f00', 90], ['#00f', 400]]) {
    const { bytes, width, height } = await drawnSmaller(page, await pictureOf(colour), { type: 'image/webp', width: 40, quality: 0.8 });
    assert.deepEqual([width, height], [40, 26]);
    frames.push({ webp: bytes, duration });
  }
  const { all, times } = await page.evaluate(framesOf, filmOf(frames, { width: 40, height: 26 }).toString('base64'));
  assert.deepEqual(all, [{ ms: 90, size: [40, 26], colour: [5, 0, 0, 5] }, { ms: 400, size: [40, 26], colour: [0, 0, 5, 5] }]);
  assert.equal(times, Infinity);
});

test('a picture with transparent parts becomes no frame', () => {
  const chunks = [...'VP8X', 2, 0, 0, 0, 'a', 'b', ...'ALPH', 1, 0, 0, 0, 'a', 'b', ...'VP8 ', 0, 0, 0, 0];
  const webp = Buffer.concat([Buffer.from('RIFF____WEBP'), ...chunks.map((one) => (typeof one === 'string' ? Buffer.from(one) : Buffer.from([one])))]);
  assert.throws(() => filmOf([{ webp, duration: 1 }], { width: 1, height: 1 }), /no plain picture but VP8X, ALPH, VP8 /);
});

// The replay of a run in space, with WebGL2 and without.
import assert from 'node:assert/strict';
import test, { after, describe } from 'node:test';
import * as in_ from './browser.mjs';
import { encodeRecording } from './encoder.mjs';
import { fileOf } from './made_up_pages.mjs';
import { madeUpRun } from './made_up_run.mjs';

const small = { viewport: { width: 500, height: 600 } };

// A run of so many balls, no two frames alike, without forces.
function madeUpCrowd(count) {
  const made = madeUpRun('three_dimensional');
  const unit = 1e-5, across = 20, radius = 1e-3;
  const place = (id) => [id % across, Math.floor(id / across) % across, Math.floor(id / across ** 2)].map((step) => (2 * step + 1) * radius);
  const frames = Array.from({ length: 4 }, (_, frame) => ({
    time: frame / 40, poses: [[0, 0, 0, 0], [0, 0, 0, 0]],
    grains: Array.from({ length: count }, (__, id) => {
      const [z, y, x] = place(id);
      return { id, lot: 0, radius, start: [x, y, z], values: [x, y + 1e-4 * ((id + frame) % 3), z].map((value) => Math.round(value / unit)) };
    }),
  }));
  return { data: made.data, recording: encodeRecording({ frames, version: 1, perBlock: 4, vessels: ['tray', 'hopper'], fields: ['x', 'y', 'z'], units: [unit, unit, unit] }) };
}

// Counts what is asked of WebGL: draw calls, and bytes that are uploaded.
function countGl() {
  window.asked = { draws: 0, bytes: 0 };
  const watch = (name, note) => {
    const own = WebGL2RenderingContext.prototype[name];
    WebGL2RenderingContext.prototype[name] = function watched(...given) {
      note(given);
      return own.apply(this, given);
    };
  };
  for (const name of ['drawArrays', 'drawElements', 'drawArraysInstanced', 'drawElementsInstanced']) watch(name, () => { ++window.asked.draws; });
  watch('bufferData', ([, data]) => { window.asked.bytes += data.byteLength ?? data; });
  watch('bufferSubData', ([, , data]) => { window.asked.bytes += data.byteLength; });
}

test('a frame of 12 000 balls is one draw of them, and a turned camera uploads nothing', async () => {
  const balls = 12000, bytesOfBall = 16 + 4;
  const browser = await in_.startBrowser();
  const page = await in_.openPage(browser, fileOf(madeUpCrowd(balls)), { viewport: { width: 400, height: 400 }, first: countGl });
  await page.locator('#replay-canvas').scrollIntoViewIfNeeded();
  const askedOf = async (act) => {
    const before = await in_.pictureOf(page);
    await page.evaluate(() => { window.asked = { draws: 0, bytes: 0 }; });
    await act();
    await in_.nextPicture(page, before);
    return page.evaluate(() => window.asked);
  };
  const scriptOf = async (act) => {
    const times = [];
    for (let k = 0; k < 7; ++k) {
      await act(k);
      times.push(Number(await page.getAttribute('#replay-canvas', 'data-script-ms')));
    }
    times.sort((a, b) => a - b);
    return `${times[0]} ms at least, ${times[3]} ms in the median`;
  };
  const ofFrames = await scriptOf((k) => in_.scrubTo(page, k % 4)), ofTurns = await scriptOf(() => page.locator('#replay-canvas').press('ArrowLeft'));
  await in_.scrubTo(page, 2);
  const frame = await askedOf(() => in_.scrubTo(page, 3));
  const turned = await askedOf(() => page.locator('#replay-canvas').press('ArrowUp'));
  console.log(`script of a frame of ${balls} balls: ${ofFrames}; of a turn: ${ofTurns}; ${frame.draws} draws, ${frame.bytes} bytes`);
  assert.ok(frame.draws < 20, `${frame.draws} draws`);
  assert.equal(frame.bytes, balls * bytesOfBall);
  assert.ok(turned.draws < 20, `${turned.draws} draws`);
  assert.equal(turned.bytes, 0);
  assert.deepEqual(page.complaints, []);
  await browser.close();
});

test('where the browser takes WebGL back, the replay goes on without', async () => {
  const browser = await in_.startBrowser();
  const page = await in_.openPage(browser, fileOf(madeUpRun('three_dimensional')), small);
  await page.evaluate(() => document.querySelector('.stage canvas[aria-hidden]').getContext('webgl2').getExtension('WEBGL_lose_context').loseContext());
  await page.waitForFunction(() => document.querySelector('.stage canvas[aria-hidden]').hidden);
  const before = await in_.pictureOf(page);
  await in_.scrubTo(page, 3);
  await in_.nextPicture(page, before);
  await browser.close();
});

for (const [name, more, isGl] of [['with WebGL2', [], true], ['without WebGL2', ['--disable-3d-apis'], false]]) {
  describe(name, async () => {
    const browser = await in_.startBrowser(more);
    after(() => browser.close());

    async function withPage(made, options, check) {
      const page = await in_.openPage(browser, fileOf(made), { ...small, ...options });
      await check(page);
      assert.deepEqual(page.complaints, []);
      await page.context().close();
    }

    test('says which of them paints', () => withPage(madeUpRun('three_dimensional'), {}, async (page) => {
      assert.equal(await page.evaluate(() => document.querySelector('.stage canvas[aria-hidden]').hidden), !isGl);
    }));

    test('turns, moves and zooms by hand and by keys, and goes back to its views', () => withPage(madeUpRun('three_dimensional'), {}, async (page) => {
      const seen = new Set();
      let shown = await in_.pictureOf(page);
      const front = shown;
      const anew = async (act) => {
        await act();
        shown = await in_.nextPicture(page, shown);
        assert.ok(!seen.has(shown));
        seen.add(shown);
      };
      const frame = await in_.shownFrame(page);
      const canvas = page.locator('#replay-canvas');
      const drag = async () => {
        await canvas.scrollIntoViewIfNeeded();
        const { x, y } = await canvas.boundingBox();
        await page.mouse.move(x + 100, y + 100);
        await page.mouse.down();
        await page.mouse.move(x + 160, y + 120);
        await page.mouse.up();
      };
      for (const view of ['Corner', 'Above', 'Through a hole, from below']) await anew(() => page.getByRole('button', { name: view }).click());
      await anew(() => page.getByRole('button', { name: 'Through a hole, from below' }).click());  // the next
      await anew(drag);
      await page.keyboard.down('Shift');
      await anew(drag);
      await page.keyboard.up('Shift');
      await canvas.focus();
      for (const key of ['ArrowLeft', 'ArrowUp', 'Shift+ArrowRight', '+']) await anew(() => page.keyboard.press(key));
      await anew(() => page.mouse.wheel(0, -200));
      await page.keyboard.press('0');
      assert.equal(await in_.nextPicture(page, shown), front);
      assert.equal(await in_.shownFrame(page), frame);
    }));

    test('the wheel scrolls the page until the picture is chosen', () => withPage(madeUpRun('three_dimensional'), {}, async (page) => {
      const canvas = page.locator('#replay-canvas');
      await canvas.scrollIntoViewIfNeeded();
      const before = await in_.pictureOf(page);
      const { x, y } = await canvas.boundingBox();
      await page.mouse.move(x + 50, y + 50);
      await page.mouse.wheel(0, 120);
      await page.waitForFunction((top) => Math.abs(document.querySelector('#replay-canvas').getBoundingClientRect().top - top) > 50, y);
      assert.equal(await in_.pictureOf(page), before);
    }));

    // Presses down the middle of the picture until a seed is told of; its number and its depth.
    async function chooseOne(page) {
      const canvas = page.locator('#replay-canvas');
      await canvas.scrollIntoViewIfNeeded();
      const { width, height } = await canvas.boundingBox();
      for (let y = 0.5 * height; y < height; y += 5) {
        await canvas.click({ position: { x: width / 2 + 2, y } });
        if (await page.locator('#replay-seed:not([hidden])').count() > 0) break;
      }
      await page.locator('#replay-seed:not(:empty)').waitFor();
      const [, seed, depth] = /^Seed (\d+) of .* depth ([\d.]+) mm\.$/.exec(await page.locator('#replay-seed').textContent());
      return { seed: Number(seed), depth: Number(depth) };
    }

    test('a press tells of the seed in front, and of the one behind where the front is cut away', () => {
      const made = madeUpRun('three_dimensional');
      return withPage(made, {}, async (page) => {
        await in_.scrubTo(page, 0);
        const { seed, depth } = await chooseOne(page);
        assert.ok(depth < 5, `${depth} mm`);
        assert.match(await page.locator('#replay-seed').textContent(), new RegExp(`of ${made.data.lots[seed % 3 === 2 ? 1 : 0].name}: .* m/s against the tray; normal forces on it .*N together; it was put in at x `));
        const whole = await in_.pictureOf(page);
        await page.getByRole('slider', { name: 'How much is cut away, percent' }).fill('50');
        await in_.nextPicture(page, whole);
        const behind = await chooseOne(page);
        assert.ok(behind.depth >= 25 && behind.depth < 30, `${behind.depth} mm`);
        await page.getByRole('combobox', { name: 'Cut' }).selectOption('from the top');
        await page.locator('#replay-canvas').click({ position: { x: 3, y: 3 } });
        await page.locator('#replay-seed').waitFor({ state: 'hidden' });
      });
    });

    test('a page that was written without faces shows the walls that the side has', () => {
      const made = madeUpRun('three_dimensional');
      return withPage({ ...made, data: { ...made.data, faces: undefined } }, {}, async (page) => {
        const front = await in_.pictureOf(page);
        await page.getByRole('button', { name: 'Corner' }).click();
        await in_.nextPicture(page, front);
      });
    });
  });
}

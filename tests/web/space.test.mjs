// The replay of a run in space, with WebGL2 and without.
import assert from 'node:assert/strict';
import test, { after, describe } from 'node:test';
import * as in_ from './browser.mjs';
import { lamp } from '../../web/report/lamp.mjs';
import { encodeRecording } from './encoder.mjs';
import { betweenFrames, countGl, madeUpCrowd, playedPictures } from './made_up_crowd.mjs';
import { fileOf } from './made_up_pages.mjs';
import { madeUpRun } from './made_up_run.mjs';

const small = { viewport: { width: 500, height: 600 } };

// Of a made-up crowd, whose tray stands beside a hopper: the lamp sees balls and the edges of both; the camera balls, both floors, the edges of both,
// the rims of the holes and the glass of both.
const bytesOfPlaces = 16, bytesOfColours = 4;
const shadowDraws = 1 + 2, drawsOfPicture = 1 + 2 + 2 + 1 + 2;

test('a frame of 12 000 balls is two draws of them; a camera that turns uploads nothing, one that zooms draws no shadow anew', async () => {
  const balls = 12000;
  const browser = await in_.startBrowser();
  const page = await in_.openPage(browser, fileOf(madeUpCrowd(balls)), { viewport: { width: 400, height: 400 }, first: countGl });
  const canvas = page.locator('#replay-canvas');
  await canvas.scrollIntoViewIfNeeded();
  const askedOf = async (act) => {
    const before = await in_.pictureOf(page);
    await page.evaluate(() => { window.asked = { draws: 0, bytes: 0 }; });
    await act();
    await in_.nextPicture(page, before);
    return page.evaluate(() => window.asked);
  };
  await in_.scrubTo(page, 2);
  assert.deepEqual(await askedOf(() => in_.scrubTo(page, 3)), { draws: shadowDraws + drawsOfPicture, bytes: balls * (bytesOfPlaces + bytesOfColours) });
  assert.deepEqual(await askedOf(() => canvas.press('ArrowUp')), { draws: shadowDraws + drawsOfPicture, bytes: 0 });
  assert.deepEqual(await askedOf(() => canvas.press('+')), { draws: drawsOfPicture, bytes: 0 });
  assert.deepEqual(page.complaints, []);
  await browser.close();
});

test('while it plays each picture between frames uploads the places of its balls, and no colours', async () => {
  const balls = 400;
  const browser = await in_.startBrowser();
  const page = await in_.openPage(browser, fileOf(madeUpCrowd(balls, { frames: 3, step: 30 })), { viewport: { width: 400, height: 400 }, first: countGl });
  const pictures = await page.evaluate(playedPictures, 12);
  await browser.close();
  for (const { draws, bytes } of betweenFrames(pictures)) assert.deepEqual({ draws, bytes }, { draws: shadowDraws + drawsOfPicture, bytes: balls * bytesOfPlaces });
});

// One ball over the floor of the made-up tray; millimetres.
function madeUpBall({ x, y, z, radius }) {
  const { data } = madeUpRun('three_dimensional');
  const unit = 1e-5, values = [x, y, z].map((value) => Math.round(value / 1000 / unit));
  const frames = [0, 1].map((time) => ({ time, poses: [[0, 0, 0, 0], [0, 0, 0, 0]], grains: [{ id: 0, lot: 0, radius: radius / 1000, start: [x, y, z], values }] }));
  const recording = encodeRecording({ frames, version: 1, perBlock: 2, vessels: ['tray', 'hopper'], fields: ['x', 'y', 'z'], units: [unit, unit, unit] });
  return { data: { ...data, faces: { tray: data.faces.tray }, vessels: data.vessels.slice(0, 1) }, recording };
}

// How light the floor of the made-up tray is at places along and across, mm, seen from above: 0 to 1.
function lightness(page, places) {
  return page.evaluate((all) => {
    const under = document.querySelector('.stage canvas');
    const picture = Object.assign(document.createElement('canvas'), { width: under.width, height: under.height });
    const context = picture.getContext('2d', { willReadFrequently: true });
    context.drawImage(under, 0, 0);
    const ratio = under.width / under.clientWidth, margin = 16, length = 160, depth = 50;
    const scale = Math.min((under.clientWidth - 2 * margin) / length, (under.clientHeight - 2 * margin) / depth);
    return all.map(([x, z]) => {
      const [px, py] = [under.clientWidth / 2 + scale * (x - length / 2), under.clientHeight / 2 - scale * (z - depth / 2)];
      return context.getImageData(px * ratio, py * ratio, 1, 1).data.slice(0, 3).reduce((sum, value) => sum + value / 3 / 255, 0);
    });
  }, places);
}

test('a ball has a shadow on the floor, on the far side of the lamp, and none once it is cut away', async () => {
  const ball = { x: 85, y: 20, z: 35, radius: 4 };
  const browser = await in_.startBrowser();
  const page = await in_.openPage(browser, fileOf(madeUpBall(ball)), { viewport: { width: 800, height: 700 } });
  const before = await in_.pictureOf(page);
  await page.getByRole('button', { name: 'Above' }).click();
  const above = await in_.nextPicture(page, before);
  // From above the lamp stands at the left and behind: as seen it is `lamp`, across, along the picture's height, and toward.
  const shadow = [ball.x - (lamp[0] * ball.y) / lamp[2], ball.z - (lamp[1] * ball.y) / lamp[2]];
  const beside = [2 * ball.x - shadow[0], shadow[1]];
  const [dark, light] = await lightness(page, [shadow, beside]);
  assert.ok(dark < 0.8 * light && dark > 0.4 * light, `${dark} in the shadow, ${light} beside it`);
  await page.getByRole('combobox', { name: 'Cut' }).selectOption('from the top');
  await page.getByRole('slider', { name: 'How much is cut away, percent' }).fill('60');
  await in_.nextPicture(page, above);
  const [after_, there] = await lightness(page, [shadow, beside]);
  assert.ok(Math.abs(after_ - there) < 0.02, `${after_} where the shadow was, ${there} beside it`);
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

// The replay of a run in space, with WebGL2 and without.
import assert from 'node:assert/strict';
import test, { after, describe } from 'node:test';
import * as in_ from './browser.mjs';
import { fileOf } from './made_up_pages.mjs';
import { madeUpRun } from './made_up_run.mjs';

const small = { viewport: { width: 500, height: 600 } };

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

// The page of made-up runs, in a browser.
import assert from 'node:assert/strict';
import { readFileSync, statSync } from 'node:fs';
import test, { after, before, describe } from 'node:test';
import * as in_ from './browser.mjs';
import { hostile, openMade, template, withPage } from './made_up_pages.mjs';
import { madeUpRun } from './made_up_run.mjs';

test('the template is small and keeps the licence of what is in it', () => {
  assert.ok(statSync(in_.template).size < 250e3);
  assert.match(template, /earcut 3\.2\.4[\s\S]*ISC License[\s\S]*Mapbox[\s\S]*ogl 1\.0\.11[\s\S]*public domain/);
});

// Every text that is written on the replay, and where.
function keepWritten() {
  window.written = [];
  const own = CanvasRenderingContext2D.prototype.fillText;
  CanvasRenderingContext2D.prototype.fillText = function kept(text, x, y) {
    if (this.canvas.id === 'replay-canvas') window.written.push({ text, y, high: this.canvas.height });
    own.call(this, text, x, y);
  };
}

for (const space of ['plane', 'three_dimensional']) {
  describe(space, () => {
    const run = madeUpRun(space);
    let page;

    before(async () => { page = await openMade(run); });
    after(() => assert.deepEqual(page.complaints, []));

    test('the first screen holds the answer, its doubts, and the tray with its dimensions and in words', async () => {
      const { data } = run, inSpace = space !== 'plane';
      for (const part of ['.headline', '.light', '.tray-card', '.inputs']) {
        const { y, height } = await page.locator(part).first().boundingBox();
        assert.ok(y >= 0 && y + height <= 800, `${part} from ${y} px, ${height} px high`);
      }
      const names = await page.locator('.tray-card .drawing').evaluateAll((drawings) => drawings.map((drawing) => drawing.getAttribute('aria-label')));
      assert.deepEqual(names, ['The tray from the side, to scale: holes 1, 2 and 3', ...(inSpace ? ['The tray from above, to scale; the front is below'] : [])]);
      const [tray] = data.vessels, gap = '45';  // mm, from the floor to the hopper
      assert.deepEqual(await page.locator('.tray-card .dimension text').allTextContents(),
        [...(inSpace ? ['40', '2 × 40', '40'] : ['60', '2 × 90', '60']), String(tray.length_mm), '60', inSpace ? '⌀ 12' : '12', gap, ...(inSpace ? ['50'] : [])]);
      const terms = await page.locator('.inputs dt').allTextContents();
      assert.deepEqual(terms, ['Mixture', 'Holes', 'Shaking', 'Level of seeds', 'Tray']);
      const order = await page.evaluate(() => [...document.querySelectorAll('h1, .headline, .light, .tray-card, main > section')].map(({ className, tagName }) => className.split(' ')[0] || tagName));
      assert.deepEqual(order.slice(0, order.indexOf('SECTION')), ['H1', ...Array(inSpace ? 3 : 1).fill('headline'), 'light', 'tray-card']);
    });

    test("play moves on, and the counters end at the run's counts", async () => {
      const last = Number(await page.getAttribute('#replay-frame', 'max'));
      await in_.scrubTo(page, last - 8);
      const before_ = await in_.shownCounts(page);
      await page.getByRole('button', { name: 'Play' }).click();
      await in_.waitForFrame(page, last);
      await page.getByRole('button', { name: 'Play' }).waitFor();
      assert.deepEqual(await in_.shownCounts(page), new Map(run.data.holes.map((hole) => [hole.hole, hole.counted_all])));
      assert.notDeepEqual(before_, await in_.shownCounts(page));
    });

    test('the counts stand under the holes, inside the picture', () => withPage(run, { first: keepWritten }, async (open) => {
      await in_.scrubTo(open, 30);
      const written = await open.evaluate(() => window.written);
      for (const count of (await in_.shownCounts(open)).values()) {
        const { y, high } = written.findLast(({ text }) => text === String(count));
        assert.ok(y + 13 < high, `${count} at ${y} px of ${high}`);
      }
    }));

    test('scrubbing shows other grains, and counts until then', async () => {
      await in_.scrubTo(page, 5);
      const early = await in_.pictureOf(page);
      await in_.scrubTo(page, 30);
      assert.notEqual(await in_.pictureOf(page), early);
      const time = (30 * run.data.end_time_s) / Number(await page.getAttribute('#replay-frame', 'max'));
      const until = run.data.holes.map(({ hole }) => [hole, run.data.events.time_s.filter((when, k) => run.data.events.hole[k] === hole && when <= time).length]);
      assert.deepEqual(await in_.shownCounts(page), new Map(until));
    });

    test('the keyboard steps and plays', async () => {
      await in_.scrubTo(page, 10);
      await page.keyboard.press('ArrowRight');
      await in_.waitForFrame(page, 11);
      await page.keyboard.press('ArrowLeft');
      await page.keyboard.press('ArrowLeft');
      await in_.waitForFrame(page, 9);
      await page.keyboard.press('Space');
      await page.waitForFunction(() => Number(document.querySelector('#replay-canvas').dataset.frame) > 10);
      await page.keyboard.press('Space');
      await page.getByRole('button', { name: 'Play' }).waitFor();
    });

    test('every colouring paints differently and says what it means', async () => {
      await in_.scrubTo(page, 20);
      let shown = await in_.pictureOf(page);
      const seen = new Set([shown]);
      for (const [name, words] of [['Speed', 'm/s'], ['Start', 'mm']]) {
        await page.getByRole('radio', { name }).check();
        await page.locator('#replay-legend', { hasText: words }).waitFor();
        seen.add(shown = await in_.nextPicture(page, shown));
      }
      assert.equal(seen.size, 3);
      await page.getByRole('radio', { name: 'Lot' }).check();
      await page.locator('#replay-legend', { hasText: run.data.lots[1].name }).waitFor();
    });

    test('forces colour the seeds and draw chains, of the nearest moment that has them', async () => {
      await in_.scrubTo(page, 20);
      const plain = await in_.pictureOf(page);
      await page.getByRole('checkbox', { name: 'Force chains' }).check();
      const chained = await in_.nextPicture(page, plain);
      await page.locator('#replay-forces', { hasText: /^Forces and seeds now: \d+ contacts, .* mN in the mean, .* mN at most/ }).waitFor();
      await page.getByRole('radio', { name: 'Force' }).check();
      await page.locator('#replay-legend', { hasText: 'sum of a seed’s normal forces' }).waitFor();
      await in_.nextPicture(page, chained);
      await in_.scrubTo(page, 21);
      const later = await in_.pictureOf(page);
      const frames = Number(await page.getAttribute('#replay-frame', 'max'));
      const time = ((20 * run.data.end_time_s) / frames).toFixed(2);
      await page.locator('#replay-forces', { hasText: `at ${time} s, the nearest moment` }).waitFor();
      assert.match(await page.getAttribute('#replay-canvas', 'aria-label'), /contacts, .* in the mean/);
      await page.getByRole('checkbox', { name: 'Force chains' }).uncheck();
      await in_.nextPicture(page, later);
      await page.getByRole('radio', { name: 'Lot' }).check();
      await page.locator('#replay-forces').waitFor({ state: 'hidden' });
      await in_.scrubTo(page, 20);
      assert.equal(await in_.pictureOf(page), plain);
    });

    test('maps of packing and velocity are drawn and said', async () => {
      assert.match(await page.locator('#map-packing figcaption').textContent(), /^Densest, 0\.7\d*, \d.* from the left end and 3\.3 mm over the floor; /);
      assert.match(await page.locator('#map-velocity figcaption').textContent(), /^Fastest, 0\.\d+ m\/s .*, at hole 2; /);
      const [ofTray, ofHopper] = await page.locator('#maps .lead').allTextContents();
      assert.match(ofTray, /211 looks from 0\.5 to 2 s, in the tray’s own frame, .* Seeds in the hopper are left out; they have maps of their own\./);
      assert.match(ofHopper, /in the hopper’s own frame, /);
      for (const id of ['map-packing', 'map-velocity', 'hopper-map-packing', 'hopper-map-velocity']) {
        const canvas = page.locator(`#${id} canvas`);
        assert.match(await canvas.getAttribute('aria-label'), /^(Packing|Velocity)( in the hopper)?\. /);
        const painted = await canvas.evaluate((one) => new Set(new Uint32Array(one.getContext('2d').getImageData(0, 0, one.width, one.height).data.buffer)).size);
        assert.ok(painted > 4, `${id} has ${painted} colours`);
      }
    });

    test('accessible in light and dark, and no wider than a phone', () => withPage(run, { bypass: true }, async (open) => {
      await in_.assertReadsWell(open);
    }));
  });
}

test('a tray held still looks otherwise than one that shakes', () => withPage(madeUpRun('plane'), {}, async (page) => {
  await in_.scrubTo(page, 13);
  const shaking = await in_.pictureOf(page);
  await page.getByRole('checkbox', { name: 'Hold the tray still' }).check();
  await in_.nextPicture(page, shaking);
}));

test('a recording without forces and maps offers none', () => {
  const run = madeUpRun('plane', { version: 1 });
  return withPage(run, {}, async (page) => {
    assert.equal(await page.getByRole('checkbox', { name: 'Force chains' }).count(), 0);
    assert.equal(await page.getByRole('radio', { name: 'Force' }).count(), 0);
    assert.equal(await page.locator('#maps').count(), 0);
    assert.deepEqual(page.complaints, []);
  });
});

test('a press on the chart moves the replay', () => withPage(madeUpRun('plane'), {}, async (page) => {
  const grid = page.locator('#outflow .chart').first().locator('.window');  // from 0.5 to 2 s, the end
  await grid.scrollIntoViewIfNeeded();
  const box = await grid.boundingBox();
  await page.mouse.click(box.x + box.width * (2 / 3), box.y + 40);  // 1.5 s
  await page.waitForFunction(() => Math.abs(Number(document.querySelector('#replay-canvas').dataset.frame) - 75) <= 1);
}));

// Rules for the boxes in the margins of paper, by where they are.
const margins = () => Object.fromEntries([...document.styleSheets].flatMap((sheet) => [...sheet.cssRules]).filter((rule) => rule.type === CSSRule.PAGE_RULE)
  .flatMap((rule) => [...rule.cssRules]).map((rule) => [rule.name, rule.style.content]));

test('on paper every sheet has its heading and number, tables have their heads, and no word is broken', () => {
  const run = madeUpRun('plane', { title: 'A "tray" \\' });
  return withPage(run, {}, async (page) => {
    assert.deepEqual(await page.evaluate(margins), { 'top-left': '"A \\"tray\\" \\\\"', 'top-right': '"Run in 2D"', 'bottom-left': '"Written by vibrosow 0.2.0"', 'bottom-right': 'counter(page) " / " counter(pages)' });
    await page.emulateMedia({ media: 'print' });
    const look = (selector, what) => page.$$eval(selector, (nodes, name) => [...new Set(nodes.map((node) => getComputedStyle(node)[name]))], what);
    assert.deepEqual(await look('thead', 'display'), ['table-header-group']);
    assert.deepEqual(await look('th, td', 'overflowWrap'), ['normal']);
    assert.deepEqual(await look('p, dd, h2', 'overflowWrap'), ['break-word']);
    assert.deepEqual(await look('footer, .controls', 'display'), ['none']);
    const pdf = await page.pdf({ format: 'A4', preferCSSPageSize: true });
    assert.ok(pdf.toString('latin1').match(/\/Type \/Page\b/g).length > 1);
  });
});

test('a table that is wider than its place has a shadow where it goes on', () => withPage(madeUpRun('plane'), { viewport: { width: 390, height: 844 } }, async (page) => {
  const frame = page.locator('#outflow .table-frame');
  await frame.scrollIntoViewIfNeeded();
  assert.ok(await frame.evaluate((node) => node.scrollWidth > node.clientWidth + 40));
  // The darkest pixel of a strip at either end, where no text is: between the first two rows.
  const strips = async () => {
    const { x, y, width } = await frame.evaluate((node) => {
      const { left, width: all } = node.getBoundingClientRect();
      return { x: left, y: node.querySelector('thead').getBoundingClientRect().top + 2, width: all };
    });
    const darkest = async (left) => {
      const png = await page.screenshot({ clip: { x: left, y, width: 6, height: 4 } });
      return page.evaluate(async (base64) => {
        const picture = new Image();
        picture.src = `data:image/png;base64,${base64}`;
        await picture.decode();
        const context = Object.assign(document.createElement('canvas'), { width: 6, height: 4 }).getContext('2d');
        context.drawImage(picture, 0, 0);
        return Math.min(...context.getImageData(0, 0, 6, 4).data.filter((_, k) => k % 4 === 0));
      }, png.toString('base64'));
    };
    return [await darkest(x), await darkest(x + width - 6)];
  };
  const [left, right] = await strips();
  assert.ok(right < left - 20, `${left} at the left, ${right} at the right`);
  await frame.evaluate((node) => { node.scrollLeft = node.scrollWidth; });
  const [later, end] = await strips();
  assert.ok(later < end - 20, `${later} at the left, ${end} at the right`);
}));

test('hostile names stay text', () => withPage(madeUpRun('plane', { title: hostile, lots: [hostile, `${hostile}2`] }), {}, async (page) => {
  assert.equal(await page.locator('h1').textContent(), hostile);
  assert.match(await page.locator('#replay-legend').textContent(), /onerror=alert\(1\)>2/);
  assert.equal(await page.locator('td', { hasText: hostile }).count(), 3);
  assert.equal(await page.locator('img').count(), 0);
}));

test('how it was computed is folded until one asks, and open on paper', () => withPage(madeUpRun('plane'), { bypass: true }, async (page) => {
  const effect = page.getByText('seeds and walls rub');
  assert.equal(await effect.isVisible(), false);
  assert.match(await page.locator('#computed summary').first().textContent(), /scheme velocity Verlet/);
  await page.evaluate(() => dispatchEvent(new Event('beforeprint')));
  await effect.waitFor();
  await page.evaluate(() => dispatchEvent(new Event('afterprint')));
  await effect.waitFor({ state: 'hidden' });
  await page.locator('#computed summary').first().click();
  await effect.waitFor();
  await in_.assertAccessible(page);
}));

test('the scene is there to read and to save', () => withPage(madeUpRun('plane'), {}, async (page) => {
  await page.locator('#computed summary').first().click();
  await page.getByText('The whole scene').click();
  const [download] = await Promise.all([page.waitForEvent('download'), page.getByText('Save the scene').click()]);
  const saved = JSON.parse(readFileSync(await download.path(), 'utf8'));
  assert.deepEqual(saved, madeUpRun('plane').data.scene);
}));

test('without a recording the page says how to get one', () => withPage({ ...madeUpRun('plane'), recording: null }, {}, async (page) => {
  assert.match(await page.locator('#replay').textContent(), /kept no recording.*--html/);
  assert.equal(await page.locator('#outflow tbody tr').count(), 3);
}));

test('a recording that is cut off is said, and the rest is shown', () => {
  const run = madeUpRun('plane');
  return withPage({ ...run, recording: run.recording.subarray(0, run.recording.length - 9) }, {}, async (page) => {
    assert.match(await page.locator('#replay .doubt').textContent(), /cannot be replayed: it ends early/);
    assert.equal(await page.locator('#outflow tbody tr').count(), 3);
  });
});

test('in space a run tells what to expect until one weighs', () => {
  const run = madeUpRun('three_dimensional');
  return withPage(run, {}, async (open) => {
    assert.deepEqual(await open.locator('.headline').allTextContents(), [run.data.headline, run.data.expected, run.data.drill.sentence]);
  });
});

test('a remark that the guard and the outflow both make is shown once', () => {
  const run = madeUpRun('plane');
  run.data.remarks = ['the overlap passed 0.05', 'the overlap passed 0.05', 'another'].map((text) => ({ serious: false, text }));
  return withPage(run, {}, async (open) => {
    assert.deepEqual(await open.locator('.remarks li').allTextContents(), ['The overlap passed 0.05.', 'Another.']);
  });
});

const few = { serious: false, text: 'few seeds', what_to_do: 'run longer' };
for (const [remarks, status, level, said] of [
  [[], 'finished', 'none', []],
  [[few], 'finished', 'mild', ['Few seeds. What to do: run longer.']],
  [[few], 'interrupted', 'serious', ['Doubtful: Interrupted at 2 s.', 'Few seeds. What to do: run longer.']],
]) {
  test(`the light of a run that ${status} with ${remarks.length} remarks: ${level}`, () => {
    const run = madeUpRun('plane');
    return withPage({ ...run, data: { ...run.data, remarks, status } }, { bypass: true }, async (open) => {
      assert.equal(await open.locator('.light').count(), 1);
      assert.equal(await open.locator(`.light.${level} .light-words .lamp`).count(), 1);
      assert.deepEqual(await open.locator('.light .remarks li').allTextContents(), said);
      await in_.assertAccessible(open);
    });
  });
}

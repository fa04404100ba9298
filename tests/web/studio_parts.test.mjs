// Layouts, scenes, seeder files, links and courses of the studio, without a browser.
import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import test, { describe } from 'node:test';
import { deflateRawSync } from 'node:zlib';
import { Pace } from '../../web/core/pace.mjs';
import { comparisonOf, comparisonSentence } from '../../web/studio/comparison.mjs';
import { Course } from '../../web/studio/course.mjs';
import { History } from '../../web/studio/history.mjs';
import { Kept } from '../../web/studio/kept.mjs';
import { holdInStep, limitBeside } from '../../web/studio/in_step.mjs';
import * as layouts from '../../web/studio/layout.mjs';
import { fragmentOf, layoutsOf, textOfLayouts } from '../../web/studio/link.mjs';
import { barLength, rulerMarks, shakeWords } from '../../web/studio/measures.mjs';
import { angleText, lengthText, metresOf, radiansOf } from '../../web/studio/quantities.mjs';
import { countInterval, RollingRate } from '../../web/studio/rolling.mjs';
import { keptSentence, sceneOf, seedArea } from '../../web/studio/scene_edit.mjs';
import { fileName, seederFile } from '../../web/studio/seeder_file.mjs';
import { readStudioData } from '../../web/studio/studio_data.mjs';
import { taskOf, wantedRate, wantedWords } from '../../web/studio/wanted.mjs';
import { startSimulator } from './made_up_simulator.mjs';
import { madeUpStudio, wheatText } from './made_up_studio.mjs';

const toml = createRequire(new URL('../../web/package.json', import.meta.url))('smol-toml');
const parse = (text) => JSON.parse(JSON.stringify(toml.parse(text)));  // as ordinary objects
const data = readStudioData(JSON.stringify(madeUpStudio()));
const [wheat, mixed] = data.seeders;
const fresh = layouts.layoutOf(wheat);
const places = (layout) => layout.holes.map((hole) => Math.round(hole.centre_m * 1e4) / 10);
const widths = (layout) => layout.holes.map((hole) => Math.round(hole.width_m * 1e4) / 10);
const fileOf = (layout) => parse(seederFile(layout, data.crops));

describe('quantities', () => {
  test('a tenth of a millimetre is written as such, all else with every digit', () => {
    assert.deepEqual([metresOf(12.3), 0.1 + 0.2, 1 / 12].map(lengthText), ['12.3 mm', '0.30000000000000004 m', '0.08333333333333333 m']);
    assert.deepEqual([radiansOf(17.3), 0.3].map(angleText), ['17.3 degree', '0.3 rad']);
    assert.equal(radiansOf(17.3), 17.3 * (Math.PI / 180));
  });
});

describe('measures', () => {
  test('a ruler has round marks and the end', () => {
    assert.deepEqual(rulerMarks(500, 1), [0, 100, 200, 300, 400, 500]);
    assert.deepEqual(rulerMarks(1135.5, 0.5), [0, 200, 400, 600, 800, 1135.5]);
    assert.deepEqual(rulerMarks(40, 0.1), [0, 40]);
  });
  test('a scale bar is round and neither a dot nor the picture', () => {
    assert.deepEqual([0.1, 0.5, 1, 3, 10].map(barLength), [500, 100, 50, 20, 5]);
    for (const scale of [0.03, 0.4, 1.7, 26]) assert.ok(barLength(scale) * scale >= 35 && barLength(scale) * scale <= 90, String(scale));
  });
  test('a shake is told where it is harmonic', () => assert.deepEqual([{ frequency_hz: 9, amplitude_m: 0.0025 }, null].map(shakeWords), ['9 Hz, ±2.5 mm', '']));
});

describe('the rate of the last shakes', () => {
  // Hole 1 lets out a seed every 10 ms, hole 2 none, told 30 times a second.
  const told = (rolling, until) => {
    for (let k = 0; k / 30 <= until + 1e-9; ++k) rolling.take({ time_s: k / 30, counted: [Math.floor(100 * (k / 30) + 1e-9), 0] });
    return rolling.now();
  };
  test('it is known once a shake is over, and of whole shakes', () => {
    assert.equal(told(new RollingRate(0.2), 0.19), null);
    const first = told(new RollingRate(0.2), 0.21);
    assert.deepEqual([first.shakes, first.from_s, first.until_s], [1, 0, 0.2]);
    assert.deepEqual(first.holes.map(({ hole, seeds_per_s }) => [hole, seeds_per_s]), [[1, 100], [2, 0]]);
    assert.equal(first.all.seeds_per_s, 100);
  });
  test('it forgets what is longer ago than a second', () => {
    const rolling = new RollingRate(0.3);
    for (let k = 0; k <= 100; ++k) rolling.take({ time_s: k / 30, counted: [k < 50 ? k : 50] });
    const { shakes, from_s, until_s, all } = rolling.now();
    assert.deepEqual([shakes, Math.round(30 * (until_s - from_s)), all.seeds_per_s], [3, 27, 0]);
    assert.ok(rolling.past.length < 33);
  });
  test('a shake that takes longer than a second is waited for', () => {
    assert.equal(told(new RollingRate(2), 1.9), null);
    assert.equal(told(new RollingRate(2), 2.1).shakes, 1);
  });
  test('what does not shake to and fro has a rate of the last second', () => {
    assert.equal(told(new RollingRate(null), 0.05), null);
    const { shakes, from_s, until_s } = told(new RollingRate(null), 3);
    assert.deepEqual([shakes, from_s, until_s], [null, 2, 3]);
  });
  test('after a change it begins anew, at the change', () => {
    const rolling = new RollingRate(0.2, 2);
    rolling.take({ time_s: 2, counted: [0] });
    rolling.take({ time_s: 2.19, counted: [19] });
    assert.equal(rolling.now(), null);
    rolling.take({ time_s: 2.2, counted: [20] });
    assert.deepEqual([rolling.now().from_s, Math.round(rolling.now().all.seeds_per_s)], [2, 100]);
  });
  // Exact limits of a Poisson mean: of 0 seeds 0 to 3.689, of 4 1.090 to 10.242, of 100 81.36 to 121.63 (Garwood 1936).
  test('its interval is that of a count', () => {
    for (const [count, low, high] of [[0, 0, 3.689], [4, 1.09, 10.242], [100, 81.36, 121.63]]) {
      const given = countInterval(count);
      assert.ok(Math.abs(given.low - low) <= 0.02 * low + 1e-12 && Math.abs(given.high - high) <= 0.02 * high, `${count}: ${given.low} ${given.high}`);
    }
  });
});

test('a layout begins at draft, unless its seeder says its time step', () => {
  assert.equal(layouts.startOf(wheat).accuracy, 'draft');
  const timed = { ...wheat, scene: { ...wheat.scene, numerics: { ...wheat.scene.numerics, dt_s: 1e-6 } } };
  assert.deepEqual([layouts.startOf(timed).accuracy, layouts.accuraciesOf(timed)], ['as-written', ['as-written']]);
});

// A simulator that makes `speed` simulated seconds a second, in slices of at most 12 ms with 1 ms between them: how far it has come by each
// `mark` (ms), and how often it has waited. It is held up from one time to another, where `held` says so.
function simulated(pace, speed, marks, held = [Infinity, 0]) {
  const run = new Pace(pace, 0, 0), reached = [];
  let now = 0, time = 0, waits = 0;
  for (const mark of marks) {
    while (now < mark) {
      if (now >= held[0] && now < held[1]) now = held[1];
      const due = run.due(now), slice = Math.min(12, ((due - time) / speed) * 1e3);
      time = slice < 12 ? due : time + (slice * speed) / 1e3;
      now += slice + 1;
      run.forgive(now, time);
      if (time < due) continue;
      ++waits;
      now += 4;
    }
    reached.push(time);
  }
  return { reached, waits };
}

describe('the pace of a simulation', () => {
  test('what is faster than real time keeps to it', () => {
    const { reached: [half, one], waits } = simulated(1, 3, [500, 1000]);
    assert.ok(Math.abs(half - 0.5) < 0.02 && Math.abs(one - 1) < 0.02 && waits > 50, `${half} ${one} ${waits}`);
  });
  test('what is slower does not wait', () => {
    const { reached: [one], waits } = simulated(1, 0.5, [1000]);
    assert.ok(one > 0.45 && waits <= 3, `${one} ${waits}`);  // at the start little is due yet
  });
  test('what was held up catches up with a tenth of a second of it, no more', () => {
    const { reached: [one] } = simulated(1, 3, [2000], [500, 1300]);
    assert.ok(one > 1.25 && one < 1.33, `${one}`);
  });
  test('as fast as it can never waits', () => {
    const { reached: [one], waits } = simulated(null, 3, [1000]);
    assert.ok(one > 2.7 && waits === 0, `${one} ${waits}`);
  });
});

describe('layouts', () => {
  test('a hole stops at its neighbours and at the walls', () => {
    assert.deepEqual(places(layouts.moveHole(fresh, 1, 181.24)), [70, 181.2, 250, 340, 430]);
    assert.deepEqual(places(layouts.moveHole(fresh, 1, 900)), [70, 237, 250, 340, 430]);
    assert.deepEqual(places(layouts.moveHole(fresh, 0, -5)), [6, 160, 250, 340, 430]);
    assert.deepEqual(layouts.reachOf(fresh, 4), [353, 494]);
    assert.deepEqual(places(fresh), [70, 160, 250, 340, 430]);
  });

  test('a hole grows as far as there is floor', () => {
    assert.equal(widths(layouts.widenHole(fresh, 0, 14.5))[0], 14.5);
    assert.equal(widths(layouts.widenHole(fresh, 0, 500))[0], 140);
    assert.equal(widths(layouts.widenHole(fresh, 2, 0))[2], 1);
    assert.deepEqual(widths(layouts.widenAll(fresh, 20)), Array(5).fill(20));
    assert.deepEqual(widths(layouts.widenAll(fresh, 500)), Array(5).fill(89));
    assert.deepEqual([layouts.commonWidth(fresh), layouts.commonWidth(layouts.widenHole(fresh, 0, 14))], [12, null]);
  });

  test('holes are added where most floor is, and taken away but for one', () => {
    const { added, layout } = layouts.addHole(layouts.removeHole(fresh, 2));
    assert.equal(added, 2);
    assert.deepEqual(places(layout), [70, 160, 250, 340, 430]);
    const one = [0, 0, 0, 0].reduce((left) => layouts.removeHole(left, 0), fresh);
    assert.deepEqual(places(one), [430]);
    assert.equal(layouts.removeHole(one, 0), one);
    assert.equal(layouts.addHole(layouts.widenAll(fresh, 500)), null);
  });

  test('another number of holes is spread between the outermost', () => {
    assert.deepEqual(places(layouts.spreadHoles(fresh, 4)), [70, 190, 310, 430]);
    assert.deepEqual(places(layouts.spreadHoles(fresh, 1)), [250]);
    assert.deepEqual(places(layouts.spreadHoles(layouts.spreadHoles(fresh, 1), 4)), [100, 200, 300, 400]);
    assert.equal(layouts.mostInARow(fresh), 28);
    assert.equal(layouts.spreadHoles(fresh, 1000).holes.length, 28);
  });

  test('motion keeps to its ranges, and only a harmonic one can be changed', () => {
    const changed = layouts.withMotion(fresh, { frequency_hz: 12.5, amplitude_mm: 1000 });
    assert.deepEqual(changed.motion, { frequency_hz: 12.5, amplitude_m: 0.03, direction_rad: 0 });
    assert.equal(layouts.layoutOf(mixed).motion, null);
    assert.deepEqual(layouts.accuraciesOf(wheat), ['draft', 'design', 'as-written']);
    assert.deepEqual(layouts.accuraciesOf(mixed), ['draft', 'design']);
  });
});

describe('scenes', () => {
  test('an untouched layout is the seeder’s own scene', () => {
    for (const seeder of [wheat, mixed]) assert.deepEqual(sceneOf(layouts.layoutOf(seeder), data.crops), seeder.scene);
  });

  test('what is changed is changed, and nothing else', () => {
    const layout = { ...layouts.withMotion(layouts.moveHole(fresh, 1, 164), { frequency_hz: 11 }), accuracy: 'draft' };
    const expected = structuredClone(wheat.scene);
    expected.tray.holes[1].centre_m = 0.164;
    expected.tray.motion.frequency_hz = 11;
    expected.numerics.accuracy = 'draft';
    assert.deepEqual(sceneOf(layout, data.crops), expected);
    assert.equal(fresh.seeder.scene.tray.holes[1].centre_m, 0.16);
  });

  test('a hole more has its neighbour’s gate', () => {
    const { layout, added } = layouts.addHole(layouts.layoutOf(mixed));
    assert.equal(sceneOf(layout, data.crops).tray.holes[added].open_at_s, layout.holes[Math.max(0, added - 1)].open_at_s);
  });

  test('another crop brings its seeds and contact, and beds as deep', () => {
    const layout = { ...fresh, crop: 'soybean' };
    const scene = sceneOf(layout, data.crops);
    assert.deepEqual([scene.lots, scene.contact], [data.crops[1].lots, data.crops[1].contact]);
    assert.deepEqual([scene.tray.fill, scene.hopper.fill], [{ count: 140, packing: 'poured', keep: false }, { count: 50, packing: 'poured', keep: true }]);
    assert.deepEqual(scene.tray.holes, wheat.scene.tray.holes);
    assert.match(keptSentence(layout, data.crops), /140 seeds in the tray instead of 560, 50 seeds in the hopper instead of 200\.$/);
    assert.equal(keptSentence(fresh, data.crops), '');
  });

  test('a clump’s area counts overlaps once', () => {
    const disc = (x_m, y_m = 0) => ({ x_m, y_m, radius_m: 1e-3 });
    const area = (discs) => seedArea({ diameter_m: 9, discs }) / (Math.PI * 1e-6);
    assert.ok(Math.abs(area([disc(0)]) - 1) < 1e-3);
    assert.ok(Math.abs(area([disc(0), disc(0), disc(2e-3)]) - 2) < 2e-3);
    assert.ok(Math.abs(area([disc(0, -1e-3), disc(0, 1e-3)]) - 2) < 2e-3);
  });
});

describe('seeder files', () => {
  test('an untouched seeder keeps every value', () => {
    for (const seeder of [wheat, mixed]) assert.deepEqual(fileOf(layouts.layoutOf(seeder)), parse(seeder.toml));
    assert.match(seederFile(fresh, data.crops), /^# From the studio: the seeder wheat-tray, Wheat tray, five holes, fed from a hopper; crop wheat \(Wheat\)\.\n# Nothing is changed/);
  });

  test('only what changed is replaced', () => {
    const expected = parse(wheatText);
    const moved = layouts.moveHole(fresh, 1, 164.5);
    expected.tray.holes = { width: '12 mm', at: ['70 mm', '164.5 mm', '250 mm', '340 mm', '430 mm'] };
    assert.deepEqual(fileOf(moved), expected);
    expected.tray.motion.frequency = '11.5 Hz';
    assert.deepEqual(fileOf(layouts.withMotion(moved, { frequency_hz: 11.5 })), expected);
    expected.tray.holes.width = ['12 mm', '14 mm', '12 mm', '12 mm', '12 mm'];
    const widened = layouts.widenHole(layouts.withMotion(moved, { frequency_hz: 11.5 }), 1, 14);
    assert.deepEqual(fileOf(widened), expected);
    assert.match(seederFile(widened, data.crops), /\n# Changed: places of the holes, widths of the holes, frequency\.\n/);
  });

  test('places that are no tenth of a millimetre are written in metres', () => {
    const thirds = { ...wheat, scene: structuredClone(wheat.scene) };
    thirds.scene.tray.holes[0].centre_m = 1 / 12;
    assert.deepEqual(fileOf(layouts.moveHole(layouts.layoutOf(thirds), 1, 164)).tray.holes.at.slice(0, 2), ['0.08333333333333333 m', '164 mm']);
  });

  test('lists that are one value a hole follow the number of holes', () => {
    const file = fileOf(layouts.removeHole(layouts.layoutOf(mixed), 0));
    assert.deepEqual(file.tray.holes, { at: ['200 mm'], width: '30 mm', open_at: '1 s' });
    assert.deepEqual(fileOf(layouts.removeHole(fresh, 0)).drill, { row_spacing: '15 cm', speed: '8 km/h' });
    assert.deepEqual(fileOf(layouts.moveHole(fresh, 0, 60)).drill.hole_to_row, [1, 1, 2, 2, 3]);
  });

  test('another crop replaces seeds, contact and fills, and widths that went by the seed', () => {
    const file = fileOf({ ...fresh, crop: 'soybean' });
    assert.deepEqual([file.seeds, file.contact, file.tray.fill.count, file.hopper.fill.count], [{ soybean: { crop: 'soybean' } }, { model: 'soybean-steel' }, 140, 50]);
    assert.equal(file.hopper.holes.width, '0.02856 m');
    assert.equal(file.tray.holes.width, '12 mm');
    assert.deepEqual(fileOf({ ...layouts.layoutOf(mixed), crop: 'wheat' }).tray.holes.width, ['24 mm', '30 mm']);
  });

  test('a fill of a height becomes the number of seeds that the page simulates', () => {
    const high = { ...wheat, toml: wheatText.replace('count = 560', 'height = "4 cm"') };
    assert.equal(fileOf(layouts.layoutOf(high)).tray.fill.height, '4 cm');
    const asCounted = fileOf({ ...fresh, crop: 'soybean' }).tray.fill;
    assert.deepEqual(fileOf({ ...layouts.layoutOf(high), crop: 'soybean' }).tray.fill, asCounted);
  });

  test('accuracy is a key of its own', () => {
    assert.equal(fileOf({ ...fresh, accuracy: 'design' }).accuracy, 'design');
    assert.equal(fileOf({ ...layouts.layoutOf(mixed), accuracy: 'design' }).accuracy, 'design');
  });

  test('a title cannot break out of the comment, nor a name out of the folder', () => {
    const hostile = { ...wheat, title: 'x\n[run]\r\nduration = "9 s"', name: '../../etc/pass wd' };
    assert.deepEqual(fileOf(layouts.layoutOf(hostile)), parse(wheatText));
    assert.equal(fileName(layouts.layoutOf(hostile)), 'etc-pass-wd.toml');
    assert.equal(fileName(layouts.layoutOf({ ...wheat, name: '..' })), 'seeder.toml');
  });
});

function packed(value) {
  return `#s=${deflateRawSync(typeof value === 'string' ? value : JSON.stringify(value)).toString('base64url')}`;
}

const plain = (layout) => ({ ...layout, seeder: layout.seeder.name });

describe('links', () => {
  const edited = { ...layouts.withMotion(layouts.moveHole(fresh, 1, 164), { frequency_hz: 11, direction_degree: 17.3 }), crop: 'soybean', accuracy: 'draft' };
  const refused = (value, message) => assert.rejects(layoutsOf(typeof value === 'string' ? value : packed(value), data), message);
  const withLayout = (changes) => ({ layouts: [{ ...plain(fresh), ...changes }] });
  const withHole = (changes) => withLayout({ holes: fresh.holes.map((hole, k) => (k === 1 ? { ...hole, ...changes } : hole)) });

  test('what was shared comes back', async () => {
    for (const shared of [[fresh], [edited], [edited, layouts.layoutOf(mixed)]]) assert.deepEqual(await layoutsOf(await fragmentOf(shared), data), shared);
    assert.equal(await layoutsOf('', data), null);
    assert.equal(await layoutsOf('#else', data), null);
  });

  test('an own seeder goes along whole', async () => {
    const own = { ...wheat, name: 'mine', own: true };
    const [back] = await layoutsOf(await fragmentOf([layouts.moveHole(layouts.layoutOf(own), 0, 65)]), data);
    assert.deepEqual(back.seeder, own);
    assert.equal(back.holes[0].centre_m, 0.065);
    await assert.rejects(fragmentOf([layouts.layoutOf({ ...own, toml: '# '.repeat(200_000) })]), /too large for a link/);
  });

  test('a link that is too large is not read', async () => {
    await refused(`#s=${'A'.repeat(70_000)}`, /longer than 64 KB/);
    const bomb = packed(' '.repeat(30_000_000));
    assert.ok(bomb.length < 60_000);
    await refused(bomb, /more than 256 KB/);
  });

  test('a link that is cut off or changed is said to be so', async () => {
    const whole = await fragmentOf([fresh]);
    for (const broken of [whole.slice(0, -9), '#s=', '#s=%3Cscript', '#s=AAAA', packed('{"layouts": [')]) await refused(broken, /cut off or changed/);
  });

  test('unknown keys, wrong types and numbers out of range are refused', async () => {
    for (const [value, message] of [
      [{ ...withLayout({}), more: 1 }, /unknown about the page/], [[], /not what it should be/], [{ layouts: [] }, /neither one layout nor two/],
      [{ layouts: Array(3).fill(plain(fresh)) }, /neither one layout nor two/], ['{"layouts":[{"__proto__":{}}]}', /unknown about a layout/],
      [withLayout({ seeder: 'none' }), /its seeder is none/], [withLayout({ seeder: 'wheat-tray-3d' }), /its seeder is none/], [withLayout({ seeder: 7 }), /its seeder is not/],
      [withLayout({ crop: 'gold' }), /its crop is none/], [withLayout({ accuracy: 'perfect' }), /its accuracy is none/], [withLayout({ accuracy: {} }), /its accuracy is none/],
      [withLayout({ motion: null }), /the motion is not/], [withLayout({ motion: { ...fresh.motion, frequency_hz: 1e9 } }), /frequency is out of its range/],
      [withLayout({ motion: { ...fresh.motion, amplitude_m: '1' } }), /amplitude is out/], [withLayout({ motion: { ...fresh.motion, direction_rad: 9 } }), /direction is out/],
      [withLayout({ holes: {} }), /holes are not/], [withLayout({ holes: Array(41).fill(fresh.holes[0]) }), /holes are not/],
      [withHole({ width_m: 0 }), /width of a hole is out/], [withHole({ centre_m: 0.07 }), /place of a hole is out/], [withHole({ centre_m: 9 }), /place of a hole is out/],
      [withHole({ open_at_s: -1 }), /opening time of a hole is out/], [withHole({ open_at_s: null }), /opening time of a hole is out/], [withHole({ extra: 1 }), /unknown about a hole/],
      [{ layouts: [{ ...plain(layouts.layoutOf(mixed)), motion: fresh.motion }] }, /no motion to be changed/],
    ]) await refused(typeof value === 'string' ? packed(value) : value, message);
  });

  test('an own seeder is looked at before anything is made of it', async () => {
    const own = { name: 'mine', title: 'Mine', toml: wheatText, crop: 'wheat', scene: wheat.scene };
    const withOwn = (changes) => withLayout({ seeder: { ...own, ...changes } });
    const withTray = (changes) => withOwn({ scene: { ...own.scene, tray: { ...own.scene.tray, ...changes } } });
    for (const [value, message] of [
      [withOwn({ name: 1 }), /name is not a text/], [withOwn({ title: 'x'.repeat(201) }), /at most 200/], [withOwn({ crop: 'gold' }), /crop is none/], [withOwn({ scene: [] }), /scene is not one/],
      [withOwn({ scene: { ...own.scene, lots: [] } }), /scene is not one/], [withOwn({ scene: { ...own.scene, space: '3d' } }), /in 3D/], [withTray({ holes: [null] }), /the tray is not/],
      [withTray({ length_m: 'long' }), /length of the tray/], [withTray({ fill: { count: -1 } }), /fill of the tray/], [withTray({ fill: 3 }), /fill of the tray/],
      [withOwn({ scene: { ...own.scene, hopper: 4 } }), /the hopper is not/], [withOwn({ scene: { ...own.scene, lots: [{ ...own.scene.lots[0], discs: [{}] }] } }), /a disc of a seed/],
      [withOwn({ live: true }), /unknown about its seeder/],
    ]) await refused(value, message);
  });
});

describe('undo', () => {
  test('steps are gone back and forth, and what was undone is forgotten by another', () => {
    const history = new History([fresh], textOfLayouts);
    const moved = [layouts.moveHole(fresh, 1, 164)], wider = [layouts.widenAll(fresh, 20)];
    assert.deepEqual([history.canUndo, history.canRedo, history.undo()], [false, false, [fresh]]);
    assert.ok(history.add(moved));
    assert.equal(history.add([layouts.moveHole(fresh, 1, 164)]), false);  // nothing new
    assert.ok(history.add(wider));
    assert.deepEqual([history.undo(), history.undo(), history.canUndo, history.redo(), history.canRedo], [moved, [fresh], false, moved, true]);
    assert.ok(history.add([fresh, fresh]));
    assert.deepEqual([history.canRedo, history.redo(), history.undo()], [false, [fresh, fresh], moved]);
  });
  test('only so many steps are remembered', () => {
    const history = new History(0, String);
    for (let k = 1; k <= 500; ++k) history.add(k);
    let steps = 0;
    for (; history.canUndo; ++steps) history.undo();
    assert.deepEqual([steps, history.now], [199, 301]);
  });
});

describe('what is kept', () => {
  const store = () => {
    const items = new Map();
    return { getItem: (name) => items.get(name) ?? null, setItem: (name, value) => items.set(name, value), items };
  };
  test('it comes back to the page that kept it, and to no other', () => {
    const storage = store();
    const kept = (place, text) => new Kept(() => storage, place, text);
    assert.equal(kept('/a.html', 'data').read(), '');
    assert.equal(kept('/a.html', 'data').write('#s=made'), true);
    assert.deepEqual([kept('/a.html', 'data').read(), kept('/b.html', 'data').read(), kept('/a.html', 'date').read()], ['#s=made', '', '']);
  });
  test('a browser that refuses, is full, or holds something else does no harm', () => {
    const refuses = () => { throw new Error('denied'); };
    const full = { getItem: () => null, setItem: refuses };
    assert.deepEqual([new Kept(refuses, '', '').read(), new Kept(refuses, '', '').write('x'), new Kept(() => full, '', '').write('x'), new Kept(() => null, '', '').write('x')], ['', false, false, false]);
    for (const value of ['{', '7', '[]', '{"mark":1}']) assert.equal(new Kept(() => ({ getItem: () => value }), '', '').read(), '');
  });
});

describe('a wanted sowing rate', () => {
  const task = { kg_per_ha: 180, spacing_cm: 15, speed_km_per_h: 8, rows: 3 };
  const table = (cells) => ({
    columns: [{ name: 'hole', unit: '' }, { name: 'seeds of', unit: '' }, { name: 'rate of the slice', unit: 'seeds/s' }, { name: 'rate of the slice', unit: 'g/s' }, { name: 'of the tray', unit: 'g/s' }],
    rows: [['1', 'all', '30', '1', '16'], ['all', 'all', ...cells]],
  });
  test('it is so many seeds a second of the tray', () => {
    const { g_per_s, seeds_per_s } = wantedRate(task, wheat.scene.lots);
    assert.ok(Math.abs(g_per_s - 18) < 1e-9 && Math.abs(seeds_per_s - 18 / 0.0296) < 1e-9, `${g_per_s} ${seeds_per_s}`);  // 180 kg/ha are 18 g/m2, of 0.15 m x 3 x 2.22 m/s
    const { seeds_per_s: mixture } = wantedRate(task, mixed.scene.lots);
    assert.ok(Math.abs(mixture - 18 / 0.35) < 1e-9, `${mixture}`);  // half the seeds weigh 0.6 g, half 0.1 g
  });
  test('the slice is set beside it where the tray has a depth, and the doubt always', () => {
    const outcome = { total_seeds_per_s: 85, said: { hole_table: table(['85', '2.5', '40']) } };
    const told = wantedWords(task, wheat.scene.lots, outcome);
    assert.equal(told.value, '608 seeds/s of the tray');
    assert.match(told.words, /^18 g\/s\. In 2D this layout sows 1360 seeds\/s, 2\.2 times that: 16 slices of 85\. Doubtful: in 2D .* weigh, before you sow\.$/);
    for (const said of [undefined, { hole_table: table(['0', '0', '0']) }, { hole_table: { columns: table([]).columns.slice(0, 4), rows: [['all', 'all', '85', '2.5']] } }]) {
      assert.match(wantedWords(task, wheat.scene.lots, { ...outcome, said }).words, /is not known.*Doubtful/);
    }
    assert.match(wantedWords(task, wheat.scene.lots, null).words, /^18 g\/s\. Doubtful/);
  });
  test('seeds of several sizes are left to the program', () => {
    assert.match(wantedWords(task, [{ ...wheat.scene.lots[0], sizes: {} }], null).words, /vibrosow plan/);
  });
  test('what was kept of it is looked at', () => {
    assert.deepEqual(taskOf(JSON.stringify({ ...task, more: 1 })), task);
    for (const text of ['', 'null', '7', JSON.stringify({ ...task, rows: 1e9 }), JSON.stringify({ ...task, kg_per_ha: '<b>' })]) assert.equal(taskOf(text), null);
  });
});

describe('the course', () => {
  const settled = (course) => course.queue;
  async function started() {
    const told = [];
    const simulator = await startSimulator();
    return { simulator, told, course: new Course(async () => simulator, (state) => told.push(state.status)) };
  }

  test('the last of several scenes is the one that is open', async () => {
    const { course, simulator } = await started();
    const opened = [];
    const open = simulator.open.bind(simulator);
    simulator.open = (text) => { opened.push(JSON.parse(text).tray.holes.length); return open(text); };
    for (const count of [2, 3, 4]) course.open(sceneOf(layouts.spreadHoles(fresh, count), data.crops));
    await settled(course);
    assert.deepEqual(opened, [4]);
    assert.deepEqual([course.state.status, course.state.prepared.holes, course.state.frame.time_s], ['ready', 4, 0]);
  });

  test('it runs to its end, and what comes late of a scene left is dropped', async () => {
    const { course } = await started();
    await new Promise((ended) => {
      const tell = course.changed;
      course.changed = (state) => { tell(state); if (state.status === 'ended') ended(); };
      course.open(sceneOf(fresh, data.crops), null);
    });
    assert.deepEqual(course.state.outcome.holes.map((hole) => hole.counted_all), course.state.frame.counted);
    course.play(1);
    assert.equal(course.state.status, 'ended');
    const asked = course.ask(course.opened);
    course.leave();
    const { outcome } = course.state;
    await asked;
    assert.deepEqual([course.state.status, course.state.outcome], ['changed', outcome]);
  });

  test('a run goes on with a change, or says what keeps it from that', async () => {
    const { course } = await started();
    const seen = [];
    await new Promise((ended) => {
      course.changed = (state) => {
        if (state.prepared && state.prepared !== seen[seen.length - 1]) seen.push(state.prepared);
        if (state.status === 'ended') ended();
      };
      course.open(sceneOf(fresh, data.crops), 10).then(async () => {
        assert.equal(await course.change(sceneOf(layouts.spreadHoles(fresh, 3), data.crops)), 'holes');
        assert.equal(await course.change(sceneOf(layouts.withMotion(fresh, { frequency_hz: 12 }), data.crops)), '');
      });
    });
    const [first, next] = seen;
    assert.deepEqual([seen.length, first.since_s, next.duration_s - next.since_s], [2, 0, first.duration_s]);
    assert.ok(course.state.frame.time_s > first.duration_s - 1e-9);
    assert.equal(await course.change(sceneOf(fresh, data.crops)), null);  // it has ended
  });

  test('a simulator that fails is replaced when the next scene is opened', async () => {
    const { course, simulator } = await started();
    let starts = 0;
    course.start = async () => {
      ++starts;
      return simulator;
    };
    simulator.play = ({ onFail }) => onFail(new Error('out of memory'));
    simulator.outcome = () => Promise.reject(new Error('out of memory'));
    await course.open(wheat.scene, 1);
    assert.deepEqual([course.state.status, course.state.problem], ['failed', 'out of memory']);
    await course.open(wheat.scene);
    assert.deepEqual([course.state.status, course.state.problem, starts], ['ready', '', 2]);
  });

  test('a simulator that cannot be started says why', async () => {
    const { course } = await started();
    course.start = () => Promise.reject(new Error('this browser has no WebAssembly'));
    await course.open(wheat.scene);
    assert.deepEqual([course.state.status, course.state.problem], ['failed', 'this browser has no WebAssembly']);
  });

  test('a scene that is refused or too much says why', async () => {
    const { course, simulator } = await started();
    await course.open(sceneOf(layouts.widenHole(fresh, 0, 70), data.crops));
    assert.deepEqual([course.state.status, course.state.problem], ['failed', 'tray.holes.width: 60 mm is as wide as this made-up simulator goes']);
    const many = structuredClone(wheat.scene);
    many.tray.fill.count = 1e9;
    simulator.open = () => assert.fail('it must not be prepared');
    await course.open(many);
    assert.match(course.state.problem, /^1000000200 seeds are more than the 20000 that a page can follow/);
    simulator.open = async () => ({ grains: 19_000, steps: 3e6, duration_s: 40, frame: {} });
    await course.open(wheat.scene);
    assert.match(course.state.problem, /57 billion seed-steps, are more than the 50 billion/);
    course.play(1);
    assert.equal(course.state.status, 'failed');
  });
});

describe('two layouts in step', () => {
  // Of a layout and one that takes four times as long: the times of both at each news, until the first has come to `until`.
  async function timesOf(pace, until, hold) {
    const times = [];
    let all = [];
    const tell = (done) => {
      hold(all);
      const now = all.map(({ course }) => course.state.frame?.time_s ?? 0);
      times.push(now);
      if (now[0] >= until) done();
    };
    const done = new Promise((reached) => {
      all = ['draft', 'design'].map((accuracy) => ({ pace, accuracy, course: new Course(startSimulator, () => tell(reached)) }));
      for (const { course, accuracy } of all) course.open(sceneOf({ ...fresh, accuracy }, data.crops), pace);
    });
    await done;
    for (const { course } of all) course.close();
    return times;
  }
  const apart = (times) => Math.max(...times.map(([a, b]) => Math.abs(a - b)));

  test('the faster one waits, and neither stands still', async () => {
    const times = await timesOf(1, 0.25, holdInStep);
    assert.ok(apart(times) <= 0.041, `${apart(times)}`);
    assert.ok(apart(await timesOf(1, 0.25, () => {})) > 0.1);  // by themselves
  });
  test('as fast as they can they are further apart', async () => {
    const gap = apart(await timesOf(null, 2, holdInStep));
    assert.ok(gap <= 0.501, `${gap}`);
  });
  test('one alone is free, and so is one beside another that has ended or failed', () => {
    const limits = [];
    holdInStep([{ course: { limit: (until) => limits.push(until) }, pace: 1 }]);
    assert.deepEqual(limits, [Infinity]);
    assert.deepEqual(['ended', 'failed'].map((status) => limitBeside({ status, frame: { time_s: 4 } }, 1)), [Infinity, Infinity]);
    assert.equal(limitBeside({ status: 'changed', frame: { time_s: 4 } }, 1), limitBeside({ status: 'opening', frame: null }, 1));  // it starts again
  });
});

test('two layouts are compared by rate and unevenness', () => {
  const outcome = (rates, cv) => ({
    holes: rates.map((rate, k) => ({ hole: k + 1, seeds_per_s: rate, low: rate - 2, high: rate + 2 })), total_seeds_per_s: rates.reduce((sum, rate) => sum + rate, 0),
    unevenness: { sentence: '', cv_percent: cv },
  });
  const { columns, rows } = comparisonOf(outcome([10, 20], 33.3), outcome([15, 20.5, 5], 5));
  assert.deepEqual(columns, ['hole 1', 'hole 2', 'hole 3', 'all holes', 'CV']);
  assert.deepEqual(rows[0].cells.map((cell) => cell.text), ['10', '20', '–', '30', '33.3 %']);
  assert.deepEqual(rows[2].cells.map((cell) => [cell.text, Boolean(cell.apart)]), [['+50 %', true], ['+2.5 %', false], ['–', false], ['+35 %', false], ['', false]]);
  assert.equal(comparisonSentence(outcome([10, 20], 33.3), outcome([15, 20.5, 5], 5)),
    'B lets out 35 % more seeds than A, 40.5 against 30 seeds/s; its holes differ less: CV 5 % against 33.3 %.');
  assert.match(comparisonSentence(null, outcome([1], 1)), /have to sow for a while/);
});

test('a seeder that is too much for a page is not offered, and why', () => {
  const made = structuredClone(madeUpStudio());
  Object.assign(made.seeders[0], { steps: 80e6 });
  made.seeders[1].scene.tray.fill.count = 20_001;
  made.seeders.push({ ...structuredClone(made.seeders[0]), name: 'shorter', steps: 60e6 });
  const { seeders, opened } = readStudioData(JSON.stringify(made));
  assert.deepEqual(seeders.map(({ live }) => live), [false, false, false, true]);
  assert.match(seeders[0].why_not, /^760 seeds in 80000000 steps, .* vibrosow run does it\.$/);
  assert.match(seeders[1].why_not, /^20001 seeds are more than/);
  assert.equal(opened.name, 'shorter');
});

test('data without a seeder to show are refused', () => {
  assert.throws(() => readStudioData('{"kind":"run"}'), /of the kind "run"/);
  assert.throws(() => readStudioData('{"kind":"studio","seeders":[{"live":false}]}'), /none of its seeders/);
  const made = madeUpStudio();
  const read = readStudioData(JSON.stringify({ ...made, opened: 'wheat-tray-3d' }));
  assert.deepEqual([read.asked.name, read.opened.name], ['wheat-tray-3d', 'wheat-tray']);
});

// The pages of made-up decisions and searches, in a browser.
import assert from 'node:assert/strict';
import test from 'node:test';
import * as in_ from './browser.mjs';
import { hostile, withPage } from './made_up_pages.mjs';
import { madeUpDecision, madeUpFront } from './made_up_studies.mjs';

function numbersIn(open, selector) {
  return open.$$eval(selector, (nodes) => nodes.map((node) => Number(node.dataset.layout)));
}

function numbersOf({ data }, standing) {
  return data.layouts.filter((layout) => layout.standing === standing).map(({ number }) => number);
}

const sorted = (numbers) => [...numbers].sort((a, b) => a - b);

test('a decision: the answer, its doubts, and the layouts as they stand', () => withPage(madeUpDecision('plane'), { bypass: true }, async (open) => {
  const made = madeUpDecision('plane');
  assert.equal(await open.locator('.headline').textContent(), made.data.headline);
  assert.match(await open.locator('.remarks').textContent(), /That is no guarantee.*Layout 4 failed: hole 3 lies beyond the rim/);
  assert.deepEqual(await numbersIn(open, '#ranking .ranks .first'), [11]);
  assert.deepEqual(sorted(await numbersIn(open, '#ranking .ranks .alike')), numbersOf(made, 'not shown to be worse'));
  assert.deepEqual(sorted(await numbersIn(open, '#ranking .ranks .apart')), numbersOf(made, 'worse'));
  assert.match(await open.locator('#ranking-sentence').textContent(),
    /^By rate layout 11 .* is the best: .* g\/s; of the others \d+ (is|are) not shown to be worse, \d+ are worse and \d+ are not compared\.$/);
  await open.getByRole('heading', { name: 'Layout 11', exact: true }).waitFor();
  assert.equal(await open.locator('#layout .standing').textContent(), 'Best.');
  assert.equal(await open.getByRole('textbox', { name: 'Wanted rate from, g/s' }).inputValue(), '12');
  assert.equal(await open.locator('#ranking .ranks li').first().locator('.wanted-line').count(), 2);
  assert.match(await open.locator('#question').textContent(), /confidence of 95 %.*Cost: 120 runs.*took 31.2 s/);
  await in_.assertReadsWell(open);
}));

test('a decision by another figure: by its own intervals', () => withPage(madeUpDecision('plane'), {}, async (open) => {
  await open.getByRole('combobox', { name: 'Figure', exact: true }).selectOption('clogged, %');
  assert.match(await open.locator('#ranking-sentence').textContent(), /has the least: 0 %; without intervals nothing says/);
}));

test('an undecided one names no best', () => withPage(madeUpDecision('plane', { isSure: false }), {}, async (open) => {
  assert.equal(await open.locator('#ranking .ranks .first').count(), 0);
  assert.match(await open.locator('#ranking-sentence').textContent(), /^By rate no layout is known to be the best; of the layouts \d+ may still be the best and \d+ are not compared\.$/);
  assert.match(await open.locator('#ranking .legend').textContent(), /undecided/);
}));

test('a front: the points as they stand, with the intervals of those that lead', () => withPage(madeUpFront('three_dimensional'), { bypass: true }, async (open) => {
  const made = madeUpFront('three_dimensional');
  for (const [name, standing] of [['on-front', 'on the front'], ['may-be', 'may be on the front'], ['dominated', 'dominated']]) {
    assert.deepEqual(sorted(await numbersIn(open, `#trade circle.${name}`)), numbersOf(made, standing), standing);
  }
  assert.equal(await open.locator('#trade .cross').count(), numbersOf(made, 'on the front').length + 1);
  assert.match(await open.locator('#trade-sentence').textContent(), /^For a high rate and a low power, no layout beats /);
  assert.equal(await open.locator('#trade .filter').getByRole('combobox', { name: 'Only count' }).count(), 1);
  const point = open.locator('#trade circle.dominated').first();
  const number = Number(await point.getAttribute('data-layout'));
  await point.focus();
  await open.keyboard.press('Enter');
  await open.getByRole('heading', { name: `Layout ${number}`, exact: true }).waitFor();
  assert.match(await open.locator('#layout .standing').textContent(), /^Dominated\. Layout \d+ beats it by the means, rate .* against .* and power /);
  assert.equal(await open.locator('#layout .drawing').count(), 2);
  await in_.assertReadsWell(open);
}));

// How a point is drawn: its fill, its line and, of what lies over it, the fill.
function lookOf(open, number) {
  return open.evaluate((layout) => {
    const { fill, stroke, strokeWidth } = getComputedStyle(document.querySelector(`#trade circle[data-layout="${layout}"]`));
    return { fill, stroke, strokeWidth, over: getComputedStyle(document.querySelector('#trade .ring')).fill };
  }, number);
}

test('what may be on the front is not drawn as what is, chosen or not', () => withPage(madeUpFront('plane'), {}, async (open) => {
  const made = madeUpFront('plane');
  const [sure] = numbersOf(made, 'on the front'), [unsure] = numbersOf(made, 'may be on the front');
  for (const number of [sure, unsure]) {
    await open.evaluate((layout) => { location.hash = `layout=${layout}`; }, number);
    await open.getByRole('heading', { name: `Layout ${number}`, exact: true }).waitFor();
    assert.equal((await lookOf(open, number)).over, 'none');
  }
  assert.notEqual((await lookOf(open, sure)).fill, (await lookOf(open, unsure)).fill);
  const dots = await open.$$eval('#trade .legend .dot', (nodes) => nodes.slice(0, 2).map((node) => getComputedStyle(node).backgroundColor));
  assert.notEqual(dots[0], dots[1]);
}));

test('a value at the end of its range is marked, in the table and of the chosen layout', () => withPage(madeUpFront('plane'), { hash: '#layout=7' }, async (open) => {
  const cells = await open.locator('#layouts tbody tr[data-layout="7"] td').allTextContents();
  assert.match(cells[1], /^6 ⊣ end of its range$/);
  assert.equal(await open.locator('#layouts .at-edge').count(), 1);
  assert.match(await open.locator('#layout .settings').textContent(), /frequency6 Hz, the end of its range/);
  assert.match(await open.locator('#layouts').textContent(), /⊣: at the end of the range that was searched; better ones may lie beyond\./);
  assert.match(await open.locator('.light.mild .remarks').textContent(), /Layout 7 leads at the end of the range of frequency: better ones may lie beyond\./);
}));

test('an interval that goes on beyond the diagram ends in an arrow', () => {
  const made = madeUpFront('plane');
  made.data.layouts[6].means.rate_g_per_s.half_width = 1e3;
  return withPage(made, { hash: '#layout=7' }, async (open) => {
    await open.getByRole('heading', { name: 'Layout 7', exact: true }).waitFor();
    const arrows = await open.$$eval('#trade .cross', (paths) => paths.map((path) => (path.getAttribute('d').match(/l/g) ?? []).length));
    assert.equal(Math.max(...arrows), 4);  // two strokes at either end
    assert.equal(arrows.filter((count) => count > 0).length, 2);  // as one that leads, and as the chosen one
    assert.match(await open.locator('#trade .legend').textContent(), /An arrow: it goes on\./);
  });
});

test('a search by one goal ranks by it', () => withPage(madeUpFront('plane', { goals: 1 }), {}, async (open) => {
  assert.equal(await open.locator('#trade').count(), 0);
  assert.match(await open.locator('#ranking-sentence').textContent(), /^By rate layout \d+ .* has the most/);
}));

for (const [name, make] of [['decision', madeUpDecision], ['front', madeUpFront]]) {
  test(`hostile names in a ${name} stay text`, () => withPage(make('plane', { title: hostile, layout: hostile }), {}, async (open) => {
    assert.equal(await open.locator('h1').textContent(), hostile);
    assert.match(await open.locator('#layout-title').textContent(), /onerror=alert\(1\)>$/);
    assert.equal(await open.locator('img').count(), 0);
  }));
}

// The simulator of the pages: small, and with the native program's own bytes on every shipped seeder. Skipped where it is not built
// (scripts/web); the bytes also where no program is given (VIBROSOW=build/release/src/vibrosow).
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import path from 'node:path';
import test from 'node:test';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

const root = path.join(path.dirname(fileURLToPath(import.meta.url)), '..', '..');
const wasm = path.join(root, 'build', 'wasm');
const notBuilt = existsSync(path.join(wasm, 'web', 'core', 'simulator-simd.wasm')) ? false : 'build/wasm is not there';
const native = process.env.VIBROSOW ? path.join(path.dirname(process.env.VIBROSOW), '..', 'tests') : null;
const notNative = notBuilt || (native && existsSync(path.join(native, 'scene_json')) ? false : 'no program is given');

const seconds = { plane: 0.1, space: 0.005 }; // of each run; chaos makes any other bit another energy by then

function seeders() {
  return ['seeders', 'seeders/papers', 'seeders/verification'].flatMap((folder) => readdirSync(path.join(root, folder))
    .filter((name) => name.endsWith('.toml')).map((name) => path.join(folder, name)));
}

function shortScene(seeder) {
  const scene = JSON.parse(execFileSync(path.join(native, 'scene_json'), [path.join(root, seeder)], { encoding: 'utf8' }));
  const space = scene.space === '3d' ? 'space' : 'plane';
  scene.run.duration_s = seconds[space];
  scene.run.measure_from_s = 0;
  scene.numerics.allow_long_step = true; // as some papers' own steps are
  delete scene.record;
  return { scene, space, text: JSON.stringify(scene) };
}

function outcome(command, args, input) {
  return execFileSync(command, args, { input, encoding: 'utf8', maxBuffer: 1e8 });
}

for (const name of ['simd', 'scalar']) {
  test(`the module ${name} is at most 640 kB when it is packed`, { skip: notBuilt }, () => {
    const packed = gzipSync(readFileSync(path.join(wasm, 'web', 'core', `simulator-${name}.wasm`)), { level: 9 }).length;
    assert.ok(packed <= 640e3, `${packed} bytes`);
  });
}

test('the module of browsers without vectors has none', { skip: notBuilt }, () => {
  const validate = (name) => WebAssembly.validate(readFileSync(path.join(wasm, 'web', 'core', `simulator-${name}.wasm`)));
  assert.ok(validate('scalar') && validate('simd'));
  const withoutVectors = ['--mvp-features', '--enable-exception-handling', '--enable-sign-ext', '--enable-bulk-memory', '--enable-mutable-globals',
    '--enable-nontrapping-float-to-int', '--enable-reference-types'];
  const read = (name) => execFileSync('wasm-opt', [...withoutVectors, path.join(wasm, 'web', 'core', `simulator-${name}.wasm`), '-o', '/dev/null'], { stdio: 'pipe' });
  read('scalar');
  assert.throws(() => read('simd'));
});

// The module without a worker: its exports, a function that hands it a text, and one that reads its answers. `clock()`: ms.
async function loaded(clock = () => 0) {
  const bytes = readFileSync(path.join(wasm, 'web', 'core', 'simulator-scalar.wasm'));
  const none = () => 0;
  const tell = (id, precision, at) => { new DataView(core.memory.buffer).setBigUint64(at, BigInt(clock() * 1e6), true); return 0; };
  const system = { clock_time_get: tell, environ_sizes_get: none, environ_get: none, proc_exit: none };
  const { instance: { exports: core } } = await WebAssembly.instantiate(bytes, { wasi_snapshot_preview1: system, env: { emscripten_notify_memory_growth: none } });
  core._initialize();
  const memory = () => new Uint8Array(core.memory.buffer);
  const answer = (address) => JSON.parse(new TextDecoder().decode(memory().subarray(address, memory().indexOf(0, address))));
  const given = (text) => {
    const packed = new TextEncoder().encode(`${text}\0`), address = core.malloc(packed.length);
    memory().set(packed, address);
    return address;
  };
  const open = (text) => answer(core.open_scene(given(text), 1)), change = (scene) => answer(core.change_scene(given(JSON.stringify(scene))));
  return { core, open, change, answer };
}

test('a slice ends in time, whatever the clock says', { skip: notNative }, async () => {
  const { text } = shortScene('seeders/wheat-tray.toml');
  for (const sinceStart of [0, 2 ** 31 / 1e6 - 2, 2 ** 32 / 1e6 - 2, 2 ** 31 - 2, 1e11]) { // ms: where 32 bits of ns, us or ms are full
    let now = Math.round(sinceStart), looks = 0;
    const { core, open } = await loaded(() => { ++looks; return now++; });
    open(text);
    looks = 0;
    assert.equal(core.advance(Infinity, 5), 0);
    assert.ok(looks <= 7, `${looks} looks at a clock that began at ${sinceStart} ms`);
  }
});

test('rates of a run that goes on are of the time so far', { skip: notNative }, async () => {
  const { scene } = shortScene('seeders/wheat-tray.toml');
  const { core, open, answer } = await loaded();
  open(JSON.stringify({ ...scene, run: { ...scene.run, duration_s: 0.4, measure_from_s: 0.1 } }));
  core.advance(0.2, 1e9);
  const { window_s: window, holes, remarks } = answer(core.outcome());
  assert.ok(!remarks.some(({ text }) => /interrupted/.test(text)), JSON.stringify(remarks));
  assert.ok(Math.abs(window[1] - 0.2) < 1e-3, `until ${window[1]} s`);
  for (const { counted, rate } of holes) assert.ok(Math.abs(rate - counted / (window[1] - window[0])) < 1e-9);
  while (!core.advance(1, 1e9));
  const whole = answer(core.outcome()).window_s;  // two periods of 9 Hz
  assert.ok(Math.abs(whole[0] - (0.4 - 2 / 9)) < 1e-9 && whole[1] === 0.4, `${whole}`);
});

test('shake and holes change while it runs, and counts begin anew', { skip: notNative }, async () => {
  const scene = { ...shortScene('seeders/wheat-tray.toml').scene, run: { duration_s: 0.5, measure_from_s: 0.1, count_below_m: 0.02, start: 'at-rest' } };
  const { core, open, change, answer } = await loaded();
  open(JSON.stringify(scene));
  core.advance(0.3, 1e9);
  const { grains, counted } = answer(core.state_now());
  assert.ok(counted.some((count) => count > 0));
  const faster = structuredClone(scene);
  faster.tray.motion.frequency_hz *= 1.2;
  for (const hole of faster.tray.holes) hole.width_m *= 1.3;
  assert.equal(change({ ...scene, lots: scene.lots.map((lot) => ({ ...lot, diameter_m: 1.1 * lot.diameter_m })) }).restarts, 'seeds');
  const { restarts, state } = change(faster);
  assert.deepEqual([restarts, state.waiting, state.changes], ['', 'motion', 0]);
  core.advance(0.4, 1e9);
  const now = answer(core.state_now()), opened = answer(core.opened_now());
  assert.deepEqual([now.waiting, now.changes], ['', 2]);  // the shake at once, the holes at the end of a stroke
  assert.ok(Math.abs(now.time_s - 0.4) < 1e-3 && opened.since_s > 0.3 && opened.since_s < 0.36, `${now.time_s} ${opened.since_s}`);
  assert.ok(Math.abs(opened.duration_s - opened.since_s - 0.5) < 1e-9);
  assert.ok(now.grains > 0.5 * grains && now.counted.reduce((sum, count) => sum + count) < counted.reduce((sum, count) => sum + count));
  assert.equal(opened.vessels.find(({ name }) => name === 'tray').holes[0].half_x_mm, 500 * faster.tray.holes[0].width_m);
});

test('a scene that cannot be read or is in space is refused with a sentence', { skip: notNative }, async () => {
  const { open } = await loaded();
  assert.match(open('{"title": 1}').error, /scene\.title/);
  assert.match(open(shortScene('seeders/pea-tray-3d.toml').text).error, /plane alone/);
});

for (const seeder of seeders()) {
  test(`WebAssembly gives the program's bytes: ${seeder}`, { skip: notNative }, () => {
    const { space, text } = shortScene(seeder);
    const wanted = outcome(path.join(native, 'core', 'run_scene'), ['1'], text);
    const programs = space === 'plane' ? ['run_scene', 'run_scene_simd'] : ['run_scene'];
    for (const program of programs) {
      assert.equal(outcome('node', ['--no-experimental-fetch', path.join(wasm, 'tests', 'core', `${program}.js`), '1'], text), wanted, program);
    }
  });
}

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
  return { space, text: JSON.stringify(scene) };
}

function outcome(command, args, input) {
  return execFileSync(command, args, { input, encoding: 'utf8', maxBuffer: 1e8 });
}

for (const name of ['simd', 'scalar']) {
  test(`the module ${name} is at most 600 kB when it is packed`, { skip: notBuilt }, () => {
    const packed = gzipSync(readFileSync(path.join(wasm, 'web', 'core', `simulator-${name}.wasm`)), { level: 9 }).length;
    assert.ok(packed <= 600e3, `${packed} bytes`);
  });
}

test('the module of browsers without vectors has none', { skip: notBuilt }, () => {
  const validate = (name) => WebAssembly.validate(readFileSync(path.join(wasm, 'web', 'core', `simulator-${name}.wasm`)));
  assert.ok(validate('scalar') && validate('simd'));
  const features = execFileSync('wasm-opt', ['--mvp-features', '--enable-exception-handling', '--enable-sign-ext', '--enable-bulk-memory', '--enable-mutable-globals',
    '--enable-nontrapping-float-to-int', '--enable-reference-types', path.join(wasm, 'web', 'core', 'simulator-scalar.wasm'), '-o', '/dev/null'], { stdio: 'pipe' });
  assert.ok(features);
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

// The worker that simulates: one scene at a time, in the WebAssembly module (simulator.cpp). Bundled into the page as text.
import { Pace } from './pace.mjs';

const frameEvery = 29, slice = 12; // ms of the clock, a slice at most; with posting and drawing a picture takes some 8 ms more
const fieldsOfGrain = 6;

let core = null; // the module's exports
let limit = Infinity; // s of simulated time, which no run passes
let changes = 0; // of the run that is open, as far as they have been told
let running = null; // { id, pace, timer, since: [[wall, simulated], ..], shown }

function memoryView() {
  return new DataView(core.memory.buffer);
}

// The few calls of a system that the module makes; it has no files, and nobody reads what it would print.
const system = {
  clock_time_get(clock, precision, at) { memoryView().setBigUint64(at, BigInt(Math.round(performance.now() * 1e6)), true); return 0; },
  environ_sizes_get(count, bytes) { memoryView().setUint32(count, 0, true); memoryView().setUint32(bytes, 0, true); return 0; },
  environ_get: () => 0,
  proc_exit(code) { throw new Error(`the simulator ended itself (${code})`); },
};

async function load(bytes) {
  const { instance } = await WebAssembly.instantiate(bytes, { wasi_snapshot_preview1: system, env: { emscripten_notify_memory_growth() {} } });
  core = instance.exports;
  core._initialize();
}

function textAt(address) {
  const memory = new Uint8Array(core.memory.buffer);
  return new TextDecoder().decode(memory.subarray(address, memory.indexOf(0, address)));
}

function parsed(address) {
  const value = JSON.parse(textAt(address));
  if (value.error) throw new Error(value.error);
  return value;
}

// What `call(address)` answers of a text.
function given(text, call) {
  const bytes = new TextEncoder().encode(`${text}\0`);
  const address = core.malloc(bytes.length);
  new Uint8Array(core.memory.buffer).set(bytes, address);
  try {
    return parsed(call(address));
  } finally {
    core.free(address);
  }
}

/** Simulated over real time, of the last second or so. */
function speedRatio() {
  if (!running || running.since.length < 2) return null;
  const [[wall, simulated]] = running.since, [lastWall, lastSimulated] = running.since.at(-1);
  return lastWall > wall ? (lastSimulated - simulated) / ((lastWall - wall) / 1e3) : null;
}

function frame(state) {
  const n = state.grains;
  const values = new Float32Array(core.memory.buffer, core.grains_now(), fieldsOfGrain * n);
  const [x, y, angle, radius, speed, lot] = Array.from({ length: fieldsOfGrain }, (_, k) => values.slice(k * n, (k + 1) * n));
  return {
    time_s: state.time_s, x, y, angle, radius, speed, lot: Uint16Array.from(lot), vessels: state.vessels, counted: state.counted, spilled: state.spilled,
    waiting: state.waiting, speed_ratio: speedRatio(),
  };
}

// What is prepared, with the frame of its beginning.
function withFrame(opened) {
  changes = opened.state.changes;
  return { ...opened, frame: frame(opened.state) };
}

function buffersOf({ x, y, angle, radius, speed, lot }) {
  return [x, y, angle, radius, speed, lot].map(({ buffer }) => buffer);
}

// The next slice comes as a message: browsers hold a timer that sets itself back for 4 ms, a third of a slice.
const { port1: slices, port2: nextSlice } = new MessageChannel();
slices.onmessage = ({ data: id }) => {
  if (running?.id === id) guarded(running);
};

function pause() {
  if (running) clearTimeout(running.timer);
  running = null;
}

function step(run) {
  const now = performance.now();
  const due = Math.min(run.pace.due(now), limit);
  const ended = core.advance(due, Math.max(1, Math.min(slice, run.shown + frameEvery - now))) === 1;
  const after = performance.now();
  const state = parsed(core.state_now());
  run.since.push([after, state.time_s]);
  while (run.since.length > 2 && after - run.since[0][0] > 1000) run.since.shift();
  run.pace.forgive(after, state.time_s);
  if (state.changes !== changes) postMessage({ kind: 'changed', run: run.id, prepared: withFrame(parsed(core.opened_now())) });
  if (ended || after - run.shown >= frameEvery) {
    run.shown = after;
    const shown = frame(state);
    postMessage({ kind: ended ? 'ended' : 'frame', run: run.id, frame: shown, outcome: ended ? parsed(core.outcome()) : null }, buffersOf(shown));
  }
  if (ended) pause();
  else if (state.time_s >= due) run.timer = setTimeout(guarded, 4, run);
  else nextSlice.postMessage(run.id);
}

function guarded(run) {
  try {
    step(run);
  } catch (error) {
    pause();
    postMessage({ kind: 'failed', run: run.id, message: error.message });
  }
}

const answers = {
  load: ({ bytes }) => load(bytes),
  open({ text, seed }) {
    pause();
    return withFrame(given(text, (address) => core.open_scene(address, seed)));
  },
  change: ({ text }) => given(text, core.change_scene).restarts,
  outcome: () => parsed(core.outcome()),
};

const orders = {
  play({ pace, run }) {
    pause();
    running = { id: run, pace: new Pace(pace, performance.now(), parsed(core.state_now()).time_s), since: [], shown: 0, timer: 0 };
    guarded(running);
  },
  pause,
  limit({ until }) { limit = until; },
};

onmessage = async ({ data }) => {
  if (orders[data.kind]) {
    orders[data.kind](data);
    return;
  }
  try {
    postMessage({ kind: 'answer', question: data.question, value: await answers[data.kind](data) });
  } catch (error) {
    postMessage({ kind: 'answer', question: data.question, error: error.message });
  }
};

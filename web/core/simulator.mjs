// A simulation that runs in the page, in a worker of its own.
import workerText from './worker.mjs?text';
import { bytesOfBase64 } from '../report/page_data.mjs';

// The smallest module with an instruction of 128 bits.
const simdModule = [0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11];

const modules = new Map(); // bytes by name, unpacked once a page

async function unpacked(name) {
  const packed = document.getElementById(`simulator-${name}`)?.textContent.trim();
  if (!packed) throw new Error('this page has no simulator in it');
  const stream = new Blob([bytesOfBase64(packed)]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(stream).arrayBuffer();
}

function moduleBytes(name) {
  if (!modules.has(name)) modules.set(name, unpacked(name));
  return modules.get(name);
}

/** Whether this page can simulate: some, such as a report of a run in space, have no simulator in them. */
export function hasSimulator() {
  return Boolean(document.getElementById('simulator-simd')?.textContent.trim());
}

/** What a studio shows of an outcome, from what a run's page says of the run. */
function figuresOf(said) {
  const { status, end_time_s, guard, remarks, unevenness } = said;
  const holes = said.holes.map(({ hole, counted, counted_all, rate, rate_low, rate_high, longest_pause_s }) => (
    { hole, counted, counted_all, seeds_per_s: rate, low: rate_low, high: rate_high, longest_pause_s }));
  const known = holes.every(({ seeds_per_s }) => seeds_per_s !== null);
  return { status, end_time_s, guard, remarks, unevenness, holes, total_seeds_per_s: known ? holes.reduce((sum, { seeds_per_s }) => sum + seeds_per_s, 0) : null, said };
}

class Simulator {
  #worker;
  #questions = new Map();
  #asked = 0;
  #run = 0;
  #listeners = null;

  constructor(worker, simd) {
    this.#worker = worker;
    this.simd = simd;
    worker.onmessage = ({ data }) => this.#hear(data);
    worker.onerror = (event) => this.#fail(new Error(event.message || 'the simulator stopped'));
  }

  #fail(error) {
    for (const { reject } of this.#questions.values()) reject(error);
    this.#questions.clear();
    this.#listeners?.onFail?.(error);
  }

  #hear(data) {
    if (data.kind === 'answer') {
      const { resolve, reject } = this.#questions.get(data.question);
      this.#questions.delete(data.question);
      if (data.error === undefined) resolve(data.value);
      else reject(new Error(data.error));
      return;
    }
    if (data.run !== this.#run) return; // of a scene that is no longer open
    if (data.kind === 'failed') this.#listeners?.onFail?.(new Error(data.message));
    else if (data.kind === 'changed') this.#listeners?.onChange?.(data.prepared);
    else this.#listeners?.onFrame?.(data.frame);
    if (data.kind === 'ended') this.#listeners?.onEnd?.(figuresOf(data.outcome));
  }

  #ask(message, transfer = []) {
    const question = ++this.#asked;
    return new Promise((resolve, reject) => {
      this.#questions.set(question, { resolve, reject });
      this.#worker.postMessage({ ...message, question }, transfer);
    });
  }

  load(bytes) {
    return this.#ask({ kind: 'load', bytes });
  }

  /** Stops what ran and begins with a scene (its JSON as text). Throws what is wrong with it. */
  open(text, seed = 1) {
    ++this.#run;
    return this.#ask({ kind: 'open', text, seed });
  }

  /**
   * Takes the run that goes on to another scene. Promises what keeps it from that, one of the core's obstacles; "" where it goes on, now
   * or while it plays: then `onChange` has what is prepared from there on.
   */
  change(text) {
    return this.#ask({ kind: 'change', text });
  }

  /** `pace`: simulated seconds a second at most; null: as fast as it can. */
  play({ pace, ...listeners }) {
    this.#listeners = listeners;
    this.#worker.postMessage({ kind: 'play', pace, run: ++this.#run });
  }

  /** No run passes this simulated time (s), until another is said. */
  limit(until) {
    this.#worker.postMessage({ kind: 'limit', until });
  }

  pause() {
    this.#worker.postMessage({ kind: 'pause' });
  }

  /** What has come of the run so far. */
  async outcome() {
    return figuresOf(await this.#ask({ kind: 'outcome' }));
  }

  close() {
    this.#worker.terminate();
  }
}

/** A simulator in its own worker. Throws a sentence where the browser cannot. */
export async function startSimulator() {
  const simd = WebAssembly.validate(new Uint8Array(simdModule));
  const bytes = await moduleBytes(simd ? 'simd' : 'scalar');
  const address = URL.createObjectURL(new Blob([workerText], { type: 'text/javascript' }));
  const worker = new Worker(address);
  URL.revokeObjectURL(address);
  const simulator = new Simulator(worker, simd);
  await simulator.load(bytes);
  return simulator;
}

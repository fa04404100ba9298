// A crowd of balls in space, and what a page asks of WebGL to draw it.
import { encodeRecording } from './encoder.mjs';
import { madeUpRun } from './made_up_run.mjs';

const unit = 1e-5;     // m
const radius = 1e-3;   // m
const across = 20;     // balls in a row, and rows in a layer
const tremble = 1e-4;  // m

/** A run of so many balls, no two frames alike, `step` (s) apart, without forces. */
export function madeUpCrowd(count, { frames = 4, step = 1 / 40 } = {}) {
  const { data } = madeUpRun('three_dimensional');
  const place = (id) => [id % across, Math.floor(id / across) % across, Math.floor(id / across ** 2)].map((step_) => (2 * step_ + 1) * radius);
  const made = Array.from({ length: frames }, (_, frame) => ({
    time: frame * step, poses: [[0, 0, 0, 0], [0, 0, 0, 0]],
    grains: Array.from({ length: count }, (__, id) => {
      const [z, y, x] = place(id);
      return { id, lot: 0, radius, start: [x, y, z], values: [x, y + tremble * ((id + frame) % 3), z].map((value) => Math.round(value / unit)) };
    }),
  }));
  return { data, recording: encodeRecording({ frames: made, version: 1, perBlock: 4, vessels: ['tray', 'hopper'], fields: ['x', 'y', 'z'], units: [unit, unit, unit] }) };
}

/** Counts in window.asked what is asked of WebGL: draw calls, and bytes that are uploaded. For a page's first script. */
export function countGl() {
  window.asked = { draws: 0, bytes: 0 };
  const watch = (name, note) => {
    const own = WebGL2RenderingContext.prototype[name];
    WebGL2RenderingContext.prototype[name] = function watched(...given) {
      note(given);
      return own.apply(this, given);
    };
  };
  const sizeOf = (data) => data?.byteLength ?? (typeof data === 'number' ? data : 0);
  for (const name of ['drawArrays', 'drawElements', 'drawArraysInstanced', 'drawElementsInstanced']) watch(name, () => { ++window.asked.draws; });
  watch('bufferData', ([, data]) => { window.asked.bytes += sizeOf(data); });
  watch('bufferSubData', ([, , data]) => { window.asked.bytes += sizeOf(data); });
  watch('texImage2D', (given) => { window.asked.bytes += sizeOf(given[8]); });
}

/** Plays the replay from its beginning until so many pictures were painted, in the page: [{ script (ms), draws, bytes }] of each. Needs countGl. */
export function playedPictures(count) {
  const canvas = document.querySelector('#replay-canvas');
  const play = [...document.querySelectorAll('.controls button')].find((button) => button.getAttribute('aria-label') === 'Play');
  return new Promise((done) => {
    const pictures = [];
    new MutationObserver((_, observer) => {
      pictures.push({ script: Number(canvas.dataset.scriptMs), ...window.asked });
      window.asked = { draws: 0, bytes: 0 };
      if (pictures.length < count) return;
      observer.disconnect();
      play.click();
      done(pictures);
    }).observe(canvas, { attributeFilter: ['data-script-ms'] });
    window.asked = { draws: 0, bytes: 0 };
    play.click();
  });
}

/** Of played pictures those that lie between frames: the first ones, which upload nothing, are of the frame that stood there before. */
export function betweenFrames(pictures) {
  return pictures.slice(pictures.findIndex(({ bytes }) => bytes > 0));
}

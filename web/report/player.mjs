// The replay's clock: which frame is shown, and its course while it plays.

/** The last frame not later than `time`; the first before that. `times` ascend. */
export function frameAt(times, time) {
  let low = 0, high = times.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle - 1;
  }
  return low;
}

const longestPause = 1000;  // ms from frame to frame: beyond it nobody looked, as in a hidden tab, and the run goes on from where it was

export class Player {
  constructor(times) {
    this.times = times;
    this.index = 0;
    this.part = 0;        // of the way to the next frame
    this.smooth = false;  // whether listeners are told of what lies between frames
    this.speed = 1;
    this.playing = false;
    this.listeners = new Set();
  }

  get time() {
    return this.times[this.index];
  }

  /** The moment that is shown, s; between frames while it plays smoothly. */
  get moment() {
    return this.part === 0 ? this.time : this.time + this.part * (this.times[this.index + 1] - this.time);
  }

  get last() {
    return this.times.length - 1;
  }

  onChange(listener) {
    this.listeners.add(listener);
  }

  tell() {
    this.listeners.forEach((listener) => listener(this));
  }

  show(index) {
    this.index = Math.min(this.last, Math.max(0, index));
    this.part = 0;
    this.begin = null;
    this.tell();
  }

  showTime(time) {
    this.show(frameAt(this.times, time));
  }

  step(by) {
    this.pause();
    this.show(this.index + by);
  }

  setSpeed(speed) {
    this.speed = speed;
    this.begin = null;
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  play() {
    if (this.index === this.last) Object.assign(this, { index: 0, part: 0 });
    this.playing = true;
    this.begin = null;
    requestAnimationFrame((now) => this.tick(now));
    this.tell();
  }

  pause() {
    if (!this.playing) return;
    this.playing = false;
    this.tell();
  }

  // `begin`: when this stretch of playing began, on the wall and in the run.
  tick(now) {
    if (!this.playing) return;
    if (now - this.ticked > longestPause) this.begin = null;
    this.ticked = now;
    this.begin = this.begin ?? { wall: now, run: this.moment };
    const time = this.begin.run + ((now - this.begin.wall) / 1000) * this.speed;
    const index = frameAt(this.times, time);
    if (index === this.last) this.playing = false;
    if (index !== this.index || !this.playing || this.smooth) {
      this.index = index;
      this.part = this.smooth && this.playing ? (time - this.time) / (this.times[index + 1] - this.time) : 0;
      this.tell();
    }
    if (this.playing) requestAnimationFrame((later) => this.tick(later));
  }
}

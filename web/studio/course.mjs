// The course of a simulation: one scene at a time, from its start. Whatever is told of a scene that is no longer the one shown is
// dropped.
import { tooLarge, tooLong } from './limits.mjs';

const outcomeEvery = 500;  // ms

const nothing = { prepared: null, frame: null, outcome: null, problem: '' };

/**
 * `state`: { status, prepared, frame, outcome, problem }. The status is "opening", "ready" (at the start), "playing", "paused",
 * "ended", "changed" (the scene shown is no longer the one that ran), or "failed", and then `problem` says why.
 */
export class Course {
  /** `start()` promises a simulator; it is asked when the first scene is opened, and again where a simulator has failed. */
  constructor(start, changed) {
    Object.assign(this, { start, changed, simulator: null, until: Infinity, opened: 0, queue: Promise.resolve(), state: { ...nothing, status: 'opening' } });
  }

  tell(news) {
    this.state = { ...this.state, ...news };
    this.changed(this.state);
  }

  /** Opens a scene, an object, and plays it at `pace` where that is given. One that comes meanwhile takes its place. */
  open(scene, pace) {
    const turn = ++this.opened;
    this.rest();
    const problem = tooLarge(scene);
    if (problem) this.fail(problem);
    else this.tell({ status: 'opening', problem: '' });
    this.queue = this.queue.then(() => (problem || turn !== this.opened ? null : this.prepare(turn, scene, pace)));
    return this.queue;
  }

  async prepare(turn, scene, pace) {
    try {
      this.simulator ??= await this.start();
      this.simulator.limit(this.until);
      if (this.closed) this.drop();
      if (turn !== this.opened) return;
      const prepared = await this.simulator.open(JSON.stringify(scene));
      if (turn !== this.opened) return;
      const problem = tooLong(prepared);
      this.tell({ prepared, frame: prepared.frame, outcome: null, problem, status: problem ? 'failed' : 'ready' });
      if (!problem && pace !== undefined) this.play(pace);
    } catch (error) {
      if (turn === this.opened) this.fail(error.message);
    }
  }

  // Nothing of the scene before is true of one that cannot be opened.
  fail(problem) {
    this.tell({ ...nothing, status: 'failed', problem });
  }

  /** The scene on the page is another than the one that ran: it rests until the next is opened. `of`: what is still shown of it meanwhile. */
  leave(of = this.state) {
    ++this.opened;
    this.rest();
    this.tell({ ...of, status: 'changed' });
  }

  /** The same where the next is of another seeder, of which what is shown says nothing. */
  leaveSeeder() {
    this.leave(nothing);
  }

  /** Whether a run is under way, which may go on as another scene. */
  get isUnderWay() {
    return ['playing', 'paused'].includes(this.state.status);
  }

  /** Takes the run to another scene while it goes on. Promises what keeps it from that, "" where it goes on; null: it is no longer under way. */
  async change(scene) {
    const turn = this.opened;
    const obstacle = await this.simulator.change(JSON.stringify(scene)).catch(() => 'plan');
    return turn === this.opened && this.isUnderWay ? obstacle : null;
  }

  /** `pace`: simulated seconds a second at most; null: as fast as it can. */
  play(pace) {
    if (!['ready', 'paused', 'playing'].includes(this.state.status)) return;
    const turn = this.opened;
    const current = (act) => (news) => { if (turn === this.opened) act(news); };
    this.rest();
    this.asking = setInterval(() => this.ask(turn), outcomeEvery);
    this.tell({ status: 'playing' });
    this.simulator.play({
      pace,
      onFrame: current((frame) => this.tell({ frame })),
      onChange: current((prepared) => this.tell({ prepared, frame: prepared.frame, outcome: null })),
      onEnd: current((outcome) => this.end({ status: 'ended', outcome })),
      onFail: current((error) => {
        this.drop();
        this.end({ status: 'failed', problem: error.message });
      }),
    });
  }

  /** No run passes this simulated time (s), until another is said. */
  limit(until) {
    if (until === this.until) return;
    this.until = until;
    this.simulator?.limit(until);
  }

  pause() {
    if (this.state.status !== 'playing') return;
    this.rest();
    this.tell({ status: 'paused' });
    this.ask(this.opened);
  }

  end(news) {
    clearInterval(this.asking);
    this.tell(news);
  }

  rest() {
    clearInterval(this.asking);
    if (this.state.status === 'playing') this.simulator.pause();
  }

  async ask(turn) {
    const outcome = await this.simulator.outcome().catch(() => null);  // a simulator that fails says so itself
    if (outcome && turn === this.opened && ['playing', 'paused'].includes(this.state.status)) this.tell({ outcome });
  }

  drop() {
    this.simulator?.close();
    this.simulator = null;
  }

  close() {
    this.closed = true;
    ++this.opened;
    this.rest();
    this.drop();
  }
}

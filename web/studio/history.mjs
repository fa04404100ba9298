// What was on the page, one step a gesture: to be undone and done again.

const most = 200;  // steps that are remembered

export class History {
  /** `first`: what is on the page to begin with; `textOf` gives a text that is the same for what is the same. */
  constructor(first, textOf) {
    Object.assign(this, { textOf, steps: [first], at: 0 });
  }

  get now() {
    return this.steps[this.at];
  }

  get canUndo() {
    return this.at > 0;
  }

  get canRedo() {
    return this.at + 1 < this.steps.length;
  }

  /** Another state of the page; what had been undone is forgotten. False where it is the one of now. */
  add(state) {
    if (this.textOf(state) === this.textOf(this.now)) return false;
    this.steps = [...this.steps.slice(0, this.at + 1), state].slice(-most);
    this.at = this.steps.length - 1;
    return true;
  }

  /** The state before; the one of now where there is none. */
  undo() {
    this.at = Math.max(0, this.at - 1);
    return this.now;
  }

  /** The state after. */
  redo() {
    this.at = Math.min(this.steps.length - 1, this.at + 1);
    return this.now;
  }
}

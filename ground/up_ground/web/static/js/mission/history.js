const MAX_STEPS = 200;

/** A value that can be undone and redone; values are never modified. */
export class History {
  #past = [];
  #future = [];

  constructor(initial) {
    this.present = initial;
  }

  get canUndo() {
    return this.#past.length > 0;
  }

  get canRedo() {
    return this.#future.length > 0;
  }

  put(next) {
    if (next !== this.present) {
      this.#past = [...this.#past, this.present].slice(-MAX_STEPS);
      this.#future = [];
      this.present = next;
    }
  }

  undo() {
    if (this.canUndo) {
      this.#future.push(this.present);
      this.present = this.#past.pop();
    }
  }

  redo() {
    if (this.canRedo) {
      this.#past.push(this.present);
      this.present = this.#future.pop();
    }
  }
}

/** How long a press must last. */
export const HOLD_S = 1.5;

/** Maximum time between two updates of a press: a page that hung must not fire when it wakes. */
const LONGEST_LOOK_S = 0.5;

/**
 * A press that acts only when it is held: idle -> pressed -> done, or void.
 *
 * Only the release of all inputs leads back to idle, so one press fires once, and a void press
 * stays void for the rest of its duration.
 */
export class HeldPress {
  #by = new Set();
  #began_s = 0;
  #looked_s = 0;

  /** @type {"idle"|"pressed"|"done"|"void"} */
  state = "idle";
  /** Why the last press became void, in words; empty while it did not. */
  why = "";

  /** by: the input: a pointer or a key, by name; objection: why it may not be pressed now. */
  press(by, now_s, objection = "") {
    if (this.#by.has(by)) {
      return;
    }
    this.#by.add(by);
    if (this.state === "idle") {
      this.state = "pressed";
      this.why = "";
      this.#began_s = this.#looked_s = now_s;
      if (objection) {
        this.void(objection);
      }
    } else {
      this.void("something else pressed as well");
    }
  }

  /** by: the input that is released. */
  release(by) {
    if (!this.#by.delete(by)) {
      return;
    }
    this.void("it was let go too early");
    if (this.#by.size === 0) {
      this.state = "idle";
    }
  }

  /** Release all inputs: the pointer was cancelled, the focus was lost. */
  abandon(why) {
    this.void(why);
    this.#by.clear();
    this.state = "idle";
  }

  /** why: a press under way is cancelled; any other state stays. */
  void(why) {
    if (this.state === "pressed") {
      this.state = "void";
      this.why = why;
    }
  }

  /**
   * Update to the present time. objection: why it may not be pressed now. Returns true once, when
   * the press has lasted long enough.
   */
  look(now_s, objection = "") {
    if (this.state !== "pressed") {
      return false;
    }
    const since_s = now_s - this.#looked_s;
    this.#looked_s = now_s;
    if (objection) {
      this.void(objection);
    } else if (since_s > LONGEST_LOOK_S || since_s < 0) {
      this.void("the page was held up");
    } else if (now_s - this.#began_s >= HOLD_S) {
      this.state = "done";
      return true;
    }
    return false;
  }

  /** Completed part of the press, 0 to 1. */
  progress(now_s) {
    if (this.state === "done") {
      return 1;
    }
    return this.state === "pressed" ? Math.min(1, Math.max(0, now_s - this.#began_s) / HOLD_S) : 0;
  }
}

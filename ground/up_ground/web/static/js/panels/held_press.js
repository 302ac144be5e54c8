export const HOLD_S = 1.5;

/** Maximum time between two updates of a press: a page that hung must not fire when it wakes. */
const MAX_STEP_S = 0.5;

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
  /** Why the last press became void, {code, text}; null: it did not. */
  reason = null;

  /** by: the input: a pointer or a key, by name; reason: why it may not be pressed now. */
  press(by, now_s, reason = null) {
    if (this.#by.has(by)) {
      return;
    }
    this.#by.add(by);
    if (this.state === "idle") {
      this.state = "pressed";
      this.reason = null;
      this.#began_s = this.#looked_s = now_s;
      if (reason !== null) {
        this.void(reason);
      }
    } else {
      this.void({ code: "second_input", text: "a second input was pressed" });
    }
  }

  /** by: the input that is released. */
  release(by) {
    if (!this.#by.delete(by)) {
      return;
    }
    this.void({ code: "too_early", text: "released too early" });
    if (this.#by.size === 0) {
      this.state = "idle";
    }
  }

  /** Release all inputs: the pointer was cancelled, the focus was lost. */
  abandon(reason) {
    this.void(reason);
    this.#by.clear();
    this.state = "idle";
  }

  /** reason: a press under way is cancelled; any other state stays. */
  void(reason) {
    if (this.state === "pressed") {
      this.state = "void";
      this.reason = reason;
    }
  }

  /** Whether the press has now lasted long enough: true once. reason: why it may not be pressed. */
  update(now_s, reason = null) {
    if (this.state !== "pressed") {
      return false;
    }
    const since_s = now_s - this.#looked_s;
    this.#looked_s = now_s;
    if (reason !== null) {
      this.void(reason);
    } else if (since_s > MAX_STEP_S || since_s < 0) {
      this.void({ code: "page_delayed", text: "the page was delayed" });
    } else if (now_s - this.#began_s >= HOLD_S) {
      this.state = "done";
      return true;
    }
    return false;
  }

  progress(now_s) {
    if (this.state === "done") {
      return 1;
    }
    return this.state === "pressed" ? Math.min(1, Math.max(0, now_s - this.#began_s) / HOLD_S) : 0;
  }
}

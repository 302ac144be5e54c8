import { TIMERS } from "./clock.js";

const MAX_S = 15;

/** Commands that wait for their answers, each by its number. */
export class PendingCommands {
  #last = 0;
  #waiting = new Map();
  #timers;

  constructor(timers = TIMERS) {
    this.#timers = timers;
  }

  add() {
    this.#last += 1;
    const ask = this.#last;
    const answer = new Promise((resolve) => {
      const timer = this.#timers.once(
        () => this.take({ ask, outcome: "timeout", code: "no_answer", reason: "the ground server did not answer" }),
        MAX_S,
      );
      this.#waiting.set(ask, { resolve, timer });
    });
    return { ask, answer };
  }

  take(message) {
    const waiting = this.#waiting.get(message.ask);
    if (waiting === undefined) {
      return;
    }
    this.#waiting.delete(message.ask);
    this.#timers.cancel(waiting.timer);
    waiting.resolve({ code: null, reason: "", round_trip_ms: null, data: null, ...message });
  }

  /** cause: code and reason why no answer can arrive now: the outcome of the requests is unknown. */
  giveUp(cause) {
    for (const ask of [...this.#waiting.keys()]) {
      this.take({ ask, outcome: "timeout", ...cause });
    }
  }
}

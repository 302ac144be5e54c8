/** A clock that advances only on request, with its timers. */
export class FakeClock {
  #timers = new Map();
  #last = 0;
  seconds = 100;

  now_s = () => this.seconds;

  timers = {
    once: (call, wait_s) => this.#add(call, wait_s, null),
    each: (call, period_s) => this.#add(call, period_s, period_s),
    cancel: (timer) => this.#timers.delete(timer),
  };

  /** @param {number} time_s how far; every timer due on the way is called in its order */
  advance(time_s) {
    const end_s = this.seconds + time_s;
    for (;;) {
      const [timer, next] = this.#next();
      if (next === undefined || next.at_s > end_s + 1e-9) {
        break;
      }
      this.seconds = Math.max(this.seconds, next.at_s);
      if (next.period_s === null) {
        this.#timers.delete(timer);
      } else {
        next.at_s += next.period_s;
      }
      next.call();
    }
    this.seconds = end_s;
  }

  #add(call, wait_s, period_s) {
    this.#last += 1;
    this.#timers.set(this.#last, { call, at_s: this.seconds + wait_s, period_s });
    return this.#last;
  }

  #next() {
    return [...this.#timers].sort((one, other) => one[1].at_s - other[1].at_s)[0] ?? [];
  }
}

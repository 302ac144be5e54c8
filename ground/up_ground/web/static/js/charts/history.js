import { GAP_S, Silence } from "../state/track.js";

export const WINDOW_S = 60;

/** The last minute of some values at rising times (s); a silence, null or a stale value is a gap. */
export class History {
  #names;
  #times_s = [];
  #values;
  #silence = new Silence();

  constructor(names) {
    this.#names = names;
    this.#values = names.map(() => []);
  }

  get length() {
    return this.#times_s.length;
  }

  /** time_s: when it was so; not after the last one: dropped. */
  add(time_s, values) {
    const last_s = this.#times_s.at(-1);
    if (last_s !== undefined && !(time_s > last_s)) {
      return;
    }
    if (this.#silence.take(time_s)) {
      this.#push((last_s + time_s) / 2, {});
    }
    this.#push(time_s, values);
    this.#clear(time_s - WINDOW_S - GAP_S);
  }

  /** Draw no line between the samples before and after: another flight, another time. */
  clear() {
    this.#times_s = [];
    this.#values = this.#names.map(() => []);
    this.#silence.clear();
  }

  /** The silence in seconds that interrupts the line. */
  get gap_s() {
    return this.#silence.limit_s;
  }

  /** Seconds before now (negative), then the values of each name; a silence up to now ends with a gap. */
  columns(now_s) {
    const first = this.#times_s.findIndex((time_s) => time_s >= now_s - WINDOW_S);
    if (first < 0) {
      return [[], ...this.#names.map(() => [])];
    }
    const columns = [
      this.#times_s.slice(first).map((time_s) => time_s - now_s),
      ...this.#values.map((each) => each.slice(first)),
    ];
    if (now_s - this.#times_s.at(-1) > this.gap_s) {
      columns[0].push(0);
      columns.slice(1).forEach((each) => each.push(null));
    }
    return columns;
  }

  #push(time_s, values) {
    this.#times_s.push(time_s);
    this.#names.forEach((name, index) => {
      const value = values[name];
      this.#values[index].push(
        typeof value === "number" && Number.isFinite(value) ? value : null,
      );
    });
  }

  #clear(before_s) {
    const kept = this.#times_s.findIndex((time_s) => time_s >= before_s);
    // Cut rarely, and then much: cutting at every frame would copy a minute at every frame.
    if (kept > 256) {
      this.#times_s = this.#times_s.slice(kept);
      this.#values = this.#values.map((each) => each.slice(kept));
    }
  }
}

const NARROWEST_S = 0.02;

/** The span of time that every part of the page shows, and the time under the cursor (null: none). */
export class TimeWindow {
  cursor_s = null;
  #least_s;
  #most_s;
  #listeners = { span: [], cursor: [] };

  constructor(least_s, most_s) {
    this.setLimits(least_s, most_s);
    this.begin_s = least_s;
    this.end_s = this.#most_s;
  }

  /** kind: span, cursor. */
  on(kind, call) {
    this.#listeners[kind].push(call);
  }

  setLimits(least_s, most_s) {
    this.#least_s = least_s;
    this.#most_s = Math.max(most_s, least_s + NARROWEST_S);
  }

  /** Show a span, moved and shortened into the limits. */
  set(begin_s, end_s) {
    const length_s = Math.min(Math.max(end_s - begin_s, NARROWEST_S), this.#most_s - this.#least_s);
    const middle_s = (begin_s + end_s) / 2;
    const least_s = Math.min(Math.max(middle_s - length_s / 2, this.#least_s), this.#most_s - length_s);
    this.begin_s = least_s;
    this.end_s = least_s + length_s;
    this.#tell("span");
  }

  showAll() {
    this.set(this.#least_s, this.#most_s);
  }

  /** factor: below 1: closer; at_s keeps its place. */
  zoom(factor, at_s = this.cursor_s ?? (this.begin_s + this.end_s) / 2) {
    this.set(at_s - (at_s - this.begin_s) * factor, at_s + (this.end_s - at_s) * factor);
  }

  /** share: of the shown span, negative: earlier. */
  move(share) {
    const step_s = (this.end_s - this.begin_s) * share;
    this.set(this.begin_s + step_s, this.end_s + step_s);
  }

  setCursor(time_s) {
    if (time_s !== this.cursor_s) {
      this.cursor_s = time_s;
      this.#tell("cursor");
    }
  }

  #tell(kind) {
    this.#listeners[kind].forEach((call) => call());
  }
}

/** As 1:02:03.250; decimals: of the second. */
export function timeText(time_s, decimals = 0) {
  const unit = 10 ** decimals;
  const whole = Math.round(Math.abs(time_s) * unit) / unit;
  const hours = Math.floor(whole / 3600);
  const minutes = Math.floor(whole / 60) % 60;
  const seconds = (whole % 60).toFixed(decimals).padStart(decimals ? decimals + 3 : 2, "0");
  const clock = hours ? `${hours}:${String(minutes).padStart(2, "0")}` : `${minutes}`;
  return `${time_s < 0 ? "-" : ""}${clock}:${seconds}`;
}

/** The time that charts run by: it stands still while a replay does, and goes on from there. */
export class ChartClock {
  #held_s = null;
  #behind_s = 0;

  /**
   * @param {number} now_s
   * @param {boolean} isHeld
   * @returns {number} seconds
   */
  at(now_s, isHeld) {
    if (isHeld) {
      this.#held_s ??= now_s;
    } else if (this.#held_s !== null) {
      this.#behind_s += now_s - this.#held_s;
      this.#held_s = null;
    }
    return (this.#held_s ?? now_s) - this.#behind_s;
  }
}

const LIMIT_S = 30;
/** The server reports the end of a request; without a report the page ends it a little later. */
const LATE_S = 3;
/** How long the outcome of a request is shown. */
const TOLD_S = 30;

/** This page's requests for control, with their outcomes, by aircraft. */
export class ControlWishes {
  #wishes = new Map();
  #notes = new Map();

  /** holder: the page asked; empty: none in particular. */
  asked(aircraft, holder, now_s) {
    this.#notes.delete(aircraft);
    this.#wishes.set(aircraft, { holder, at_s: now_s });
  }

  /** aircraft: for which no request is pending now. */
  withdraw(aircraft) {
    this.#wishes.delete(aircraft);
    this.#notes.delete(aircraft);
  }

  /**
   * A request was denied, or something else went wrong. aircraft: the watched one; without a
   * request for it the first pending one is meant.
   */
  fault(text, aircraft, now_s) {
    const place = this.#wishes.has(aircraft) ? aircraft : ([...this.#wishes.keys()][0] ?? aircraft);
    this.#wishes.delete(place);
    this.#notes.set(place, { text, at_s: now_s });
  }

  /** The connection is lost: the server has forgotten every wish. */
  forget() {
    this.#wishes.clear();
    this.#notes.clear();
  }

  /**
   * control: of its status; page: this page's number. Returns whether this page waits for control.
   */
  isWaiting(aircraft, control, page, now_s) {
    const wish = this.#wishes.get(aircraft);
    if (control?.holder === "you") {
      this.withdraw(aircraft);
      return false;
    }
    if (wish !== undefined && now_s - wish.at_s > LIMIT_S + LATE_S) {
      this.#wishes.delete(aircraft);
      const text = `${wish.holder || "The other one"} did not give control within ${LIMIT_S} s.`;
      this.#notes.set(aircraft, { text, at_s: now_s });
    }
    return this.#wishes.has(aircraft) || isAsker(control, page);
  }

  /** Its present state; empty: none. */
  words(aircraft, now_s) {
    const wish = this.#wishes.get(aircraft);
    if (wish !== undefined) {
      return wish.holder === "" ? "" : `You have asked ${wish.holder} for control, who has ${LIMIT_S} s to answer.`;
    }
    const note = this.#notes.get(aircraft);
    return note === undefined || now_s - note.at_s > TOLD_S ? "" : note.text;
  }
}

/**
 * control: of a status; page: this page's number. Returns whether this page has the pending
 * request.
 */
export function isAsker(control, page) {
  return typeof page === "number" && control?.asked_by?.page === page;
}

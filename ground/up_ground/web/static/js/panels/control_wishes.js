const LIMIT_S = 30;
/** The server tells when a wish is over; a page that does not hear it gives it up a little later. */
const LATE_S = 3;
/** So long it is told what became of a wish. */
const TOLD_S = 30;

/** What this page has asked of those who have control, and what became of it: by aircraft. */
export class ControlWishes {
  #wishes = new Map();
  #notes = new Map();

  /**
   * @param {string} aircraft
   * @param {string} holder who was asked; empty: nobody in particular
   * @param {number} now_s
   */
  asked(aircraft, holder, now_s) {
    this.#notes.delete(aircraft);
    this.#wishes.set(aircraft, { holder, at_s: now_s });
  }

  /** @param {string} aircraft of which nothing is asked any more */
  withdraw(aircraft) {
    this.#wishes.delete(aircraft);
    this.#notes.delete(aircraft);
  }

  /**
   * A wish was denied, or something else went wrong.
   * @param {string} text
   * @param {string} aircraft that is looked at: of others, what is under way is meant
   * @param {number} now_s
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
   * @param {string} aircraft
   * @param {object|null} control of its status
   * @param {number|null} page this page's number
   * @param {number} now_s
   * @returns {boolean} whether this page waits for control
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

  /**
   * @param {string} aircraft
   * @param {number} now_s
   * @returns {string} what is to be known of it; empty: nothing
   */
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
 * @param {object|null} control of a status
 * @param {number|null} page this page's number
 * @returns {boolean} whether it is this page that asks
 */
export function isAsker(control, page) {
  return typeof page === "number" && control?.asked_by?.page === page;
}

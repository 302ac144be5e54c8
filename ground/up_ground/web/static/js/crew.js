import { html, setAttribute, setText } from "./readout.js";

/** A part that failed so often in a row is left as it is; with the waits that is half a minute. */
const MOST_FAULTS = 16;
/** Between two tries pass 1, 2, 4 updates and so on, but not more than these. */
const LONGEST_WAIT = 64;
/** After so many good updates in a row what was is forgotten. */
const GOOD_UPDATES = 50;

/**
 * The parts of the page: one that fails keeps none of the others from what they do.
 *
 * What a part that fails had shown is of before, and it may not look as if it were of now: its
 * element is greyed, takes no press, and none of its values says that it is live. It is tried again
 * at the next updates, ever more seldom, and stands as before when one succeeds.
 */
export class Crew {
  #members = [];
  #place;

  /** @param {HTMLElement} place where is said what is missing */
  constructor(place) {
    this.#place = place;
  }

  /**
   * @param {string} name
   * @param {{update: () => void, fail?: () => void}} part fail: takes back what is shown elsewhere
   * @param {HTMLElement} element that it draws into
   */
  add(name, part, element) {
    this.#members.push({ name, part, element, faults: 0, wait: 0, good: 0, line: null });
  }

  /** Let every part show what is. */
  update() {
    for (const member of this.#members.filter(({ faults }) => faults < MOST_FAULTS)) {
      if (member.wait > 0) {
        member.wait -= 1;
        continue;
      }
      try {
        member.part.update();
        this.#succeed(member);
      } catch (error) {
        this.#fail(member, error);
      }
    }
  }

  /**
   * @param {string} sentence what is not there
   * @returns {HTMLElement} its line
   */
  say(sentence) {
    const line = html("span", {}, sentence);
    this.#place.append(line);
    this.#place.hidden = false;
    return line;
  }

  #succeed(member) {
    if (member.line !== null) {
      member.line.remove();
      member.line = null;
      this.#place.hidden = this.#place.childElementCount === 0;
      member.element.classList.remove("is-broken");
      member.element.inert = false;
    }
    member.good += 1;
    if (member.good >= GOOD_UPDATES) {
      member.faults = 0;
    }
  }

  #fail(member, error) {
    console.error(error);
    member.good = 0;
    member.wait = Math.min(LONGEST_WAIT, 2 ** member.faults) - 1;
    member.faults += 1;
    member.element.classList.add("is-broken");
    member.element.inert = true;
    for (const each of [member.element, ...member.element.querySelectorAll("[data-freshness]")]) {
      if (each.hasAttribute("data-freshness")) {
        setAttribute(each, "data-freshness", "none");
      }
    }
    member.line ??= this.say("");
    const next = member.faults < MOST_FAULTS ? "it is tried again" : "load the page anew";
    setText(member.line, `${member.name} stopped: ${error.message}; ${next}`);
    member.part.fail?.();
  }
}

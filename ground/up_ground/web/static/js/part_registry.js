import { html, setAttribute, setText } from "./dom.js";

/** Failures in a row until a part is given up; with the waits that takes half a minute. */
const MAX_FAULTS = 16;
/** Between two tries pass 1, 2, 4 updates and so on, but not more than these. */
const MAX_WAIT = 64;
/** Successful updates in a row that clear the failure count. */
const GOOD_UPDATES = 50;

/**
 * The parts of the page: an exception in one does not stop the others.
 *
 * The display of a failed part is outdated and must not look live: its element is greyed out and
 * inert, and none of its values is marked live. The part is retried at later updates, with growing
 * waits, and is restored when one succeeds.
 */
export class PartRegistry {
  #members = [];
  #place;

  /** place: that lists the missing parts. */
  constructor(place) {
    this.#place = place;
  }

  /** fail: undoes the part's display elsewhere; element: that it draws into. */
  add(name, part, element) {
    this.#members.push({ name, part, element, faults: 0, wait: 0, good: 0, line: null });
  }

  update() {
    for (const member of this.#members.filter(({ faults }) => faults < MAX_FAULTS)) {
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

  /** Report a missing part; returns the line of the report. */
  report(name, sentence) {
    const line = html("span", { "data-code": name }, sentence);
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
    member.wait = Math.min(MAX_WAIT, 2 ** member.faults) - 1;
    member.faults += 1;
    member.element.classList.add("is-broken");
    member.element.inert = true;
    for (const each of [member.element, ...member.element.querySelectorAll("[data-freshness]")]) {
      if (each.hasAttribute("data-freshness")) {
        setAttribute(each, "data-freshness", "none");
      }
    }
    member.line ??= this.report(member.name, "");
    const next = member.faults < MAX_FAULTS ? "retrying" : "reload the page";
    setText(member.line, `${member.name} failed: ${error.message}; ${next}`);
    member.part.fail?.();
  }
}

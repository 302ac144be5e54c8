import { setText } from "../readout.js";
import { element } from "./element.js";
import { agoWords } from "./words.js";

const WORD = { info: "", warning: "Warning: ", alarm: "Alarm: " };

/** The lines of a list of events: those that are there stay, so that only new ones are read out. */
export class EventLines {
  #list;
  #window;
  #lines = new Map();
  #agesAt_s = -Infinity;

  /** window: the scrolling viewport. */
  constructor(list, window) {
    this.#list = list;
    this.#window = window;
  }

  /** Whether the newest line is in sight. */
  get isAtNewest() {
    const { scrollTop, clientHeight, scrollHeight } = this.#window;
    return scrollHeight - scrollTop - clientHeight < 24;
  }

  /** Scroll the newest line into view. */
  toNewest() {
    this.#window.scrollTop = this.#window.scrollHeight;
  }

  /** events: the newest last. */
  show(events, now_s) {
    const wasAtNewest = this.isAtNewest;
    const wanted = new Set(events.map(keyOf));
    for (const [key, { line }] of this.#lines) {
      if (!wanted.has(key)) {
        line.remove();
        this.#lines.delete(key);
      }
    }
    let before = null;
    for (const event of [...events].reverse()) {
      const key = keyOf(event);
      if (!this.#lines.has(key)) {
        this.#add(event, before);
      }
      this.#lines.get(key).at_s = event.at_s;
      before = this.#lines.get(key).line;
    }
    this.#agesAt_s = -Infinity;
    this.showAges(now_s);
    if (wasAtNewest) {
      this.toNewest();
    }
  }

  /** Rewrite the ages, once a second. */
  showAges(now_s) {
    if (Math.abs(now_s - this.#agesAt_s) < 1) {
      return;
    }
    this.#agesAt_s = now_s;
    for (const { age, at_s } of this.#lines.values()) {
      setText(age, agoWords(now_s - at_s));
    }
  }

  #add(event, before) {
    // Ages change by themselves: they are not for reading out.
    const age = element("time", { "aria-hidden": "true" });
    const text = element("span", { text: `${WORD[event.level] ?? ""}${event.text}` });
    const line = element("li", { "data-level": event.level, "data-kind": event.kind }, text, age);
    this.#list.insertBefore(line, before);
    this.#lines.set(keyOf(event), { line, age, at_s: event.at_s });
  }
}

// Another aircraft and a restarted server count from one again.
function keyOf({ number, level, text }) {
  return JSON.stringify([number, level, text]);
}

import { number } from "./validate.js";

const MAX_ITEMS = 500;
const LEVELS = new Set(["info", "warning", "alarm"]);

/** The aircraft's events, in order of the server's numbers, each once, the newest last. */
export class EventList {
  /**
   * @type {{number: number, at_s: number, level: string, kind: string, text: string,
   *   is_past: boolean}[]}
   */
  all = [];
  /** Counts the changes, for those that draw it. */
  version = 0;

  /** Take the server's `event`; in a replay it has a `time_s`. Returns whether it is new. */
  take(message, now_s) {
    const place = number(message.number);
    if (place === null || typeof message.text !== "string") {
      return false;
    }
    let before = this.all.length;
    while (before > 0 && this.all[before - 1].number > place) {
      before -= 1;
    }
    if (before > 0 && this.all[before - 1].number === place) {
      return false;
    }
    this.all.splice(before, 0, {
      number: place,
      at_s: number(message.time_s) ?? now_s - Math.max(0, number(message.age_ms) ?? 0) / 1000,
      level: LEVELS.has(message.level) ? message.level : "info",
      kind: String(message.kind ?? ""),
      code: String(message.code ?? ""),
      text: message.text,
      is_past: message.is_past === true,
    });
    this.all.splice(0, Math.max(0, this.all.length - MAX_ITEMS));
    this.version += 1;
    return true;
  }

  clear() {
    this.all = [];
    this.version += 1;
  }
}

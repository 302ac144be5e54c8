import { setText } from "../readout.js";
import { element } from "./element.js";
import { cellsOf, difference } from "./gain_set.js";
import { agoWords } from "./words.js";

const OUTCOMES = { ack: "carried out", nack: "refused", timeout: "no answer", unsent: "not sent", refused: "refused" };

/** The sent sets: time, sender, changes and outcome. */
export class GainsHistory {
  #list = element("ol.gains-history", { id: "gains-history" });
  #ages = [];
  #shown = null;

  constructor() {
    this.element = element("details", { hidden: true }, element("summary", { text: "History" }), this.#list);
  }

  /** message: the server's `gains`; since_s: seconds since its arrival. */
  show(message, since_s) {
    if (message !== this.#shown) {
      this.#shown = message;
      this.#build(entriesOf(message));
    }
    for (const { time, age_s } of this.#ages) {
      setText(time, agoWords(age_s + since_s));
    }
  }

  #build(entries) {
    this.element.hidden = entries.length === 0;
    this.#ages = [];
    this.#list.replaceChildren();
    for (const entry of [...entries].reverse()) {
      const time = element("time");
      const changes = difference(cellsOf(entry.before), cellsOf(entry.after)).map(({ words }) => words);
      const reason = entry.outcome === "ack" || !entry.reason ? "" : `: ${entry.reason}`;
      const outcome = `${OUTCOMES[entry.outcome] ?? entry.outcome}${reason}`;
      this.#list.append(
        element(
          "li",
          { "data-outcome": entry.outcome },
          element("span", { text: changes.join("; ") || "no difference" }),
          element("span.quiet", { text: `by ${entry.by || "somebody"}, ${outcome}, ` }, time),
        ),
      );
      this.#ages.push({ time, age_s: Number(entry.age_s) || 0 });
    }
  }
}

/** message: the server's `gains`. Returns its history, the oldest first. */
export function entriesOf(message) {
  const entries = Array.isArray(message?.history) ? message.history : [];
  return entries
    .filter((each) => each !== null && typeof each === "object")
    .toSorted((one, other) => Number(one.number) - Number(other.number));
}

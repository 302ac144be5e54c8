import { setText } from "../readout.js";
import { element } from "./element.js";
import { Field, numberBetween, textUpTo } from "./field.js";
import { heading } from "./flight_modes.js";
import { FrameSize } from "./frame_size.js";
import { costWords } from "./words.js";

/** As long as the aircraft takes them (android.speak, black_box.mark). */
const LONGEST_TEXT = 200;

/** Telemetry's period, the phone's voice, a mark in the log. */
export class Wishes {
  #store;
  #asker;
  #size = new FrameSize();
  #period;
  #speak;
  #mark;
  #aircraft = null;

  constructor(store, asker) {
    this.#store = store;
    this.#asker = asker;
    this.#period = this.#number(
      "telemetry-period",
      "Telemetry every so many ms",
      [20, 10000],
      "ms",
      (value) => this.#send("up.telemetry.frequency", { frequency: value }, this.#period),
    );
    this.#speak = this.#text("speak", "Say on the phone", "Say", (text) =>
      this.#send("android.speak", { text }, this.#speak),
    );
    this.#mark = this.#text("mark", "Mark in the flight log", "Mark", (text) =>
      this.#send("black_box.mark", { text }, this.#mark),
    );
    this.#period.input.addEventListener("input", () => this.#showCost());
    this.element = element(
      "section.part.wishes",
      {},
      heading("Telemetry, voice, mark"),
      ...this.#fields.map(([field]) => field.element),
    );
    for (const field of [this.#period, this.#speak, this.#mark]) {
      field.element.classList.add("wide");
    }
  }

  update() {
    if (this.#store.aircraft !== this.#aircraft) {
      this.#aircraft = this.#store.aircraft;
      this.#size = new FrameSize();
      this.#fields.forEach(([field]) => field.clear());
    }
    for (const [field, name, data] of this.#fields) {
      field.offer(this.#asker.objection(name, data) === "");
    }
    const store = this.#store;
    this.#size.look(store.data, store.frames);
    this.#showCost();
  }

  get #fields() {
    return [
      [this.#period, "up.telemetry.frequency", {}],
      [this.#speak, "android.speak", {}],
      [this.#mark, "black_box.mark", {}],
    ];
  }

  #showCost() {
    const written = this.#period.value;
    const rate_hz = this.#store.status?.link?.rate_hz;
    const isLive = this.#store.aircraftState === "live";
    const now_ms = isLive && typeof rate_hz === "number" && rate_hz > 0 ? 1000 / rate_hz : null;
    if (written !== null) {
      setText(this.#period.hint, costWords(written, this.#size.bytes));
    } else if (now_ms !== null) {
      setText(this.#period.hint, `now ${costWords(now_ms, this.#size.bytes)}`);
    } else {
      setText(this.#period.hint, "");
    }
  }

  #send(name, data, field) {
    return this.#asker.ask(name, data, { note: field.note });
  }

  #number(id, label, [least, most], unit, send) {
    const input = { type: "number", inputmode: "decimal", min: least, max: most, step: "any" };
    return new Field({ id, label, button: "Ask", input, read: numberBetween(least, most, unit), send });
  }

  #text(id, label, button, send) {
    // Without maxlength: it counts in halves of some characters, and cuts silently.
    const input = { type: "text", autocomplete: "off" };
    return new Field({ id, label, button, input, read: textUpTo(LONGEST_TEXT), send });
  }
}

import { ageText, headingText, numberText } from "../state/format.js";
import { setText } from "../readout.js";
import { element } from "./element.js";
import { Field, numberBetween, textUpTo } from "./field.js";
import { heading } from "./flight_modes.js";
import { FrameSize } from "./frame_size.js";
import { costWords } from "./words.js";

/** As long as the aircraft takes them (android.speak, black_box.mark). */
const LONGEST_TEXT = 200;

/** Heading and altitude asked for, telemetry's period, the phone's voice, a mark in the log. */
export class Wishes {
  #store;
  #asker;
  #size = new FrameSize();
  #heading;
  #altitude;
  #period;
  #speak;
  #mark;
  #aircraft = null;

  constructor(store, asker) {
    this.#store = store;
    this.#asker = asker;
    this.#heading = this.#number("wish-heading", "Heading, degrees", [0, 360], "deg", (value) =>
      this.#fly("up.heading.change", { heading: value, mode: "required" }, this.#heading),
    );
    this.#altitude = this.#number(
      "wish-altitude",
      "Altitude (sea level), m",
      [-1000, 30000],
      "m",
      (value) => this.#fly("up.altitude.change", { altitude: value, mode: "required" }, this.#altitude),
    );
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
      heading("Where to, and what to tell"),
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
    this.#showNow(this.#heading, "heading.actual", "heading.required", (value) => `${headingText(value)}°`);
    this.#showNow(this.#altitude, "altitude", "altitude_required", (value) => `${numberText(value, 0)} m`);
    this.#showCost();
  }

  // What is not of now never reads as if it were.
  #showNow(field, path, wanted, format) {
    const value = this.#store.number(path);
    const isLive = this.#store.freshnessAt(path) === "live";
    const age = ageText(this.#store.age_s(path.split(".")[0]));
    const was = value === null ? "not known" : `was ${format(value)}, ${age} ago`;
    const asked = this.#store.number(wanted);
    setText(field.hint, `${isLive ? `now ${format(value)}` : was}${asked === null ? "" : `, asked ${format(asked)}`}`);
  }

  get #fields() {
    return [
      [this.#heading, "up.heading.change", { mode: "required" }],
      [this.#altitude, "up.altitude.change", { mode: "required" }],
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

  #fly(name, data, field) {
    const isHeading = name === "up.heading.change";
    const what = isHeading ? `heading ${data.heading}°` : `altitude ${data.altitude} m`;
    const noted = notedWords(this.#store);
    const question = {
      title: `Ask for ${what}?`,
      text: wishWords(isHeading, noted),
      yes: "Ask for it",
      no: "Leave it",
    };
    return this.#asker.ask(name, data, { note: field.note, question, isDone: noted });
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

/**
 * @param {object} store
 * @returns {string} that a wish is noted only; empty: the aircraft navigates, or nobody knows
 */
export function notedWords(store) {
  const mode = store.freshness(null) === "live" ? store.text("flight_mode") : null;
  return ["ACRO", "RATE", "FBW"].includes(mode) ? `noted; nothing flies by it in ${mode}` : "";
}

/**
 * @param {boolean} isHeading or it is an altitude
 * @param {string} noted as notedWords() tells it
 * @returns {string} what a wish does
 */
export function wishWords(isHeading, noted) {
  const flown = `An aircraft that navigates by itself ${isHeading ? "turns to it" : "climbs or sinks to it"}`;
  return noted === "" ? `${flown}; in other modes it is only noted.` : `${flown}. Now it is ${noted}.`;
}

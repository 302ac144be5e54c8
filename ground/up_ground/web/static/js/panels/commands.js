import { showReason } from "./disabled_reason.js";
import { html, setText } from "../dom.js";
import { Arming } from "./arming.js";
import { CommandSender } from "./command_sender.js";
import { Field, numberBetween, textUpTo } from "./field.js";
import { FlightModes, heading } from "./flight_modes.js";
import { costText } from "./messages.js";

/** Overhead of a frame's message around its tree: its name, the beacon, the line's end. */
const AROUND_BYTES = 52;
const EVERY = 20;

/** Bytes of a telemetry frame as received from the aircraft: measured now and then. */
export class FrameSize {
  #nextAt = 0;

  /** @type {number|null} the mean of the last ones; null: no frame yet */
  bytes = null;

  /** tree: of the newest frame; count: of all frames so far. */
  look(tree, count) {
    if (count === 0 || count < this.#nextAt) {
      return;
    }
    this.#nextAt = count + EVERY;
    const bytes = new TextEncoder().encode(JSON.stringify(tree)).length + AROUND_BYTES;
    this.bytes = this.bytes === null ? bytes : this.bytes + (bytes - this.bytes) / 4;
  }
}

/** The aircraft's limit for android.speak and black_box.mark. */
const MAX_TEXT = 200;

/** Telemetry's period, the phone's voice, a mark in the log. */
export class RequestForm {
  #store;
  #sender;
  #size = new FrameSize();
  #period;
  #speak;
  #mark;
  #aircraft = null;

  constructor(store, sender) {
    this.#store = store;
    this.#sender = sender;
    this.#period = this.#number(
      "telemetry-period",
      "Telemetry period, ms",
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
    this.element = html(
      "section.part.requests",
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
      field.offer(this.#sender.disabledReason(name, data) === null);
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
      setText(this.#period.hint, costText(written, this.#size.bytes));
    } else if (now_ms !== null) {
      setText(this.#period.hint, `now ${costText(now_ms, this.#size.bytes)}`);
    } else {
      setText(this.#period.hint, "");
    }
  }

  #send(name, data, field) {
    return this.#sender.send(name, data, { note: field.note });
  }

  #number(id, label, [least, most], unit, send) {
    const input = { type: "number", inputmode: "decimal", min: least, max: most, step: "any" };
    return new Field({ id, label, button: "Ask", input, read: numberBetween(least, most, unit), send });
  }

  #text(id, label, button, send) {
    // Without maxlength: it counts in halves of some characters, and cuts silently.
    const input = { type: "text", autocomplete: "off" };
    return new Field({ id, label, button, input, read: textUpTo(MAX_TEXT), send });
  }
}

export function mount(place, store, connection) {
  const sender = new CommandSender(store, connection);
  const last = html("p", { id: "last-answer", role: "status", "data-look": "plain" });
  const why = html("p.why", { id: "commands-why" });
  const parts = [new FlightModes(store, sender), new Arming(store, sender), new RequestForm(store, sender)];
  place.append(why, last, ...parts.map((part) => part.element));
  return {
    update() {
      place.hidden = connection.welcome?.is_replay === true;
      // The action with the most conditions has the fullest reason: a missing role shows here too.
      showReason(why, sender.disabledReason("up.flight_mode.set") ?? sender.disabledReason("up.arm"));
      parts.forEach((part) => part.update());
    },
  };
}

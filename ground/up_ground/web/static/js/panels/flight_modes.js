import { html, setAttribute, setText } from "../dom.js";
import { modeText } from "./messages.js";
import { switchMode } from "../state/pilot_input.js";

/** Modes that the ground may select; only the pilot's switch selects ACRO. */
const MODES = ["RATE", "FBW", "AUTO"];
const NAME = "up.flight_mode.set";

/** The board's modes while AUTO is selected: the Raspberry Pi's attitude or its servo positions. */
const FLOWN_AT_AUTO = ["SETPOINT", "OUTPUT"];

/** The buttons of the flight modes; the one that is flown is marked. */
export class FlightModes {
  #store;
  #sender;
  #buttons = new Map();
  #line = html("p.quiet");
  #note = html("p.note", { role: "status" });

  constructor(store, sender) {
    this.#store = store;
    this.#sender = sender;
    const row = html("div.buttons.modes", { role: "group", "aria-label": "Flight mode" });
    for (const mode of MODES) {
      const button = html(
        "button",
        {
          type: "button",
          "data-mode": mode,
          "aria-pressed": "false",
          on: { click: () => this.#select(mode) },
        },
        html("strong", { text: mode }),
        html("small", { text: modeText(mode) }),
      );
      this.#buttons.set(mode, button);
      row.append(button);
    }
    this.element = html("section.part", {}, heading("Flight mode"), row, this.#line, this.#note);
  }

  update() {
    const store = this.#store;
    const flown = store.freshness(null) === "live" ? store.text("flight_mode") : null;
    const isControllerReady = store.texts("flight_control.offered")?.length !== 0;
    const selected = FLOWN_AT_AUTO.includes(flown) ? "AUTO" : flown;
    for (const [mode, button] of this.#buttons) {
      // RATE and FBW are the board's own; AUTO is flown by a controller on the Raspberry Pi, if any.
      const isOffered = mode !== "AUTO" || isControllerReady;
      button.disabled = !isOffered || this.#sender.disabledReason(NAME, { mode }) !== null;
      setAttribute(button, "aria-pressed", String(mode === selected));
      setAttribute(button, "data-offered", String(isOffered));
    }
    const missing = isControllerReady ? [] : (store.texts("flight_control.missing") ?? []);
    setText(this.#line, this.#lineText(isControllerReady, missing));
    setAttribute(this.#line, "data-missing", missing.join(" "));
  }

  async #select(mode) {
    const flown = this.#store.text("flight_mode") ?? "an unknown mode";
    const question = {
      title: `Fly ${mode}?`,
      text: `Now it flies ${flown}. In ${mode} ${modeText(mode)}. The pilot's switch decides: leaving AUTO there takes over immediately.`,
      yes: `Fly ${mode}`,
      no: "Leave it",
    };
    await this.#sender.send(NAME, { mode }, { note: this.#note, question });
  }

  #lineText(isControllerReady, missing) {
    const words = [];
    const selected = switchMode(this.#store);
    if (selected !== null && selected !== "AUTO") {
      words.push(`The pilot's switch stands at ${selected}: the aircraft takes a mode only at AUTO.`);
    }
    if (!isControllerReady) {
      const why = missing.length > 0 ? ` (missing: ${missing.join(", ")})` : "";
      words.push(`AUTO is not offered: the Raspberry Pi's flight controller cannot fly now${why}.`);
    }
    return words.join(" ");
  }
}

export function heading(text) {
  return html("h3", { text });
}

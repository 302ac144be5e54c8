import { html, setAttribute, setText } from "../dom.js";
import { modeText } from "./messages.js";
import { actingMode, boardModes, isFlownByPi, modeReason, piModes } from "../state/flight_mode.js";
import { switchMode } from "../state/pilot_input.js";

const NAME = "up.flight_mode.set";
/** The modes for which there is always a large button. */
const LARGE = ["RETURN", "LOITER"];
/** Selects the mode that the aircraft's navigation.yml names. */
const AUTO = "AUTO";
const NOT_REPORTED = "the aircraft does not report its flight modes";

/** A group of buttons, one for each mode that the aircraft reports. */
class ModeButtons {
  #select;
  #buttons = new Map();
  #row;
  #shown = "";

  constructor(title, row, select) {
    this.#row = row;
    this.#select = select;
    row.setAttribute("role", "group");
    row.setAttribute("aria-label", title);
  }

  /** modes: [{mode, code and reason: why not, null: it is offered, isActive, isEnabled}] */
  show(modes) {
    const names = modes.map(({ mode }) => mode);
    if (names.join("\n") !== this.#shown) {
      this.#shown = names.join("\n");
      this.#buttons = new Map(names.map((mode) => [mode, this.#buttons.get(mode) ?? this.#button(mode)]));
      this.#row.replaceChildren(...[...this.#buttons.values()].map(({ button }) => button));
    }
    for (const { mode, code, reason, isActive, isEnabled } of modes) {
      const { button, small } = this.#buttons.get(mode);
      button.disabled = code !== null || !isEnabled;
      setText(small, code === null ? modeText(mode) : reason);
      setAttribute(button, "aria-pressed", String(isActive));
      setAttribute(button, "data-offered", String(code === null));
      setAttribute(button, "data-code", code ?? "");
    }
  }

  #button(mode) {
    const small = html("small");
    const how = { type: "button", "data-mode": mode, on: { click: () => this.#select(mode) } };
    return { button: html("button", how, html("strong", { text: mode }), small), small };
  }
}

/** The buttons of the flight modes, in the aircraft's lists; the one that acts is marked. */
export class FlightModes {
  #store;
  #sender;
  #large;
  #pi;
  #board;
  #line = html("p.quiet");
  #note = html("p.note", { role: "status" });

  constructor(store, sender) {
    this.#store = store;
    this.#sender = sender;
    const select = (mode) => this.#select(mode);
    const rows = [html("div.buttons.modes.large"), html("div.buttons.modes"), html("div.buttons.modes")];
    this.#large = new ModeButtons("Return and loiter", rows[0], select);
    this.#pi = new ModeButtons("Flight modes of the Raspberry Pi", rows[1], select);
    this.#board = new ModeButtons("Flight modes of the Arduino", rows[2], select);
    this.element = html(
      "section.part",
      { id: "flight-modes" },
      heading("Flight mode"),
      rows[0],
      html("h4", { text: "Controlled by the Raspberry Pi" }),
      rows[1],
      html("h4", { text: "Controlled by the pilot with the Arduino" }),
      rows[2],
      this.#line,
      this.#note,
    );
  }

  update() {
    const store = this.#store;
    const isLive = store.freshness(null) === "live";
    const isPi = isLive && isFlownByPi(store.text("flight_mode"));
    const acting = isLive ? actingMode(store) : null;
    const reported = piModes(store);
    // An older aircraft reports none, and takes AUTO.
    const all = reported ?? new Map([[AUTO, null]]);
    const own = (mode) => (all.has(mode) ? all.get(mode) : reported === null ? NOT_REPORTED : "mode_unknown");
    // AUTO also acts while the Raspberry Pi flies a mode that cannot be selected.
    const isActive = (mode) => isPi && mode === (all.has(acting) ? acting : AUTO);
    this.#large.show(LARGE.map((mode) => this.#of(mode, own(mode), isActive(mode))));
    const names = [...all.keys()].filter((mode) => !LARGE.includes(mode));
    this.#pi.show(names.map((mode) => this.#of(mode, own(mode), isActive(mode))));
    this.#board.show(boardModes(store).map((mode) => this.#of(mode, null, !isPi && mode === acting)));
    setText(this.#line, this.#switchText());
  }

  #of(mode, code, isActive) {
    const isEnabled = this.#sender.disabledReason(NAME, { mode }) === null;
    return { mode, code, reason: code === null ? "" : modeReason(code), isActive, isEnabled };
  }

  async #select(mode) {
    const about = modeText(mode);
    const question = {
      title: `Fly ${mode}?`,
      text: `Now it flies ${actingMode(this.#store) ?? "an unknown mode"}.${about && ` In ${mode} ${about}.`} The pilot's switch decides: leaving AUTO there takes over immediately.`,
      yes: `Fly ${mode}`,
      no: "Leave it",
    };
    await this.#sender.send(NAME, { mode }, { note: this.#note, question });
  }

  #switchText() {
    const selected = switchMode(this.#store);
    return selected === null || selected === AUTO
      ? ""
      : `The pilot's switch stands at ${selected}: the aircraft takes a mode only at AUTO.`;
  }
}

export function heading(text) {
  return html("h3", { text });
}

import { SILENT } from "./disabled_reason.js";
import { html, setAttribute, setText } from "../dom.js";
import { heading } from "./flight_modes.js";
import { HeldButton } from "./held_button.js";

/** Arm and disarm, each by a held press, which prevents accidents. */
export class Arming {
  #store;
  #sender;
  #arm;
  #disarm;
  #state = html("strong");
  #line = html("p.quiet");
  #note = html("p.note", { id: "arming-note", role: "status" });

  constructor(store, sender) {
    this.#store = store;
    this.#sender = sender;
    this.#arm = this.#button("arm-button", "Hold to arm", "up.arm");
    this.#disarm = this.#button("disarm-button", "Hold to disarm", "up.disarm");
    const state = html("p.armed-state", {}, "The motor is ", this.#state);
    this.element = html(
      "section.part.arming",
      {},
      heading("Motor"),
      state,
      html("div.buttons", {}, this.#arm.button, this.#disarm.button),
      this.#arm.how,
      this.#disarm.how,
      this.#line,
      this.#note,
    );
  }

  update() {
    const isLive = this.#store.freshness(null) === "live";
    const armed = this.#armed();
    setText(this.#state, armed === null ? "in a state not known" : armed ? "ARMED" : "disarmed");
    setAttribute(this.#state, "data-armed", String(armed));
    this.#arm.button.disabled = this.#reason("up.arm") !== null;
    this.#disarm.button.disabled = this.#reason("up.disarm") !== null;
    this.#arm.update();
    this.#disarm.update();
    setText(this.#line, this.#lineText(isLive, armed));
  }

  #button(id, text, name) {
    return new HeldButton({
      id,
      text,
      disabledReason: () => this.#reason(name),
      fire: () => this.#sender.send(name, {}, { note: this.#note }),
      now_s: () => this.#store.now_s,
      aircraft: () => this.#store.aircraft,
      note: this.#note,
    });
  }

  #reason(name) {
    const reason = this.#sender.disabledReason(name);
    if (reason !== null) {
      return reason;
    }
    if (this.#store.aircraftState !== "live") {
      return SILENT;
    }
    const armed = this.#armed();
    if (armed === null || armed !== (name === "up.arm")) {
      return null;
    }
    return armed
      ? { code: "armed", text: "The motor is already armed." }
      : { code: "disarmed", text: "The motor is already disarmed." };
  }

  #armed() {
    return this.#store.freshnessAt("armed") === "live" ? this.#store.flag("armed") : null;
  }

  #lineText(isLive, armed) {
    if (!isLive) {
      return "The aircraft is silent: it can neither be armed nor disarmed from here.";
    }
    const vetoes = this.#store.texts("vetoes") ?? [];
    if (armed === false && vetoes.length > 0) {
      return `It will refuse to arm: ${vetoes.join("; ")}.`;
    }
    return armed ? "It disarms only when the throttle has been low for 2 s." : "";
  }
}

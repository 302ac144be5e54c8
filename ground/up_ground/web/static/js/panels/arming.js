import { setAttribute, setText } from "../readout.js";
import { element } from "./element.js";
import { heading } from "./flight_modes.js";
import { HeldButton } from "./held_button.js";

/** Arm and disarm, each by a held press, which prevents accidents. */
export class Arming {
  #store;
  #asker;
  #arm;
  #disarm;
  #state = element("strong");
  #line = element("p.quiet");
  #note = element("p.note", { id: "arming-note", role: "status" });

  constructor(store, asker) {
    this.#store = store;
    this.#asker = asker;
    this.#arm = this.#button("arm-button", "Hold to arm", "up.arm");
    this.#disarm = this.#button("disarm-button", "Hold to disarm", "up.disarm");
    const state = element("p.armed-state", {}, "The motor is ", this.#state);
    this.element = element(
      "section.part.arming",
      {},
      heading("Motor"),
      state,
      element("div.buttons", {}, this.#arm.button, this.#disarm.button),
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
    this.#arm.button.disabled = this.#refusal("up.arm") !== "";
    this.#disarm.button.disabled = this.#refusal("up.disarm") !== "";
    this.#arm.update();
    this.#disarm.update();
    setText(this.#line, this.#lineText(isLive, armed));
  }

  #button(id, text, name) {
    return new HeldButton({
      id,
      text,
      objection: () => this.#refusal(name),
      fire: () => this.#asker.ask(name, {}, { note: this.#note }),
      now_s: () => this.#store.now_s,
      note: this.#note,
    });
  }

  #refusal(name) {
    const why = this.#asker.objection(name);
    if (why) {
      return why;
    }
    if (this.#store.aircraftState !== "live") {
      return "The aircraft is silent.";
    }
    const armed = this.#armed();
    if (armed !== null && armed === (name === "up.arm")) {
      return armed ? "The motor is armed already." : "The motor is disarmed already.";
    }
    return "";
  }

  /** Whether the motor is armed, null without a fresh value. */
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

import { html, setAttribute, setText } from "../dom.js";
import { acknowledge, isAcknowledged, worstLevel } from "../state/alarm_level.js";

/** One bar for the alarms of aircraft that are not selected: the worst of those that are not acknowledged. */
export class OtherAlarm {
  #alarm = null;
  #text = html("strong");
  #select;
  #bar;

  constructor(store) {
    this.#select = html("button", { type: "button", on: { click: () => store.watch(this.#alarm.aircraft) } });
    const done = { type: "button", text: "Acknowledge", on: { click: () => acknowledge(this.#alarm) } };
    const buttons = html("span.alarm-buttons", {}, this.#select, html("button.acknowledge", done));
    this.#bar = html("div.alarm", { id: "other-alarm", role: "alert" }, this.#text, buttons);
  }

  /** place: of all bars; alarms: of other aircraft. */
  show(place, alarms) {
    const open = alarms.filter((each) => !isAcknowledged(each));
    const level = worstLevel(open);
    this.#alarm = open.find((each) => each.level === level) ?? null;
    if (this.#alarm === null) {
      this.#bar.remove();
      return;
    }
    const { aircraft, kind, code, text } = this.#alarm;
    const more = new Set(open.map((each) => each.aircraft)).size - 1;
    setText(this.#text, `${aircraft}: ${text}${more > 0 ? ` (and alarms of ${more} more aircraft)` : ""}`);
    setText(this.#select, `Show ${aircraft}`);
    const state = { aircraft, kind, code: code ?? "", level };
    Object.entries(state).forEach(([name, value]) => setAttribute(this.#bar, `data-${name}`, String(value)));
    if (!this.#bar.isConnected) {
      place.append(this.#bar);
    }
  }
}

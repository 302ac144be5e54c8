import { html, setAttribute, setText } from "../dom.js";
import { Readout, Row } from "../readout.js";
import { progressText } from "../mission/progress.js";
import { modeText } from "../panels/messages.js";
import { actingMode, controllerText } from "../state/flight_mode.js";
import { flagText, numberText, UNKNOWN } from "../state/format.js";
import { switchText } from "../state/pilot_input.js";

const MISSION = "MISSION";

/** State of control: mode, armed, vetoes, load, failsafe. */
export function mount(element, store) {
  const mode = html("span", { id: "flight-mode" });
  const meaning = html("p", { id: "flight-meaning" });
  const armed = html("span", { id: "flight-armed" });
  const age = html("span", { class: "age" });
  const list = html("dl", { class: "rows" });
  const vetoes = html("div", { id: "vetoes" });
  element.append(html("p", { class: "flight-head" }, mode, armed, age), meaning, list, vetoes);
  const modeReadout = new Readout(mode, "flight_mode", () => actingMode(store), age, "text");
  const armedText = (value) => flagText(value, "ARMED", "disarmed");
  const armedReadout = new Readout(armed, "armed", armedText, null, "flag");
  const rows = [
    new Row(list, "Controlled by", "flight_mode", "text", () => controllerText(store) || UNKNOWN),
    new Row(list, "Raspilot", "mode", "text"),
    new Row(list, "Switch", "arduino.switch", "text", () => switchText(store)),
    new Row(list, "Failsafe", "arduino.failsafe", "flag", (isOn) => (isOn ? "YES" : "no"), (isOn) => (isOn ? "alarm" : "")),
    new Row(list, "Raspberry Pi", "load.panic", "flag", (value) => busyText(value, store)),
  ];
  return {
    update() {
      modeReadout.update(store);
      const acting = actingMode(store);
      setText(meaning, [modeText(acting), acting === MISSION ? progressText(store) : ""].filter(Boolean).join(". "));
      setAttribute(armed, "data-armed", String(armedReadout.update(store)));
      for (const row of rows) {
        row.update(store);
      }
      showVetoes(vetoes, store);
    },
  };
}

function busyText(value, store) {
  const period_ms = store.number("system.period_ms") ?? store.number("load.delay_ms");
  const busy = `busy (${numberText(store.number("load.cpu"))} %): telemetry every ${numberText(period_ms)} ms`;
  return flagText(value, busy, "not busy");
}

function showVetoes(place, store) {
  const all = store.texts("vetoes");
  const isArmed = store.flag("armed") === true;
  const shown = JSON.stringify([all, isArmed]);
  setAttribute(place, "data-freshness", all === null ? "none" : store.freshness(null));
  if (place.shownVetoes === shown) {
    return;
  }
  place.shownVetoes = shown;
  // In the air a veto is information, not a warning: it names the condition for arming again.
  place.classList.toggle("is-warning", !isArmed && all !== null && all.length > 0);
  const title = vetoTitle(all, isArmed);
  const items = (all ?? []).map((each) => html("li", {}, each));
  place.replaceChildren(html("p", {}, title), ...(items.length ? [html("ul", {}, ...items)] : []));
}

function vetoTitle(all, isArmed) {
  if (all === null) {
    return "What forbids arming is not known";
  }
  if (all.length === 0) {
    return isArmed ? "Nothing forbids arming again" : "Nothing forbids arming";
  }
  return isArmed ? "Against arming again" : "Arming is forbidden";
}

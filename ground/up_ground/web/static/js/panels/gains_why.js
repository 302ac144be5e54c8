import { switchMode } from "./switch.js";

const NAME = "arduino.pids.tunings";

/**
 * Why gains cannot be sent now, as far as the page can tell before trying. Returns one sentence;
 * empty: no known reason.
 */
export function gainsObjection(store, asker) {
  const why = asker.objection(NAME);
  if (why) {
    return why;
  }
  if (store.aircraftState !== "live") {
    return "The aircraft is silent.";
  }
  if (store.status?.tune_in_flight === true) {
    return "";
  }
  const rule = "tune_in_flight in the aircraft's mission_control.yml allows it";
  const state =
    store.flag("armed") === true
      ? "the aircraft is armed"
      : switchMode(store) === "AUTO"
        ? "the pilot's switch stands at AUTO"
        : store.flag("in_flight") === true
          ? "the aircraft has no motor and its receiver was heard since power-on"
          : "";
  if (!state) {
    return "";
  }
  return store.status?.tune_in_flight === false
    ? `Gains are refused while ${state}, unless ${rule}.`
    : "";
}

/** Warning before gains are changed in flight; empty: none. */
export function gainsWarning(store) {
  if (store.flag("armed") !== true && store.flag("in_flight") !== true) {
    return "";
  }
  return store.status?.tune_in_flight === true
    ? "The aircraft may be in flight: what you send flies immediately."
    : "The aircraft may be in flight: it may refuse gains.";
}

import { isOnlyRequest } from "../state/roles.js";
import { gainsObjection, gainsWarning } from "./gains_why.js";

const GAINS = "arduino.pids.tunings";

/** Actions that need more than a confirmation are offered only in their own panel. */
const ELSEWHERE = {
  "up.arm": "Arming takes the button that is held, under Commands.",
  "up.disarm": "Disarming takes the button that is held, under Commands.",
};

/**
 * Why a Command is not sent by its name: its own panel's conditions cannot be bypassed. name: of
 * the Command itself, not an alias; data: null: not written yet. Returns one sentence; empty: it is
 * offered.
 */
export function ruleAgainst(store, asker, name, data = null) {
  const why = asker.objection(name, data ?? {});
  if (why) {
    return why;
  }
  if (Object.hasOwn(ELSEWHERE, name)) {
    return ELSEWHERE[name];
  }
  return data !== null && setsGains(name, data) ? gainsObjection(store, asker) : "";
}

/** name: of the Command. Returns warning before it is sent; empty: none. */
export function warningOf(store, name, data) {
  return setsGains(name, data) ? gainsWarning(store) : "";
}

// A request that carries gains too counts as a change of gains, whatever the aircraft makes of it.
function setsGains(name, data) {
  return name === GAINS && (!isOnlyRequest(name, data) || Object.hasOwn(data, "pids"));
}

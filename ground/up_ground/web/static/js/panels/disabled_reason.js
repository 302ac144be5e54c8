import { setAttribute, setText } from "../dom.js";
import { capital } from "../state/format.js";
import { switchMode } from "../state/pilot_input.js";

/** Why something is not offered, as {code, text}; null: it is offered. Programs and tests read the code. */
const GAINS = "arduino.pids.tunings";
const RANK = { observer: 0, operator: 1, pilot: 2, admin: 3 };

/** Commands that are sent only by their held button. */
const HELD_ONLY = { "up.arm": "Arm", "up.disarm": "Disarm" };

const OFFLINE = { code: "no_server", text: "Not connected to the ground server." };
const REPLAY = { code: "replay", text: "This is a replay: it takes no Commands." };
export const SILENT = { code: "silent", text: "The aircraft is silent." };

/** Whether the link's role includes the needed one; an unknown role does. needed: null: of an unknown Command. */
function roleAllows(role, needed) {
  return !Object.hasOwn(RANK, role ?? "") || RANK[role] >= RANK[needed ?? "operator"];
}

export function disabledReason(store, connection, name, data = {}) {
  if (!connection.isOpen || store.aircraft === null) {
    return OFFLINE;
  }
  if (connection.welcome.is_replay) {
    return REPLAY;
  }
  const needed = store.catalogue.role(name, data);
  // What an observer may send only requests data: it needs no control.
  const isRequest = needed === "observer";
  const reason = (isRequest ? null : controlReason(store, connection)) ?? offlineReason(store);
  if (reason !== null) {
    return reason;
  }
  const role = store.status?.role ?? null;
  if (roleAllows(role, needed)) {
    return null;
  }
  const text = `The aircraft's link has the role ${role}, which does not allow it (role in its mission_control.yml).`;
  return { code: "role", text };
}

/** Why the aircraft cannot be reached at all; null: no known reason. */
export function offlineReason(store) {
  const text = `The aircraft ${store.aircraft} is not connected to the proxy.`;
  const isOffline = store.status?.link?.aircraft_online === false;
  return isOffline ? { code: "aircraft_offline", text } : null;
}

function controlReason(store, connection) {
  const { may_control, denial } = connection.welcome;
  if (may_control === false) {
    return { code: String(denial?.code), text: sentence(denial?.text || "this page may only watch") };
  }
  const control = store.status?.control;
  switch (control?.holder) {
    case "you":
      return null;
    case "page": {
      const name = control.holder_name || "Another page";
      return { code: "control_page", text: `${name} has control: this page watches.` };
    }
    case "ground":
      return { code: "control_ground", text: "Another ground station has control: this page watches." };
    case "nobody":
      return { code: "control_free", text: "Control is free: request it to send Commands." };
    default:
      return { code: "control_unknown", text: "The owner of control is not known yet." };
  }
}

export function sentence(text) {
  const trimmed = String(text).trim().replace(/\.$/, "");
  return trimmed === "" ? "" : `${capital(trimmed)}.`;
}

/** Why gains cannot be sent now, as far as the page knows before the aircraft answers. */
export function gainsReason(store, sender) {
  const reason = sender.disabledReason(GAINS) ?? (store.aircraftState === "live" ? null : SILENT);
  if (reason !== null || store.status?.tune_in_flight !== false) {
    return reason;
  }
  const states = [
    ["armed", store.flag("armed") === true, "the aircraft is armed"],
    ["auto", switchMode(store) === "AUTO", "the pilot's switch stands at AUTO"],
    ["in_flight", store.flag("in_flight") === true, "an aircraft without motor has a receiver signal"],
  ];
  const found = states.find(([, isActive]) => isActive);
  if (found === undefined) {
    return null;
  }
  const text = `Gains are refused while ${found[2]}, unless tune_in_flight in the aircraft's mission_control.yml allows it.`;
  return { code: `tune_${found[0]}`, text };
}

/** Warning before gains are changed in flight; empty: none. */
export function gainsWarning(store) {
  if (store.flag("armed") !== true && store.flag("in_flight") !== true) {
    return "";
  }
  return store.status?.tune_in_flight === true
    ? "The aircraft may be in flight: the gains take effect immediately."
    : "The aircraft may be in flight: it may refuse gains.";
}

/** Why a Command is not sent by its name: the conditions of its own panel hold. data: null: not written. */
export function nameReason(store, sender, name, data = null) {
  const reason = sender.disabledReason(name, data ?? {});
  if (reason !== null) {
    return reason;
  }
  if (Object.hasOwn(HELD_ONLY, name)) {
    return { code: "held_only", text: `${HELD_ONLY[name]} only by the held button, under Commands.` };
  }
  return data !== null && setsGains(name, data) ? gainsReason(store, sender) : null;
}

/** Warning before a Command is sent; empty: none. */
export function warningOf(store, name, data) {
  return setsGains(name, data) ? gainsWarning(store) : "";
}

// A request that carries gains too counts as a change of gains, whatever the aircraft makes of it.
function setsGains(name, data) {
  return name === GAINS && (data.request !== true || Object.hasOwn(data, "pids"));
}

/** Show a reason, or hide its element. otherwise: text without a reason. */
export function showReason(element, reason, otherwise = "") {
  setText(element, reason?.text ?? otherwise);
  setAttribute(element, "data-code", reason?.code ?? "");
  element.hidden = reason === null && otherwise === "";
}

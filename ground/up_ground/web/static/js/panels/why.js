import { isOnlyRequest, roleAllows } from "../state/roles.js";

/**
 * Why a Command is not offered. name: of the Command. Returns one sentence; empty: it is offered.
 */
export function objection(store, connection, name, data = {}) {
  if (!connection.isOpen || store.aircraft === null) {
    return "There is no connection to the ground server.";
  }
  if (connection.welcome.is_replay) {
    return "This is a replay: there is nothing to command.";
  }
  if (!isOnlyRequest(name, data)) {
    const control = controlObjection(store, connection);
    if (control) {
      return control;
    }
  }
  const away = awayWords(store);
  if (away) {
    return sentence(away);
  }
  const role = store.status?.role ?? null;
  if (!isOnlyRequest(name, data) && !roleAllows(role, name, store.catalogue?.role(name))) {
    return `The aircraft's link has the role ${role}, which does not allow it (role in its mission_control.yml).`;
  }
  return "";
}

/** Why the aircraft cannot be reached at all; empty: no known reason. */
export function awayWords(store) {
  return store.status?.link?.aircraft_online === false ? `the aircraft ${store.aircraft} is not connected to the proxy` : "";
}

/** Why this page does not command. Returns one sentence; empty: it does. */
export function controlObjection(store, connection) {
  if (!connection.isOpen) {
    return "There is no connection to the ground server.";
  }
  if (connection.welcome.is_replay) {
    return "This is a replay: there is nothing to command.";
  }
  if (connection.welcome.may_control === false) {
    return sentence(connection.welcome.why_not || "this page may only watch");
  }
  const control = store.status?.control;
  switch (control?.holder) {
    case "you":
      return "";
    case "page":
      return `${control.holder_name || "Another page"} has control: this page watches.`;
    case "ground":
      return "Another ground station has control: this page watches.";
    case "nobody":
      return "Nobody has control: ask for it to command.";
    default:
      return "Who has control is not known yet.";
  }
}

/** With a capital and a full stop. */
export function sentence(text) {
  const trimmed = String(text).trim().replace(/\.$/, "");
  return trimmed === "" ? "" : `${trimmed[0].toUpperCase()}${trimmed.slice(1)}.`;
}

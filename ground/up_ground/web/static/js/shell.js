import { setAttribute, setText } from "./readout.js";
import { UNKNOWN } from "./state/format.js";
import { worstLevel } from "./sound.js";

/**
 * The frame of the page: bar, banner of the link, choice of the aircraft, silence.
 * @param {object} store
 * @param {object} connection
 * @returns {{update: () => void}}
 */
export function mountShell(store, connection) {
  const at = (id) => document.getElementById(id);
  const select = at("aircraft-select");
  let shownNames = "";
  let reason = "";
  connection.on("closed", (event) => {
    reason = event.reason;
  });
  select.addEventListener("change", () => store.watch(select.value));

  function showNames() {
    const names = JSON.stringify(store.names);
    if (names !== shownNames) {
      shownNames = names;
      select.replaceChildren(...store.names.map((name) => new Option(name, name)));
    }
    if (store.aircraft !== null && select.value !== store.aircraft) {
      select.value = store.aircraft;
    }
  }

  function showLink() {
    const banner = at("link-banner");
    setHidden(banner, connection.isOpen);
    if (!connection.isOpen) {
      const retry_s = connection.retry_s;
      const next =
        retry_s === null ? "trying now" : `next attempt in ${retry_s.toFixed(1)} s`;
      const why = reason === "" ? "" : ` (${reason})`;
      setText(banner, `No connection to the ground server${why}: ${next}`);
    }
  }

  function showState() {
    const state = store.aircraftState;
    const root = document.documentElement;
    setAttribute(root, "data-link", connection.isOpen ? "open" : "closed");
    setAttribute(root, "data-aircraft-state", state);
    const silence = at("silence");
    setHidden(silence, state === "live");
    if (state !== "live") {
      setText(silence, silenceText(store, state));
    }
    const frame = store.freshness(null);
    showBar("bar-link", linkWord(connection, state), state === "none" ? "none" : frame);
    showBar("bar-mode", store.text("flight_mode"), frame);
    const armed = store.flag("armed");
    showBar("bar-armed", armed === null ? null : armed ? "ARMED" : "disarmed", frame);
    setAttribute(at("bar-armed"), "data-armed", String(armed));
    const alarm = alarmOf(store, connection);
    setAttribute(at("bar-alarm"), "data-level", alarm.level);
    setText(at("bar-alarm"), alarm.text);
  }

  function showBar(id, text, freshness) {
    setText(at(id), text ?? UNKNOWN);
    setAttribute(at(id), "data-freshness", text === null ? "none" : freshness);
  }

  return {
    update() {
      showNames();
      showLink();
      showState();
    },
  };
}

/**
 * @param {object} store
 * @param {"silent"|"none"} state
 * @returns {string} what stands over the instruments
 */
export function silenceText(store, state) {
  return state === "none" ? "nothing heard yet" : `no news for ${store.age_s(null).toFixed(1)} s`;
}

/**
 * What the bar says of alarms; what the page notices itself stands before what it was told.
 * @param {object} store
 * @param {object} connection
 * @returns {{level: string, text: string}}
 */
export function alarmOf(store, connection) {
  if (!connection.isOpen) {
    return { level: "alarm", text: "no server" };
  }
  const level = worstLevel(store.alarms);
  const worst = store.alarms.filter((each) => each.level === level);
  if (level !== "alarm" && store.aircraftState === "silent") {
    return { level: "alarm", text: "silent" };
  }
  if (level === "none") {
    return { level, text: store.aircraftState === "live" ? "none" : UNKNOWN };
  }
  return { level, text: worst.length === 1 ? String(worst[0].kind) : `${worst.length} alarms` };
}

function setHidden(element, isHidden) {
  if (element.hidden !== isHidden) {
    element.hidden = isHidden;
  }
}

function linkWord(connection, state) {
  if (!connection.isOpen) {
    return "no server";
  }
  return { live: "live", silent: "silent", none: "waiting" }[state];
}

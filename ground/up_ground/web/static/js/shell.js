import { setAttribute, setText } from "./dom.js";
import { storageOf } from "./link/storage.js";
import { alarmOf } from "./state/alarm_level.js";
import { actingMode } from "./state/flight_mode.js";
import { UNKNOWN } from "./state/format.js";
import { STATE_WORDS } from "./state/newest_frame.js";

const THEMES = ["dark", "daylight"];

/** Dark or daylight: follows the system until the user chooses with the button. */
export function mountTheme(button) {
  const memory = storageOf("localStorage");
  const system = matchMedia("(prefers-color-scheme: light)");
  const chosen = () => (THEMES.includes(memory.get("theme")) ? memory.get("theme") : null);
  const show = () => {
    const theme = chosen() ?? (system.matches ? "daylight" : "dark");
    document.documentElement.dataset.theme = theme;
    button.textContent = theme === "dark" ? "Daylight" : "Dark";
    document.dispatchEvent(new CustomEvent("up-theme", { detail: theme }));
  };
  button.addEventListener("click", () => {
    memory.set("theme", document.documentElement.dataset.theme === "dark" ? "daylight" : "dark");
    show();
  });
  system.addEventListener("change", show);
  show();
}

/** All parts, or the flying view: it is the default where only that fits. */
export function mountView(button) {
  const memory = storageOf("localStorage");
  const small = matchMedia("(min-width: 42rem) and (max-height: 32rem) and (orientation: landscape)");
  const show = () => {
    const view = memory.get("view") ?? (small.matches ? "fly" : "all");
    document.documentElement.dataset.view = view;
    setAttribute(button, "aria-pressed", String(view === "fly"));
    // The map measures its place again.
    window.dispatchEvent(new Event("resize"));
  };
  button.addEventListener("click", () => {
    memory.set("view", document.documentElement.dataset.view === "fly" ? "all" : "fly");
    show();
  });
  small.addEventListener("change", show);
  show();
}

/** The frame of the page: bar, banner of the link, choice of the aircraft, silence. */
export function mountShell(store, connection) {
  const at = (id) => document.getElementById(id);
  const select = at("aircraft-select");
  let shownNames = "";
  let reason = "";
  connection.on("closed", (event) => {
    reason = event.reason;
  });
  connection.on("open", ({ welcome }) => {
    at("docs-link").hidden = welcome.has_docs !== true;
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
    banner.hidden = connection.isOpen;
    setAttribute(banner, "data-code", connection.isFull ? "full" : "lost");
    if (!connection.isOpen) {
      const retry_s = connection.retry_s;
      setText(at("link-banner-text"), lostText(reason, connection.isFull));
      const next = retry_s === null ? "trying now" : `next attempt in ${retry_s.toFixed(1)} s`;
      setText(at("link-banner-next"), next);
    }
  }

  function showState() {
    const state = store.aircraftState;
    const root = document.documentElement;
    setAttribute(root, "data-link", connection.isOpen ? "open" : "closed");
    setAttribute(root, "data-aircraft-state", state);
    const silence = at("silence");
    silence.hidden = state === "live";
    if (state !== "live") {
      setText(silence, silenceText(store, state));
      setAttribute(silence, "data-age-s", String(store.age_s(null)?.toFixed(1) ?? ""));
    }
    const frame = store.freshness(null);
    showBar("bar-link", linkWord(store, connection), state === "none" ? "none" : frame);
    const flight = store.freshness("flight");
    showBar("bar-mode", actingMode(store), flight);
    const armed = store.flag("armed");
    showBar("bar-armed", armed === null ? null : armed ? "ARMED" : "disarmed", flight);
    setAttribute(at("bar-armed"), "data-armed", String(armed));
    const alarm = alarmOf(store, connection);
    setAttribute(at("bar-alarm"), "data-level", alarm.level);
    setText(at("bar-alarm"), alarm.text ?? UNKNOWN);
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
    /** Reset stale text outside of the bar's states. */
    fail() {
      setAttribute(document.documentElement, "data-aircraft-state", "none");
      setAttribute(at("bar-alarm"), "data-level", "warning");
      setText(at("bar-alarm"), UNKNOWN);
    },
  };
}

export function silenceText(store, state) {
  return state === "none" ? "no telemetry yet" : `no news for ${store.age_s(null).toFixed(1)} s`;
}

/** Why the page is disconnected; isFull: the server takes no more pages. */
export function lostText(reason, isFull) {
  if (isFull) {
    return `The ground server is full (${reason || "too many pages"}):`;
  }
  return `No connection to the ground server${reason === "" ? "" : ` (${reason})`}:`;
}

function linkWord(store, connection) {
  if (!connection.isOpen) {
    return connection.isFull ? "server full" : "no server";
  }
  if (store.aircraftState === "live" && store.replay !== null) {
    return store.replay.is_playing === false ? "paused" : "replay";
  }
  return STATE_WORDS[store.aircraftState];
}

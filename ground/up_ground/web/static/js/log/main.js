import { html, setText, showMissing, styleSheet } from "../dom.js";
import { mountTheme } from "../shell.js";
import { readFlights } from "./flight_data.js";
import { Modes } from "./modes.js";
import { Panel } from "./panel.js";
import { fillSignals } from "./signal.js";
import { Spectrum } from "./spectrum.js";
import { TimeWindow, timeText } from "./time_window.js";
import { TrackMap } from "./track_map.js";

const SETTLED_MS = 120;
const CONTEXT_S = 10;
/** The panels at the start, as far as the flight has their signals. */
const PANELS = [
  ["up.orientation.update.roll", "simulator.truth.roll_deg", "up.setpoint.set.roll"],
  ["up.orientation.update.pitch", "simulator.truth.pitch_deg", "up.setpoint.set.pitch"],
  ["up.orientation.update.roll_rate", "up.orientation.update.pitch_rate", "up.orientation.update.yaw_rate"],
  ["up.altitude.change.altitude", "up.location.update.altitude", "simulator.truth.altitude_m"],
  ["up.location.update.speed", "simulator.truth.ground_speed_m_s", "simulator.truth.airspeed_m_s"],
  ["up.rx.update.ailerons", "up.rx.update.elevator", "up.rx.update.throttle", "up.rx.update.rudder"],
];
const at = (id) => document.getElementById(id);

function titleOf(flight) {
  const start = new Date(flight.start_unix_s * 1000).toISOString().replace("T", " ").slice(0, 19);
  return [html("b", { text: flight.name }), ` ${flight.aircraft} ${start} UTC, ${timeText(flight.length_s)} `];
}

/** The same moment of both flights: the first arming, otherwise the begin of their logs. */
function align(flights) {
  const [first, other] = flights;
  if (other) {
    other.offset_s = Math.round(((first.armed_s ?? 0) - (other.armed_s ?? 0)) * 10) / 10;
    at("log-offset-field").hidden = false;
    at("log-offset").value = String(other.offset_s);
  }
}

function limitsOf(flights) {
  return [
    Math.min(...flights.map((each) => each.offset_s)),
    Math.max(...flights.map((each) => each.offset_s + each.length_s)),
  ];
}

function showEvents(place, flight, window) {
  const list = html("ul", { id: "log-event-list" });
  const shown = flight.events.map(({ time_s, level, code, text }) => {
    const go = () => {
      const half_s = Math.min((window.end_s - window.begin_s) / 2, CONTEXT_S);
      window.setCursor(time_s);
      window.set(time_s - half_s, time_s + half_s);
    };
    const line = html(
      "button",
      { type: "button", "data-level": level, "data-code": code, on: { click: go } },
      html("span", { text: timeText(time_s, 1) }),
      html("span", { text }),
    );
    return html("li", {}, line);
  });
  list.append(...shown);
  place.append(list);
}

function showCursor(flight, window) {
  const { cursor_s, begin_s, end_s } = window;
  const span = `in view: ${timeText(begin_s, 1)} to ${timeText(end_s, 1)}`;
  const utc = (time_s) => new Date((flight.start_unix_s + time_s) * 1000).toISOString().slice(11, 23);
  setText(at("log-cursor"), cursor_s === null ? span : `${timeText(cursor_s, 3)} (${utc(cursor_s)} UTC)`);
}

/** Redraw on every step, fetch when it stands. */
function whenSettled(call) {
  let timer = 0;
  return () => {
    clearTimeout(timer);
    timer = setTimeout(call, SETTLED_MS);
  };
}

function addKeys(window) {
  const keys = {
    ArrowLeft: () => window.move(-0.2),
    ArrowRight: () => window.move(0.2),
    "+": () => window.zoom(0.5),
    "-": () => window.zoom(2),
    0: () => window.showAll(),
  };
  document.addEventListener("keydown", (event) => {
    const isTyping = ["INPUT", "SELECT"].includes(event.target.tagName);
    if (!isTyping && !event.ctrlKey && !event.metaKey && event.key in keys) {
      keys[event.key]();
      event.preventDefault();
    }
  });
}

async function begin() {
  const [flights, { default: UPlot }] = await Promise.all([
    readFlights(),
    import("../../vendor/uplot/uPlot.esm.js"),
    styleSheet("vendor/uplot/uPlot.min.css"),
  ]);
  align(flights);
  const window = new TimeWindow(...limitsOf(flights));
  at("log-title").append(...flights.flatMap(titleOf));
  document.title = flights.map((each) => each.name).join(", ");
  fillSignals(at("log-signals"), flights);
  const parts = { flights, window, modes: new Modes(at("log-modes"), flights[0], window) };
  const map = new TrackMap(at("log-map"), flights, window);
  const spectrum = new Spectrum(UPlot, at("log-spectrum"), flights, window);
  const panels = new Set();
  const load = () => Promise.all([...[...panels].map((each) => each.load()), spectrum.load()]);

  function add(names) {
    const remove = (panel) => {
      panels.delete(panel);
      panel.element.remove();
    };
    const panel = new Panel(UPlot, parts, names, remove);
    panels.add(panel);
    at("log-panels").append(panel.element);
    return panel;
  }

  for (const names of PANELS) {
    const known = names.filter((name) => flights.some((flight) => flight.find(name) >= 0));
    if (known.length > 0) {
      add(known);
    }
  }
  const loadSoon = whenSettled(load);
  window.on("span", () => {
    panels.forEach((each) => each.draw());
    showCursor(flights[0], window);
    loadSoon();
  });
  window.on("cursor", () => {
    panels.forEach((each) => each.showCursor());
    showCursor(flights[0], window);
  });
  at("log-in").addEventListener("click", () => window.zoom(0.5));
  at("log-out").addEventListener("click", () => window.zoom(2));
  at("log-all").addEventListener("click", () => window.showAll());
  at("log-add").addEventListener("click", () => add([]).draw());
  at("log-offset").addEventListener("change", () => {
    flights[1].offset_s = Number(at("log-offset").value) || 0;
    window.setLimits(...limitsOf(flights));
    window.set(window.begin_s, window.end_s);
    map.load();
  });
  globalThis.addEventListener("resize", loadSoon);
  addKeys(window);
  showEvents(at("log-events"), flights[0], window);
  showCursor(flights[0], window);
  await Promise.all([load(), map.load()]);
  document.addEventListener("up-theme", () => {
    panels.forEach((each) => each.rebuild());
    spectrum.rebuild();
    map.draw();
  });
  document.documentElement.dataset.opened = performance.now().toFixed(0);
}

mountTheme(at("theme-button"));
begin().catch((error) => {
  console.error(error);
  showMissing("log", `nothing to show: ${error.message}. The charts need uPlot: run tools/web_assets (it needs npm) and reload this page.`);
});

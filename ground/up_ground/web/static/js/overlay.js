import { html, setAttribute, setText, short, svg } from "./dom.js";
import { mount as mountHorizon } from "./instruments/horizon.js";
import { mount as mountTapes } from "./instruments/tapes.js";
import { flightBatteryLevel } from "./instruments/battery.js";
import { Connection, linkAddress } from "./link/connection.js";
import { clockText } from "./panels/messages.js";
import { PartRegistry } from "./part_registry.js";
import { freshnessOf, Readout } from "./readout.js";
import { distanceText } from "./state/earth.js";
import { actingMode } from "./state/flight_mode.js";
import { FlightTimer } from "./state/flight_timer.js";
import { flagText, numberText, UNKNOWN } from "./state/format.js";
import { Store } from "./state/store.js";

/** The readouts around the horizon: mode, arming, flight time, battery, the way home, the link. */
function mountReadouts(element, store) {
  const readouts = [];
  const corner = (name, ...values) => element.append(html(`p.corner.is-${name}`, {}, ...values));
  const readout = (path, format, kind) => {
    const [value, age] = [html("span"), html("span", { class: "age" })];
    readouts.push(new Readout(value, path, format, age, kind));
    return [value, age];
  };
  const mode = readout("flight_mode", () => actingMode(store), "text");
  corner("mode", ...mode, ...readout("armed", (value) => flagText(value, "", "disarmed"), "flag"));
  const time = html("span", { "data-key": "flight.time" });
  corner("time", time);
  const battery = readout("arduino.flight_battery_v", (value) => `${numberText(value, 1)} V`, "number");
  corner("battery", ...battery);
  const arrow = svg("path", { d: "M0 -45 L28 40 L0 22 L-28 40 Z", id: "home-arrow" });
  const picture = svg("svg", { viewBox: "-50 -50 100 100", class: "home-arrow", "aria-hidden": "true" }, arrow);
  corner("home", picture, ...readout("home.distance", distanceText, "number"));
  const link = html("span", { "data-key": "link.state" });
  corner("link", link);
  const timer = new FlightTimer();
  return {
    update() {
      for (const each of readouts) {
        each.update(store);
      }
      setAttribute(battery[0], "data-level", flightBatteryLevel(store));
      const flown = timer.update(store);
      setText(time, flown === null ? UNKNOWN : clockText(flown.time_s));
      setAttribute(time, "data-freshness", flown === null ? "none" : store.freshness("flight"));
      const turn_deg = homeTurn_deg(store);
      setAttribute(picture, "data-freshness", freshnessOf(store, turn_deg, "location"));
      setAttribute(arrow, "transform", `rotate(${short(turn_deg ?? 0)})`);
      setText(link, store.aircraftState === "live" ? "" : "NO LINK");
    },
  };
}

/** Direction to home, clockwise from the nose, degrees; null: unknown. */
function homeTurn_deg(store) {
  const heading_deg = store.number("navigation.heading") ?? store.number("heading.actual");
  const bearing_deg = store.number("home.bearing");
  return heading_deg === null || bearing_deg === null ? null : bearing_deg - heading_deg;
}

const connection = new Connection(linkAddress());
const store = new Store(connection);
// Kept by the store if the server has an aircraft of this name.
store.aircraft = new URLSearchParams(location.search).get("aircraft");
const registry = new PartRegistry(document.getElementById("missing"));
for (const [id, mount] of [["horizon", mountHorizon], ["tapes", mountTapes], ["readouts", mountReadouts]]) {
  const element = document.getElementById(id);
  registry.add(id, mount(element, store), element);
}
store.subscribe(() => {
  setAttribute(document.documentElement, "data-aircraft-state", store.aircraftState);
  registry.update();
});
store.start();
connection.start();

import { mountHelp } from "./help.js";
import { Connection, linkAddress } from "./link/connection.js";
import { PartRegistry } from "./part_registry.js";
import { mountShell, mountTheme, mountView } from "./shell.js";
import { mountSound } from "./sound.js";
import { Store } from "./state/store.js";

/** Which module draws into which element; each has `mount(element, store, connection)`. */
const PARTS = [
  ["horizon", "./instruments/horizon.js"],
  ["tapes", "./instruments/tapes.js"],
  ["turn", "./instruments/turn.js"],
  ["compass", "./instruments/compass.js"],
  ["flight", "./instruments/flight.js"],
  ["navigation", "./instruments/navigation.js"],
  ["sticks", "./instruments/sticks.js"],
  ["servos", "./instruments/servos.js"],
  ["battery", "./instruments/battery.js"],
  ["link", "./instruments/link.js"],
  ["board", "./instruments/board.js"],
  ["readings", "./instruments/readings.js"],
  ["alarms", "./panels/alarms.js"],
  ["panel-fleet", "./panels/fleet.js"],
  ["panel-map", "./map/map.js"],
  ["panel-mission", "./mission/mission_panel.js"],
  ["panel-charts", "./charts/charts.js"],
  ["panel-replay", "./panels/replay.js"],
  ["panel-control", "./panels/control.js"],
  ["panel-commands", "./panels/commands.js"],
  ["panel-gains", "./panels/gains.js"],
  ["panel-profile", "./panels/profile.js"],
  ["panel-events", "./panels/events.js"],
  ["panel-any-command", "./panels/any_command.js"],
  ["panel-telemetry", "./panels/telemetry_tree.js"],
];

/** Pauses before a file that did not arrive is requested again, ms. */
const RETRY_MS = [250, 1000, 4000];

/** Import a module; a link that breaks while the page loads must not leave it without a part. */
async function importModule(path) {
  for (const pause_ms of RETRY_MS) {
    try {
      return await import(path);
    } catch (error) {
      console.warn(error);
      await new Promise((done) => setTimeout(done, pause_ms));
    }
  }
  return import(path);
}

async function mountPart(registry, [id, path], store, connection) {
  try {
    const { mount } = await importModule(path);
    const element = document.getElementById(id);
    registry.add(id, mount(element, store, connection), element);
  } catch (error) {
    registry.report(id, `${id} cannot be loaded: ${error.message}`);
    console.error(error);
  }
}

async function begin() {
  const connection = new Connection(linkAddress());
  const store = new Store(connection);
  const registry = new PartRegistry(document.getElementById("missing"));
  mountTheme(document.getElementById("theme-button"));
  mountView(document.getElementById("view-button"));
  mountSound(document.getElementById("sound-button"), store, connection);
  mountHelp();
  registry.add("bar", mountShell(store, connection), document.getElementById("bar-state"));
  store.subscribe(() => registry.update());
  store.start();
  connection.start();
  await Promise.all(PARTS.map((part) => mountPart(registry, part, store, connection)));
}

begin();

import { Crew } from "./crew.js";
import { mountHelp } from "./help.js";
import { Connection } from "./link/connection.js";
import { mountShell } from "./shell.js";
import { mountSound } from "./sound.js";
import { Store } from "./state/store.js";
import { mountTheme } from "./theme.js";

/** Which module draws into which element; each has `mount(element, store, connection)`. */
const PARTS = [
  ["horizon", "./instruments/horizon.js"],
  ["tapes", "./instruments/tapes.js"],
  ["turn", "./instruments/turn.js"],
  ["compass", "./instruments/compass.js"],
  ["flight", "./instruments/flight.js"],
  ["sticks", "./instruments/sticks.js"],
  ["servos", "./instruments/servos.js"],
  ["battery", "./instruments/battery.js"],
  ["link", "./instruments/link.js"],
  ["board", "./instruments/board.js"],
  ["readings", "./instruments/readings.js"],
  ["alarms", "./panels/alarms.js"],
  ["panel-map", "./map/map.js"],
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

async function mountPart(crew, [id, path], store, connection) {
  try {
    const { mount } = await import(path);
    const element = document.getElementById(id);
    crew.add(id, mount(element, store, connection), element);
  } catch (error) {
    crew.say(`${id} is not there: ${error.message}`);
    console.error(error);
  }
}

async function begin() {
  const address = new URL("link", location.href);
  address.protocol = address.protocol === "https:" ? "wss:" : "ws:";
  address.hash = address.search = "";
  const asked = new URLSearchParams(location.hash.slice(1));
  const connection = new Connection(address.href, { key: asked.get("key") });
  const store = new Store(connection);
  const crew = new Crew(document.getElementById("missing"));
  mountTheme(document.getElementById("theme-button"));
  mountSound(document.getElementById("sound-button"), store, connection);
  mountHelp();
  crew.add("bar", mountShell(store, connection), document.getElementById("bar-state"));
  store.subscribe(() => crew.update());
  store.start();
  connection.start();
  await Promise.all(PARTS.map((part) => mountPart(crew, part, store, connection)));
}

begin();

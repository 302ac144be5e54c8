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

/** A part that fails is named and left out; the others go on. */
class Crew {
  #parts = [];

  add(name, part) {
    this.#parts.push({ name, part });
  }

  update() {
    for (const each of this.#parts) {
      try {
        each.part.update();
      } catch (error) {
        this.#parts = this.#parts.filter((other) => other !== each);
        sayMissing(`${each.name} stopped: ${error.message}`);
        console.error(error);
      }
    }
  }
}

function sayMissing(sentence) {
  const place = document.getElementById("missing");
  const line = document.createElement("span");
  line.textContent = sentence;
  place.append(line);
  place.hidden = false;
}

async function mountPart(crew, [id, path], store, connection) {
  try {
    const { mount } = await import(path);
    crew.add(id, mount(document.getElementById(id), store, connection));
  } catch (error) {
    sayMissing(`${id} is not there: ${error.message}`);
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
  const crew = new Crew();
  mountTheme(document.getElementById("theme-button"));
  mountSound(document.getElementById("sound-button"), store, connection);
  mountHelp();
  crew.add("shell", mountShell(store, connection));
  store.subscribe(() => crew.update());
  store.start();
  connection.start();
  await Promise.all(PARTS.map((part) => mountPart(crew, part, store, connection)));
}

begin();

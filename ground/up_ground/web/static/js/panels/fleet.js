import { html, setAttribute, setText } from "../dom.js";
import { flightBatteryLevel } from "../instruments/battery.js";
import { Pace, Readout } from "../readout.js";
import { worstLevel } from "../state/alarm_level.js";
import { linkState } from "../state/fleet.js";
import { actingMode } from "../state/flight_mode.js";
import { ageText, numberText, UNKNOWN } from "../state/format.js";
import { NewestFrame } from "../state/newest_frame.js";

const NOTHING = new NewestFrame(() => 0);
const READOUTS = [
  ["mode", "Flight mode", "flight_mode", "text", (_, frame) => actingMode(frame)],
  ["armed", "Motor", "armed", "flag", (isArmed) => (isArmed ? "ARMED" : "disarmed")],
  ["height", "Height above home", "navigation.height", "number", (value) => `${numberText(value)} m`],
  ["speed", "Speed over ground", "navigation.speed", "number", (value) => `${numberText(value)} m/s`],
  ["battery", "Flight battery", "arduino.flight_battery_v", "number", (value) => `${numberText(value, 1)} V`],
];

/** One aircraft in the list. */
class FleetRow {
  #name;
  #frame = NOTHING;
  #link = html("span");
  #age = html("span", { "data-key": "fleet.age" });
  #control = html("span");
  #alarm = html("span.fleet-alarm");
  #readouts;
  #battery;

  constructor(name) {
    this.#name = name;
    this.#readouts = READOUTS.map(([, , path, kind, format]) => {
      const readout = new Readout(html("span"), path, (value) => format(value, this.#frame), null, kind);
      readout.element.setAttribute("data-key", `fleet.${path}`);
      return readout;
    });
    this.#battery = this.#readouts.at(-1).element;
    const cell = (part, label, ...values) =>
      html(`span.fleet-${part}`, { title: label }, html("span.hidden-text", { text: `${label}: ` }), ...values);
    const cells = READOUTS.map(([part, label], place) => cell(part, label, this.#readouts[place].element));
    this.element = html(
      "li.fleet-row",
      { "data-aircraft": name },
      html("button.fleet-name", { type: "button", title: name, text: name }),
      cell("link", "Link, age", this.#link, " ", this.#age),
      ...cells,
      cell("control", "Control", this.#control),
      this.#alarm,
    );
  }

  update(store, connection) {
    const isSelected = store.aircraft === this.#name;
    const frame = (isSelected ? store : store.fleet.get(this.#name)) ?? NOTHING;
    this.#frame = frame;
    this.#readouts.forEach((each) => each.update(frame));
    setAttribute(this.#battery, "data-level", flightBatteryLevel(frame));
    setAttribute(this.element, "aria-current", String(isSelected));
    const status = store.statuses.get(this.#name) ?? null;
    const link = linkState(frame, status, connection.isOpen);
    setText(this.#link, link === "unknown" ? UNKNOWN : link);
    setAttribute(this.element, "data-link", link);
    setText(this.#age, frame.aircraftState === "none" ? "" : ageText(frame.age_s(null)));
    setAttribute(this.#age, "data-freshness", frame.freshness(null));
    const control = connection.isOpen ? status?.control : null;
    setText(this.#control, ownerText(control));
    setAttribute(this.element, "data-holder", String(control?.holder ?? "unknown"));
    this.#showAlarms(isSelected ? store.alarms : store.fleet.alarms(this.#name));
  }

  #showAlarms(alarms) {
    const level = worstLevel(alarms);
    const worst = alarms.find((each) => each.level === level);
    const more = alarms.length > 1 ? ` (${alarms.length} alarms)` : "";
    setText(this.#alarm, worst === undefined ? "" : `${worst.text}${more}`);
    setAttribute(this.#alarm, "data-code", String(worst?.code ?? ""));
    setAttribute(this.element, "data-level", level);
  }
}

function ownerText(control) {
  const asked = control?.asked_by ? ", requested" : "";
  const owner = { you: "you", nobody: "free", page: control?.holder_name, ground: control?.holder_name }[control?.holder];
  return owner ? `${owner}${asked}` : UNKNOWN;
}

/** All aircraft of the server, a row each; a click or Enter selects one. Control stays as it is. */
export function mount(place, store, connection) {
  const list = html("ul.fleet-list", { id: "fleet-list" });
  const summary = html("p.quiet", { id: "fleet-summary" });
  const pace = new Pace();
  let rows = [];
  let shown = "";
  place.append(summary, list);
  list.addEventListener("click", ({ target }) => {
    const row = target.closest("[data-aircraft]");
    if (row !== null) {
      store.watch(row.dataset.aircraft);
    }
  });

  function summaryText() {
    const mine = store.names.filter((each) => store.statuses.get(each)?.control?.holder === "you");
    const control = connection.isOpen && mine.length > 0 ? `You control ${mine.join(", ")}.` : "You control none of them.";
    return `${store.names.length} aircraft. ${control}`;
  }

  return {
    update() {
      place.hidden = store.names.length < 2;
      // The selection changes immediately, the values five times a second.
      const now = JSON.stringify([store.names, store.aircraft]);
      if (place.hidden || (!pace.isTime(store.now_s) && now === shown)) {
        return;
      }
      shown = now;
      const names = rows.map(({ name }) => name);
      if (JSON.stringify(names) !== JSON.stringify(store.names)) {
        rows = store.names.map((name) => ({ name, row: new FleetRow(name) }));
        list.replaceChildren(...rows.map(({ row }) => row.element));
      }
      setText(summary, summaryText());
      rows.forEach(({ row }) => row.update(store, connection));
    },
  };
}

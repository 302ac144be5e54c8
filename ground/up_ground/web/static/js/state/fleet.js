import { NewestFrame, STATE_WORDS } from "./newest_frame.js";
import * as validate from "./validate.js";

/** Time between two summaries of the server, seconds: one that is not late counts as of now. */
const PERIOD_S = 1;

/** What the server reports of an aircraft each second: some of its newest frame, and its alarms. */
class Summary extends NewestFrame {
  #arrival;
  alarms = [];

  constructor(clock_s) {
    const arrival = { at_s: -Infinity, holds_s: 0 };
    super(() => clock_s() - Math.min(arrival.holds_s, clock_s() - arrival.at_s));
    this.#arrival = arrival;
  }

  take(row, age_s, clock_s) {
    this.alarms = validate.objects(row.alarms);
    Object.assign(this.#arrival, { at_s: clock_s, holds_s: PERIOD_S });
    if (!this.updateFrame({ data: row.data ?? null, age_ms: row.age_ms }, age_s)) {
      this.clearFrame();
    }
  }

  /** Without a connection no other one is due. */
  end() {
    this.#arrival.holds_s = 0;
  }
}

/** All aircraft of the server; empty where it has one alone. */
export class Fleet {
  #clock_s;
  #summaries = new Map();

  /** Counts the changes. */
  version = 0;

  constructor(clock_s) {
    this.#clock_s = clock_s;
  }

  /** message: the server's `fleet`; way_s: how long it was on its way. */
  take(message, way_s) {
    const age_s = way_s + Math.max(0, validate.number(message.age_ms) ?? 0) / 1000;
    for (const row of validate.objects(message.aircraft)) {
      if (typeof row.name === "string") {
        const summary = this.#summaries.get(row.name) ?? new Summary(this.#clock_s);
        this.#summaries.set(row.name, summary);
        summary.take(row, age_s, this.#clock_s());
      }
    }
    this.version += 1;
  }

  /** Forget the aircraft with other names. */
  keep(names) {
    for (const name of [...this.#summaries.keys()].filter((each) => !names.includes(each))) {
      this.#summaries.delete(name);
    }
    this.version += 1;
  }

  end() {
    this.#summaries.forEach((each) => each.end());
    this.version += 1;
  }

  /** The newest frame of an aircraft as far as it is summarised; null: unknown. */
  get(name) {
    return this.#summaries.get(name) ?? null;
  }

  alarms(name) {
    return this.get(name)?.alarms ?? [];
  }

  /** The alarms of all aircraft but one: [{aircraft, kind, code, level, text}]. */
  othersAlarms(watched) {
    const others = [...this.#summaries].filter(([name]) => name !== watched);
    return others.flatMap(([aircraft, { alarms }]) => alarms.map((each) => ({ ...each, aircraft })));
  }
}

/** Of live, silent, waiting (no telemetry yet), offline; unknown without a connection to the server. status: of the aircraft. */
export function linkState(frame, status, isOpen) {
  if (!isOpen) {
    return "unknown";
  }
  const { state, aircraft_online } = status?.link ?? {};
  if (aircraft_online === false || (state !== undefined && state !== "connected")) {
    return "offline";
  }
  return STATE_WORDS[frame?.aircraftState ?? "none"];
}

import { now_s, TIMERS } from "../link/clock.js";
import { Catalogue } from "./catalogue.js";
import { EventList } from "./event_list.js";
import { Fleet } from "./fleet.js";
import { Motion } from "./motion.js";
import { NewestFrame } from "./newest_frame.js";
import { READINGS } from "./schema.js";
import { Track } from "./track.js";
import * as validate from "./validate.js";

const REPAINT_S = 0.2;
const POLL_S = 0.04;
const JUMP_S = 1.5;
const MAX_AIRCRAFT = 64;

/**
 * The page's data on the watched aircraft, and its age.
 *
 * Fields to read: `aircraft` (the name watched), `names` (all), `data` (the newest frame's tree,
 * not validated), `frames`, `beacon`, `shownBeacon`, `status` (of the aircraft watched), `statuses`
 * (by name), `fleet` (summaries of all), `catalogue` (the Commands that the server knows), `alarms` ([{kind, level, text}]),
 * `gains`, `profile`, `replay`, `track` (points, version, startAltitude_m),
 * `motion` (groundSpeed_m_s, climb_m_s), `events` (list, the newest last), `eventsVersion`.
 */
export class Store extends NewestFrame {
  #connection;
  #calls = new Set();
  #requestFrame;
  #timers;
  #isAsked = false;
  #events = new EventList();
  #replayAt_s = 0;

  aircraft = null;
  names = [];
  shownBeacon = null;
  statuses = new Map();
  catalogue = new Catalogue();
  alarms = [];
  gains = null;
  profile = null;
  replay = null;
  track = new Track();
  motion = new Motion();

  constructor(connection, parts = {}) {
    super(parts.now_s ?? now_s);
    this.#connection = connection;
    this.#timers = parts.timers ?? TIMERS;
    this.fleet = new Fleet(parts.now_s ?? now_s);
    this.#requestFrame = parts.requestFrame ?? ((call) => requestAnimationFrame(call));
    connection.shownBeacon = () => this.shownBeacon;
    connection.on("open", ({ welcome }) => this.#opened(welcome));
    connection.on("closed", () => this.#closed());
    connection.on("message", (message) => this.take(message));
  }

  /** Repaint five times a second, and immediately when a reading becomes stale. */
  start() {
    this.#timers.each(() => this.#change(), REPAINT_S);
    let known = "";
    this.#timers.each(() => {
      const now = [null, ...Object.keys(READINGS)].map((reading) => this.freshness(reading)).join();
      if (now !== known) {
        known = now;
        this.#change();
      }
    }, POLL_S);
  }

  watch(name) {
    if (name !== this.aircraft) {
      this.aircraft = name;
      this.#connection.aircraft = name;
      this.#clear();
    }
    this.#events.clear();
    this.track.replace([]);
    this.#connection.send({ type: "watch", aircraft: name });
    this.#change();
  }

  /** Call once per animation frame at most when something changed; returns the end of it. */
  subscribe(call) {
    this.#calls.add(call);
    this.#change();
    return () => this.#calls.delete(call);
  }

  get status() {
    return this.statuses.get(this.aircraft) ?? null;
  }

  /** Seconds: now in the replayed flight, otherwise on the page's clock. */
  get flight_s() {
    const time_s = validate.number(this.replay?.time_s);
    if (time_s === null) {
      return this.now_s;
    }
    const since_s = this.replay.is_playing === false ? 0 : this.now_s - this.#replayAt_s;
    const speed = validate.number(this.replay.speed) ?? 1;
    return Math.min(time_s + since_s * speed, validate.number(this.replay.length_s) ?? Infinity);
  }

  /** When the newest frame was so, by `flight_s`. */
  get frameAt_s() {
    const age_s = this.age_s(null);
    if (age_s === null) {
      return null;
    }
    return (this.replay === null ? null : this.frameTime_s) ?? this.flight_s - age_s;
  }

  /** Events, the newest last: {number, at_s, level, kind, text, is_past}. */
  get events() {
    return this.#events.all;
  }

  get eventsVersion() {
    return this.#events.version;
  }

  take(message) {
    if (message.type === "status") {
      this.statuses.set(message.aircraft, message);
    } else if (message.type === "fleet") {
      this.fleet.take(message, this.#connection.way_s);
    } else if (message.type === "replay") {
      this.#takeReplay(message);
    } else if (message.type === "catalogue") {
      this.catalogue = new Catalogue(message.commands);
    } else if (message.aircraft !== this.aircraft || this.aircraft === null) {
      return;
    } else if (!this.#takeOfAircraft(message)) {
      return;
    }
    this.#change();
  }

  #takeOfAircraft(message) {
    const known = {
      frame: () => this.updateFrame(message, this.#connection.way_s) && this.#follow(),
      event: () => this.#events.take(message, this.flight_s),
      alarms: () => (this.alarms = validate.objects(message.active)),
      gains: () => (this.gains = message),
      profile: () => (this.profile = message.profile ?? null),
      track: () => this.#takeTrack(message),
    };
    if (!Object.hasOwn(known, message.type)) {
      return false;
    }
    known[message.type]();
    return true;
  }

  /** First message after `watch` and after a jump in a replay: earlier data is of another time. */
  #takeTrack(message) {
    this.track.replace(message.points, this.now_s);
    this.#events.clear();
    this.motion = new Motion();
  }

  #takeReplay(message) {
    const before = this.replay;
    this.replay = message;
    this.#replayAt_s = this.now_s;
    if (message.is_playing === false) {
      this.hold();
    } else {
      this.release();
    }
    const speed = validate.number(message.speed) ?? 1;
    const step_s = (validate.number(message.time_s) ?? 0) - (validate.number(before?.time_s) ?? 0);
    const hasJumped = step_s < -0.01 || step_s > JUMP_S * Math.max(1, speed);
    if (before === null || hasJumped) {
      this.motion = new Motion();
    }
  }

  #follow() {
    const latitude = this.number("location.latitude");
    const longitude = this.number("location.longitude");
    if (this.freshness("location") === "live") {
      this.track.append(latitude, longitude, this.number("location.altitude"), this.now_s);
    }
    this.motion.place(latitude, longitude, this.#measuredAt_s("location"));
    this.motion.height(this.number("altitude"), this.#measuredAt_s("altitude"));
  }

  #measuredAt_s(reading) {
    const age_s = this.age_s(reading);
    return age_s === null ? null : this.frameAt_s - (age_s - this.age_s(null));
  }

  #closed() {
    this.release();
    this.fleet.end();
    this.#change();
  }

  #opened(welcome) {
    this.names = validate.texts(welcome.aircraft, MAX_AIRCRAFT) ?? [];
    this.fleet.keep(this.names);
    this.replay = null;
    const kept = this.names.includes(this.aircraft) ? this.aircraft : this.names[0];
    if (kept !== undefined) {
      this.watch(kept);
    }
    this.#change();
  }

  #clear() {
    this.clearFrame();
    this.shownBeacon = null;
    // Until the server sends them again.
    this.alarms = this.fleet.alarms(this.aircraft);
    this.gains = this.profile = null;
    this.motion = new Motion();
  }

  #change() {
    if (this.#isAsked) {
      return;
    }
    this.#isAsked = true;
    this.#requestFrame(() => this.#paint());
  }

  #paint() {
    this.#isAsked = false;
    for (const call of this.#calls) {
      call();
    }
    this.shownBeacon = this.beacon;
  }
}

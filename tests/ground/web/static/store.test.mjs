import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { Connection } from "../../../../ground/up_ground/web/static/js/link/connection.js";
import { Storage } from "../../../../ground/up_ground/web/static/js/link/storage.js";
import { Store } from "../../../../ground/up_ground/web/static/js/state/store.js";
import { FakeClock } from "./support/fake_clock.mjs";
import { FakeServer } from "./support/fake_server.mjs";

let clock, server, store, frames, connection;

beforeEach(() => {
  clock = new FakeClock();
  server = new FakeServer();
  frames = [];
  const { now_s, timers } = clock;
  const memory = new Storage(null);
  connection = new Connection("ws://x/link", {
    memory,
    now_s,
    timers,
    makeSocket: server.makeSocket,
  });
  store = new Store(connection, { now_s, timers, requestFrame: (call) => frames.push(call) });
  connection.start();
  server.welcome();
});

function paint() {
  frames.splice(0).forEach((call) => call());
}

function frame(data, fields = {}) {
  server.socket.say({ type: "frame", aircraft: "one", beacon: 7, age_ms: 20, data, ...fields });
}

test("it watches the first aircraft", () => {
  assert.equal(store.aircraft, "one");
  assert.deepEqual(server.socket.of("watch"), [{ type: "watch", aircraft: "one" }]);
});

test("an age is that on board, on the link, half the page's round trip, and since", () => {
  const [ping] = server.socket.of("ping");
  clock.advance(0.06);
  server.socket.say({ type: "pong", ping: ping.ping });
  frame({ age_ms: { orientation: 100 } });
  clock.advance(0.5);
  assert.ok(Math.abs(store.age_s(null) - (0.02 + 0.03 + 0.5)) < 1e-9);
  assert.ok(Math.abs(store.age_s("orientation") - (0.1 + 0.02 + 0.03 + 0.5)) < 1e-9);
  assert.equal(store.age_s("rx"), null);
});

test("a delayed frame is shown with its true age", () => {
  const sent = (before_s) => ({ sent_ms: (clock.seconds + 5000 - before_s) * 1000 });
  const [ping] = server.socket.of("ping");
  clock.advance(0.06);
  server.socket.say({ type: "pong", ping: ping.ping, ...sent(0.03) });
  frame({ altitude: 5 }, sent(0.03));
  assert.ok(Math.abs(store.age_s(null) - (0.02 + 0.03)) < 1e-6);
  clock.advance(3);
  frame({ altitude: 6 }, sent(3));
  assert.ok(Math.abs(store.age_s(null) - (0.02 + 3)) < 0.001);
  assert.equal(store.aircraftState, "silent");
  assert.equal(store.freshnessAt("altitude"), "stale");
  frame({ altitude: 7 }, sent(0.04));
  assert.equal(store.freshnessAt("altitude"), "live");
});

test("another connection has another clock", () => {
  frame({ altitude: 5 }, { sent_ms: 9_000_000 });
  server.socket.fail();
  clock.advance(0.25);
  server.welcome({ sent_ms: 100 });
  frame({ altitude: 5 }, { sent_ms: 100 });
  assert.ok(store.age_s(null) < 0.03);
});

test("every value of a frame is validated", () => {
  const odd = { roll: "1", pitch: null, yaw: [1] };
  frame({ orientation: odd, altitude: 1e300, armed: "yes", vetoes: "no", flight_mode: 3 });
  assert.equal(store.number("orientation.roll"), null);
  assert.equal(store.value("orientation.pitch"), null);
  assert.equal(store.number("orientation.yaw"), null);
  assert.equal(store.value("altitude"), null);
  assert.equal(store.freshnessAt("altitude"), "none");
  assert.equal(store.flag("armed"), null);
  assert.equal(store.texts("vetoes"), null);
  assert.equal(store.text("flight_mode"), null);
  assert.equal(store.number("constructor.length"), null);
});

test("an invalid frame changes nothing", () => {
  frame({ altitude: 5 });
  frame(null);
  frame("x");
  assert.equal(store.number("altitude"), 5);
  assert.equal(store.frames, 1);
});

test("it is silent after 0.9 s, and everything stale with it", () => {
  frame({ altitude: 5, age_ms: { altitude: 0 } });
  assert.equal(store.aircraftState, "live");
  assert.equal(store.freshnessAt("altitude"), "live");
  clock.advance(0.89);
  assert.equal(store.isSilent, true);
  assert.equal(store.aircraftState, "silent");
  assert.equal(store.freshnessAt("altitude"), "stale");
});

test("a lost connection turns everything stale as time goes by", () => {
  frame({ altitude: 5 });
  server.socket.fail();
  assert.equal(store.aircraftState, "live");
  clock.advance(0.95);
  assert.equal(store.aircraftState, "silent");
});

test("becoming silent is painted within 50 ms, without any frame", () => {
  store.start();
  const states = [];
  store.subscribe(() => states.push(store.aircraftState));
  frame({ altitude: 5 }, { age_ms: 0 });
  paint();
  clock.advance(0.88);
  paint();
  assert.deepEqual(new Set(states), new Set(["live"]));
  clock.advance(0.06);
  paint();
  assert.equal(states.at(-1), "silent");
});

test("ages are painted five times a second", () => {
  store.start();
  let paints = 0;
  store.subscribe(() => (paints += 1));
  paint();
  for (let step = 0; step < 100; step += 1) {
    clock.advance(0.01);
    paint();
  }
  assert.ok(paints >= 5 && paints <= 8, String(paints));
});

test("many messages are one painting", () => {
  let paints = 0;
  store.subscribe(() => (paints += 1));
  paint();
  for (let count = 0; count < 50; count += 1) {
    frame({ altitude: count });
  }
  paint();
  assert.equal(paints, 2);
  assert.equal(store.frames, 50);
});

test("a Command echoes the newest frame that was painted, not the newest that came", () => {
  frame({}, { beacon: 1 });
  assert.equal(store.shownBeacon, null);
  paint();
  assert.equal(store.shownBeacon, 1);
  frame({}, { beacon: 2 });
  connection.command("up.disarm", {});
  assert.equal(server.socket.of("command")[0].beacon, 1);
});

test("frames of another aircraft are not shown", () => {
  frame({ altitude: 5 }, { aircraft: "two" });
  assert.equal(store.aircraftState, "none");
});

test("another aircraft begins with nothing", () => {
  frame({ altitude: 5 });
  server.socket.say({ type: "alarms", aircraft: "one", active: [{ kind: "x", level: "alarm" }] });
  store.watch("two");
  assert.equal(store.aircraftState, "none");
  assert.equal(store.value("altitude"), null);
  assert.deepEqual(store.alarms, []);
  assert.equal(store.shownBeacon, null);
});

test("a page that comes back watches the same aircraft", () => {
  store.watch("two");
  server.socket.fail();
  clock.advance(0.25);
  server.welcome();
  assert.deepEqual(server.socket.of("watch"), [{ type: "watch", aircraft: "two" }]);
});

test("events come once each, in order, with the time they happened", () => {
  const event = (number, fields) =>
    server.socket.say({
      type: "event",
      aircraft: "one",
      number,
      age_ms: 2000,
      text: "t",
      level: "info",
      ...fields,
    });
  event(2);
  event(1, { is_past: true });
  event(2);
  event(3, { level: "strange" });
  event(4, { text: 7 });
  event("5");
  assert.deepEqual(
    store.events.map((each) => each.number),
    [1, 2, 3],
  );
  assert.deepEqual(
    store.events.map((each) => each.level),
    ["info", "info", "info"],
  );
  assert.equal(store.events[0].at_s, clock.seconds - 2);
});

test("the track grows by live fixes only", () => {
  server.socket.say({ type: "track", aircraft: "one", points: [[50, 8, 100], "odd", [95, 8, 0]] });
  assert.deepEqual(store.track.points, [[50, 8, 100]]);
  assert.equal(store.track.startAltitude_m, 100);
  const location = { latitude: 50.001, longitude: 8, altitude: 120 };
  frame({ location, age_ms: { location: 5000 } });
  assert.equal(store.track.points.length, 1);
  frame({ location, age_ms: { location: 100 } });
  frame({ location, age_ms: { location: 200 } });
  assert.deepEqual(store.track.points.at(-1), [50.001, 8, 120]);
  assert.equal(store.track.points.length, 2);
});

test("invalid alarms are dropped", () => {
  const active = [null, 7, { kind: "imu", level: "alarm", text: "t" }];
  server.socket.say({ type: "alarms", aircraft: "one", active });
  assert.deepEqual(store.alarms, [active[2]]);
  server.socket.say({ type: "alarms", aircraft: "one", active: "x" });
  assert.deepEqual(store.alarms, []);
});

test("a replay's speeds and times are those of the flight at any speed", () => {
  for (const speed of [0.25, 1, 4, 30]) {
    server.socket.say({ type: "track", aircraft: "one", points: [] });
    const replay = (time_s) =>
      server.socket.say({ type: "replay", name: "n", time_s, length_s: 600, speed, is_playing: true });
    const step_s = Math.max(0.1, 0.04 * speed);
    replay(100);
    for (let time_s = 100; time_s < 100 + Math.max(5, step_s * 8); time_s += step_s) {
      const location = { latitude: 50 + (time_s * 10) / 111195, longitude: 8 };
      frame({ location, altitude: time_s * 2, age_ms: { location: 0, altitude: 0 } }, { age_ms: 0, time_s });
      assert.equal(store.frameAt_s, time_s);
      // The transit time to the page is not time of the flight.
      clock.advance(step_s / speed + Math.random() * 0.02);
    }
    assert.ok(Math.abs(store.motion.groundSpeed_m_s - 10) < 0.1, `${speed} ${store.motion.groundSpeed_m_s}`);
    assert.ok(Math.abs(store.motion.climb_m_s - 2) < 0.05, `${speed} ${store.motion.climb_m_s}`);
  }
});

test("after a jump in a replay events are as old as they are in the flight", () => {
  const replay = (time_s, is_playing) =>
    server.socket.say({ type: "replay", name: "n", time_s, length_s: 600, speed: 10, is_playing });
  const event = { type: "event", aircraft: "one", level: "info", text: "t" };
  replay(500, true);
  clock.advance(1);
  assert.equal(store.flight_s, 510);
  server.socket.say({ ...event, number: 3, age_ms: 4000, time_s: 505 });
  replay(520, false);
  clock.advance(60);
  assert.equal(store.flight_s, 520);
  assert.equal(store.flight_s - store.events.at(-1).at_s, 15);
  replay(599, true);
  clock.advance(5);
  assert.equal(store.flight_s, 600);
});

test("a jump in a replay gives no speed", () => {
  const at = (time_s) => {
    server.socket.say({ type: "replay", name: "n", time_s, length_s: 600, speed: 1, is_playing: true });
    const location = { latitude: 50 + (time_s * 10) / 111195, longitude: 8 };
    frame({ location, age_ms: { location: 0 } }, { age_ms: 0, time_s });
  };
  [0, 1, 2, 3].forEach(at);
  assert.ok(Math.abs(store.motion.groundSpeed_m_s - 10) < 0.1);
  at(300);
  assert.equal(store.motion.groundSpeed_m_s, null);
});

test("a new track clears the events: in a replay they are of another time", () => {
  const event = { type: "event", aircraft: "one", number: 7, age_ms: 0, level: "info", text: "t" };
  server.socket.say(event);
  server.socket.say({ type: "track", aircraft: "one", points: [] });
  assert.deepEqual(store.events, []);
  server.socket.say({ ...event, number: 3, is_past: true });
  assert.deepEqual(
    store.events.map((each) => each.number),
    [3],
  );
});

test("nothing grows old while a replay is paused, and all does when its server is gone", () => {
  const replay = (is_playing) =>
    server.socket.say({ type: "replay", name: "n", time_s: 5, length_s: 9, speed: 1, is_playing });
  const pause = () => {
    for (let second = 0; second < 60; second += 1) {
      replay(false);
      clock.advance(1);
    }
  };
  frame({ altitude: 5, age_ms: { altitude: 100 } });
  clock.advance(0.3);
  pause();
  assert.equal(store.aircraftState, "live");
  assert.ok(Math.abs(store.age_s("altitude") - 0.42) < 1e-9);
  replay(true);
  assert.ok(Math.abs(store.age_s("altitude") - 0.42) < 1e-9);
  clock.advance(0.7);
  assert.equal(store.aircraftState, "silent");
  frame({ altitude: 6 });
  pause();
  frame({ altitude: 7 });
  pause();
  assert.ok(Math.abs(store.age_s(null) - 0.02) < 1e-9);
  server.socket.fail();
  clock.advance(1);
  assert.equal(store.aircraftState, "silent");
});

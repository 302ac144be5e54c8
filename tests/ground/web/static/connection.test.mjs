import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { Connection } from "../../../../ground/up_ground/web/static/js/link/connection.js";
import { Storage } from "../../../../ground/up_ground/web/static/js/link/storage.js";
import { FakeClock } from "./support/fake_clock.mjs";
import { FakeServer } from "./support/fake_server.mjs";

let clock, server, memory, page;

beforeEach(() => {
  clock = new FakeClock();
  server = new FakeServer();
  memory = new Storage(null);
  page = connect();
});

function connect(parts = {}) {
  const { now_s, timers } = clock;
  const { makeSocket } = server;
  return new Connection("ws://here/link", { memory, now_s, timers, makeSocket, ...parts });
}

test("it says hello, and is open when it is welcomed", () => {
  page.start();
  assert.equal(page.isOpen, false);
  server.welcome();
  assert.deepEqual(server.socket.sent[0], { type: "hello", name: "", token: null });
  assert.equal(page.isOpen, true);
});

test("it reconnects with its token, and reports when", () => {
  const closed = [];
  page.on("closed", (event) => closed.push(event));
  page.start();
  server.welcome();
  server.socket.fail("server stopped");
  assert.deepEqual(closed, [{ reason: "server stopped", retry_s: 0.25 }]);
  assert.equal(page.isOpen, false);
  assert.equal(page.retry_s, 0.25);
  clock.advance(0.2);
  assert.ok(Math.abs(page.retry_s - 0.05) < 1e-9);
  clock.advance(0.05);
  assert.equal(server.sockets.length, 2);
  assert.equal(page.retry_s, null);
  server.socket.open();
  assert.equal(server.socket.sent[0].token, "t-1");
});

test("failing attempts come at 0.25, 0.5, 1, 2, 2 seconds", () => {
  page.start();
  for (const wait_s of [0.25, 0.5, 1, 2, 2]) {
    const before = server.sockets.length;
    server.socket.fail();
    clock.advance(wait_s - 0.01);
    assert.equal(server.sockets.length, before);
    clock.advance(0.01);
    assert.equal(server.sockets.length, before + 1);
  }
});

test("a success resets the attempts", () => {
  page.start();
  for (const wait_s of [0.25, 0.5, 1]) {
    server.socket.fail();
    clock.advance(wait_s);
  }
  server.welcome();
  server.socket.fail();
  assert.equal(page.retry_s, 0.25);
});

test("a server that is full is asked every five seconds, and told from one that is gone", () => {
  page.start();
  for (const _ of [1, 2, 3]) {
    const before = server.sockets.length;
    server.socket.open();
    server.socket.fail("16 pages", 4013);
    assert.equal(page.isFull, true);
    clock.advance(4.9);
    assert.equal(server.sockets.length, before);
    clock.advance(0.2);
    assert.equal(server.sockets.length, before + 1);
  }
  server.welcome();
  assert.equal(page.isFull, false);
  server.socket.fail("the server ends", 4001);
  assert.equal(page.isFull, false);
  assert.equal(page.retry_s, 0.25);
});

test("an exception in one listener does not stop the others", (t) => {
  t.mock.method(console, "error", () => {});
  const heard = [];
  page.on("alarms", () => heard.push("alarms"));
  page.on("alarms", () => {
    throw new Error("a listener that fails");
  });
  page.on("alarms", () => heard.push("alarms too"));
  page.on("message", ({ type }) => {
    heard.push(`message ${type}`);
    throw new Error("another one");
  });
  page.start();
  server.welcome();
  heard.length = 0;
  server.socket.say({ type: "alarms", aircraft: "one", active: [] });
  assert.deepEqual(heard, ["message alarms", "alarms", "alarms too"]);
  assert.equal(console.error.mock.callCount(), 3);
});

test("a server that says nothing for four seconds is left", () => {
  page.start();
  server.welcome();
  clock.advance(4);
  assert.equal(page.isOpen, true);
  clock.advance(1);
  assert.equal(page.isOpen, false);
  assert.equal(server.sockets[0].isClosed, true);
  clock.advance(0.25);
  assert.equal(server.sockets.length, 2);
});

test("an attempt that leads nowhere is given up after five seconds", () => {
  page.start();
  clock.advance(6.3);
  assert.equal(server.sockets.length, 2);
});

test("messages of an abandoned socket are ignored", () => {
  const heard = [];
  page.on("status", (message) => heard.push(message));
  page.start();
  server.welcome();
  const old = server.socket;
  old.fail();
  clock.advance(0.25);
  old.say({ type: "status" });
  old.fail();
  assert.deepEqual(heard, []);
  assert.equal(server.sockets.length, 2);
});

test("it measures its own round trip each second", () => {
  page.start();
  server.welcome();
  const [first] = server.socket.of("ping");
  clock.advance(0.04);
  server.socket.say({ type: "pong", ping: first.ping });
  assert.ok(Math.abs(page.roundTrip_s - 0.04) < 1e-9);
  clock.advance(1);
  assert.equal(server.socket.of("ping").length, 2);
  server.socket.say({ type: "pong", ping: 999 });
  assert.ok(Math.abs(page.roundTrip_s - 0.04) < 1e-9);
});

test("a Command carries the beacon of the frame that was shown, and gets its answer", async () => {
  page.shownBeacon = () => 4711;
  page.aircraft = "one";
  page.start();
  server.welcome();
  const answer = page.command("up.arm", {});
  const [sent] = server.socket.of("command");
  const expected = {
    type: "command",
    ask: sent.ask,
    aircraft: "one",
    name: "up.arm",
    data: {},
    beacon: 4711,
  };
  assert.deepEqual(sent, expected);
  server.socket.say({ type: "answer", ask: sent.ask + 1, outcome: "nack" });
  server.socket.say({ type: "answer", ask: sent.ask, outcome: "ack", round_trip_ms: 31 });
  const { outcome, round_trip_ms, reason } = await answer;
  assert.deepEqual([outcome, round_trip_ms, reason], ["ack", 31, ""]);
});

test("a Command without a connection is unsent, and never sent later", async () => {
  page.start();
  assert.equal((await page.command("up.arm", {})).outcome, "unsent");
  server.welcome();
  assert.deepEqual(server.socket.of("command"), []);
});

test("the outcome of a Command is unknown once the connection is lost", async () => {
  page.start();
  server.welcome();
  const answer = page.command("up.disarm", {});
  server.socket.fail();
  const { outcome, code } = await answer;
  assert.deepEqual([outcome, code], ["timeout", "connection_lost"]);
});

test("a server that never answers a Command is a timeout", async () => {
  page.start();
  server.welcome();
  const answer = page.command("up.disarm", {});
  for (let second = 0; second < 15; second += 1) {
    clock.advance(1);
    server.socket.say({ type: "status" });
  }
  assert.equal((await answer).outcome, "timeout");
});

test("the delay of a message is known from the hello on, by the server's clock", () => {
  page.start();
  server.socket.open();
  clock.advance(0.04);
  server.socket.say({ type: "welcome", aircraft: [], sent_ms: 7000 });
  assert.ok(Math.abs(page.way_s - 0.02) < 1e-6);
  clock.advance(2);
  server.socket.say({ type: "frame", sent_ms: 7100 });
  assert.ok(Math.abs(page.way_s - 1.92) < 0.001);
  server.socket.say({ type: "status" });
  assert.equal(page.way_s, 0);
});

test("a ping is answered however many are on their way", () => {
  page.start();
  server.welcome();
  for (let second = 0; second < 20; second += 1) {
    clock.advance(1);
    server.socket.say({ type: "status" });
  }
  const pings = server.socket.of("ping");
  assert.equal(pings.length, 21);
  server.socket.say({ type: "pong", ping: pings[1].ping });
  assert.ok(Math.abs(page.roundTrip_s - 19) < 1e-9);
  server.socket.say({ type: "pong", ping: pings[20].ping });
  assert.ok(page.roundTrip_s < 1e-9);
});

test("invalid messages are dropped", () => {
  const heard = [];
  page.on("message", (message) => heard.push(message.type));
  page.start();
  server.welcome();
  for (const odd of ["{", "null", "7", "[]", '{"type": 7}', '"text"']) {
    server.socket.say(odd);
  }
  assert.deepEqual(heard, ["welcome"]);
});

test("a page that was stopped stays closed", () => {
  page.start();
  server.welcome();
  page.stop();
  clock.advance(60);
  assert.equal(server.sockets.length, 1);
  assert.equal(page.isOpen, false);
});

test("a browser that keeps nothing forgets politely", () => {
  const broken = {
    getItem() {
      throw new Error("forbidden");
    },
    setItem() {
      throw new Error("full");
    },
  };
  const forgetful = new Storage(broken);
  assert.equal(forgetful.get("token"), null);
  forgetful.set("token", "x");
  assert.equal(forgetful.get("token"), "x");
});

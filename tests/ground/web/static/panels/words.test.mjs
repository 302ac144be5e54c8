import assert from "node:assert/strict";
import { test } from "node:test";

import { controlWords, offeredActions } from "../../../../../ground/up_ground/web/static/js/panels/control_words.js";
import { numberBetween, textUpTo } from "../../../../../ground/up_ground/web/static/js/panels/field.js";
import { FrameSize } from "../../../../../ground/up_ground/web/static/js/panels/frame_size.js";
import { profileParts } from "../../../../../ground/up_ground/web/static/js/panels/profile_words.js";
import { objection } from "../../../../../ground/up_ground/web/static/js/panels/why.js";
import { agoWords, answerWords, clockWords, commandWords, costWords } from "../../../../../ground/up_ground/web/static/js/panels/words.js";

const WELCOME = { page: 1, may_control: true, why_not: "", is_replay: false };

test("an answer says what became of it", () => {
  const words = (answer) => answerWords({ code: null, reason: "", round_trip_ms: null, ...answer });
  assert.equal(words({ outcome: "ack", round_trip_ms: 83.6 }), "carried out after 84 ms");
  assert.equal(words({ outcome: "ack" }), "carried out");
  const half = "carried out, but what was asked for did not come";
  assert.equal(words({ outcome: "ack", round_trip_ms: 20, reason: half }), half);
  assert.equal(
    words({ outcome: "nack", code: "forbidden", reason: "the aircraft is armed." }),
    "refused by the aircraft: the aircraft is armed",
  );
  assert.equal(
    words({ outcome: "nack", code: "refused", reason: "the Arduino refused: the throttle is not low" }),
    "refused by the Arduino: the throttle is not low",
  );
  assert.equal(words({ outcome: "nack", code: "stale", reason: "" }), "refused by the aircraft: stale");
  assert.equal(words({ outcome: "nack" }), "refused by the aircraft: no reason given");
  assert.match(answerWords({ outcome: "nack", reason: "no" }), /^refused/);
  assert.equal(
    words({ outcome: "timeout", reason: "no answer in 5 s; it is not known whether it was carried out" }),
    "no answer in 5 s: nobody knows whether it was carried out",
  );
  assert.equal(words({ outcome: "timeout" }), "no answer: nobody knows whether it was carried out");
  assert.equal(words({ outcome: "unsent", reason: "not sent: a loss" }), "not sent: a loss");
  assert.equal(words({ outcome: "unsent", reason: "the link is down" }), "not sent: the link is down");
  assert.match(words({ outcome: "refused", reason: "you have no control" }), /^refused by the ground server: you/);
  assert.match(words({ outcome: "odd" }), /does not know: odd/);
});

test("a Command has a name that a person understands", () => {
  assert.equal(commandWords("up.flight_mode.set", { mode: "FBW" }), "Flight mode FBW");
  assert.equal(commandWords("arduino.pids.tunings", { request: true }), "Ask for the gains");
  assert.equal(commandWords("arduino.pids.tunings", { pids: {} }), "New gains");
  assert.equal(commandWords("some.cog.thing", {}), "some.cog.thing");
});

test("a period says what it costs", () => {
  assert.equal(
    costWords(100, 2000),
    "10 a second, about 72 MB an hour at 2000 bytes a frame",
  );
  assert.equal(costWords(10000, 900), "one every 10 s, about 324 KB an hour at 900 bytes a frame");
  assert.match(costWords(100, null), /not known yet/);
});

test("the size of a frame is measured from frames", () => {
  const size = new FrameSize();
  size.look({}, 0);
  assert.equal(size.bytes, null);
  size.look({ orientation: { roll: 1.25 } }, 1);
  assert.ok(size.bytes > 60 && size.bytes < 100);
  const [before] = [size.bytes];
  size.look({ text: "x".repeat(500) }, 2);
  assert.equal(size.bytes, before);
  size.look({ text: "x".repeat(500) }, 40);
  assert.ok(size.bytes > before);
});

test("ages and times read as people say them", () => {
  assert.equal(agoWords(0.4), "0 s ago");
  assert.equal(agoWords(61), "1 min ago");
  assert.equal(agoWords(3725), "1 h 2 min ago");
  assert.equal(clockWords(187.9), "3:07");
  assert.equal(clockWords(3727), "1:02:07");
  assert.equal(clockWords(NaN), "0:00");
});

test("numbers and texts out of bounds are told at once", () => {
  const period = numberBetween(20, 10000, "ms");
  assert.equal(period("20").problem, "");
  assert.equal(period("19").problem, "must be 20 to 10000 ms");
  assert.equal(period("").problem, "write a number");
  assert.equal(period("ten").problem, "write a number");
  const speech = textUpTo(200);
  assert.deepEqual(speech("  hello "), { value: "hello", problem: "" });
  assert.notEqual(speech("x".repeat(201)).problem, "");
  assert.equal(speech("ü".repeat(200)).problem, "");
  assert.equal(speech("\u{1f6e9}".repeat(200)).problem, "");
  assert.equal(speech("\u{1f6e9}".repeat(201)).problem, "must be at most 200 characters");
  assert.notEqual(speech("  ").problem, "");
});

test("who has control and what may be done about it", () => {
  const control = (holder, more = {}) => ({ holder, holder_name: "", asked_by: null, pages: [], ...more });
  assert.match(controlWords(control("you"), WELCOME).holder, /^You have control\. All others watch/);
  assert.match(controlWords(control("page", { holder_name: "Anna" }), WELCOME).holder, /^Anna has control. You watch/);
  assert.deepEqual([...offeredActions(control("nobody"), WELCOME)], ["request"]);
  assert.deepEqual([...offeredActions(control("you"), WELCOME)], ["release"]);
  const asked = control("you", { asked_by: { page: 2, name: "Ben" } });
  assert.equal(controlWords(asked, WELCOME).asked, "Ben asks you for control.");
  assert.deepEqual([...offeredActions(asked, WELCOME)], ["give", "deny", "release"]);
  const only = { ...WELCOME, may_control: false, why_not: "the key is missing" };
  assert.equal(offeredActions(control("nobody"), only).size, 0);
  assert.match(controlWords(control("nobody"), only).holder, /may only watch: The key is missing\.$/);
  assert.equal(offeredActions(control("nobody"), null).size, 0);
});

test("why a Command is not offered is one sentence", () => {
  const store = (control, role = "pilot") => ({ aircraft: "one", status: { control, role } });
  const connection = { isOpen: true, welcome: WELCOME };
  const arm = (its) => objection(its, connection, "up.arm");
  assert.equal(arm(store({ holder: "you" })), "");
  assert.match(arm(store({ holder: "page", holder_name: "Anna" })), /^Anna has control/);
  assert.match(arm(store({ holder: "nobody" })), /ask for it/);
  assert.match(arm(store({ holder: "you" }, "operator")), /role operator/);
  assert.equal(objection(store({ holder: "you" }, "operator"), connection, "up.flight_mode.set"), "");
  assert.match(
    objection(store({ holder: "you" }, "operator"), connection, "arduino.pids.tunings", { pids: {} }),
    /role operator/,
  );
  assert.equal(arm(store({ holder: "you" }, null)), "");
  assert.match(objection(store({ holder: "you" }), { isOpen: false, welcome: null }, "up.arm"), /no connection/);
  const replay = { isOpen: true, welcome: { ...WELCOME, is_replay: true } };
  assert.match(objection(store({ holder: "you" }), replay, "up.arm"), /replay/);
  assert.equal(
    objection(store({ holder: "nobody" }), connection, "arduino.profile.request"),
    "",
  );
  assert.equal(
    objection(store({ holder: "nobody" }, "observer"), connection, "arduino.pids.tunings", { request: true }),
    "",
  );
});

test("an aircraft that is not at the proxy is offered nothing, not even a question", () => {
  const link = { aircraft_online: false };
  const store = { aircraft: "one", status: { control: { holder: "you" }, role: "pilot", link } };
  const connection = { isOpen: true, welcome: WELCOME };
  const away = "The aircraft one is not connected to the proxy.";
  assert.equal(objection(store, connection, "up.flight_mode.set"), away);
  assert.equal(objection(store, connection, "arduino.profile.request"), away);
  link.aircraft_online = null;
  assert.equal(objection(store, connection, "up.flight_mode.set"), "");
});

test("a profile reads as a page, and what is not told has no row", () => {
  const parts = profileParts({
    mix: "elevon",
    motor: false,
    ailerons: { reversed: true, trim_us: -12, lowest_us: 1000, highest_us: 2000 },
    switch: { low: "ACRO", middle: "FBW", high: "AUTO" },
    receiver_lost: { circle_bank_deg: -20, return_with_motor: false },
  });
  const rows = Object.fromEntries(parts.flatMap((part) => part.rows));
  assert.equal(rows["Ailerons (left elevon)"], "reversed, trim −12 us, 1000 to 2000 us");
  assert.equal(rows["Bank of the circle"], "20° to the left");
  assert.equal(rows.High, "AUTO");
  assert.match(rows.Motor, /glider/);
  assert.ok(!parts.some((part) => part.title === "Limits in FBW"));
  assert.deepEqual(profileParts({}), []);
  const odd = { mix: "constructor", motor: "toString", ailerons: 7, switch: "high", receiver_lost: [1] };
  assert.deepEqual(profileParts(odd), [{ title: "Airframe", rows: [["Mix", "constructor"]] }]);
});

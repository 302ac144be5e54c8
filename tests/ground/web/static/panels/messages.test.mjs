import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

import { controlTexts, offeredActions } from "../../../../../ground/up_ground/web/static/js/panels/control_requests.js";
import { numberBetween, textUpTo } from "../../../../../ground/up_ground/web/static/js/panels/field.js";
import { FrameSize } from "../../../../../ground/up_ground/web/static/js/panels/commands.js";
import { profileParts } from "../../../../../ground/up_ground/web/static/js/panels/profile.js";
import { disabledReason } from "../../../../../ground/up_ground/web/static/js/panels/disabled_reason.js";
import { agoText, answerCode, answerText, clockText, commandText, costText } from "../../../../../ground/up_ground/web/static/js/panels/messages.js";
import { Catalogue } from "../../../../../ground/up_ground/web/static/js/state/catalogue.js";

// The server's catalogue, as `make schema` writes it for the app.
const COMMANDS = new URL("../../../../../android/raspilot/assets/commands.json", import.meta.url);
const WELCOME = { page: 1, may_control: true, denial: null, is_replay: false };

test("an answer has the text and the code of its outcome", () => {
  const text = (answer) => answerText({ code: null, reason: "", round_trip_ms: null, ...answer });
  assert.equal(text({ outcome: "ack", round_trip_ms: 83.6 }), "carried out after 84 ms");
  assert.equal(text({ outcome: "nack", code: "forbidden", reason: "armed." }), "refused: armed");
  assert.equal(text({ outcome: "nack", code: "stale" }), "refused: stale");
  assert.equal(text({ outcome: "timeout" }), "outcome unknown");
  assert.equal(text({ outcome: "unsent", reason: "no link" }), "not sent: no link");
  assert.equal(answerCode({ outcome: "nack", code: "stale" }), "nack stale");
  assert.equal(answerCode({ outcome: "ack", code: null }), "ack");
});

test("a Command has a name that a person understands", () => {
  const catalogue = new Catalogue(JSON.parse(readFileSync(COMMANDS)).commands);
  const text = (name, data) => commandText(catalogue.get(name).title, data);
  assert.equal(text("up.flight_mode.set", { mode: "FBW" }), "Flight mode FBW");
  assert.equal(text("arduino.calibrate", { what: "gyroscope_bias" }), "Calibrate gyroscope bias");
  assert.equal(text("android.speak", { text: "$& {}" }), 'Speak "$& {}"');
  assert.equal(text("up.home.set", { latitude: 1, longitude: 2 }), "Set home");
  assert.equal(new Catalogue([{ name: "some.cog.thing" }]).get("some.cog.thing").title, "some.cog.thing");
});

test("a period says what it costs", () => {
  assert.match(costText(100, 2000), /^10 .* 72 MB .* 2000 /);
  assert.match(costText(10000, 900), / 10 s.* 324 KB .* 900 /);
  assert.notEqual(costText(100, null), costText(100, 2000));
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
  assert.equal(agoText(0.4), "0 s ago");
  assert.equal(agoText(61), "1 min ago");
  assert.equal(agoText(3725), "1 h 2 min ago");
  assert.equal(clockText(187.9), "3:07");
  assert.equal(clockText(3727), "1:02:07");
  assert.equal(clockText(NaN), "0:00");
});

test("numbers and texts out of bounds are rejected", () => {
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

test("the actions for control are those of its state", () => {
  const control = (holder, more = {}) => ({ holder, holder_name: "", asked_by: null, pages: [], ...more });
  const offered = (...words) => [...offeredActions(...words)];
  assert.deepEqual(offered(control("nobody"), WELCOME), ["request"]);
  assert.deepEqual(offered(control("you"), WELCOME), ["release"]);
  const asked = control("you", { asked_by: { page: 2, name: "Ben" } });
  assert.deepEqual(offered(asked, WELCOME), ["give", "deny", "release"]);
  const only = { ...WELCOME, may_control: false, denial: { code: "no_key", text: "the key is missing" } };
  assert.deepEqual(offered(control("nobody"), only), []);
  assert.match(controlTexts(control("nobody"), only).holder, /The key is missing\.$/);
  assert.deepEqual(offered(control("nobody"), null), []);
});

test("why a Command is not offered", () => {
  const catalogue = new Catalogue(JSON.parse(readFileSync(COMMANDS, "utf-8")).commands);
  const store = (control, role = "pilot", link = {}) => ({ aircraft: "one", catalogue, status: { control, role, link } });
  const connection = { isOpen: true, welcome: WELCOME };
  const code = (its, name = "up.arm", data = {}, to = connection) => disabledReason(its, to, name, data)?.code ?? null;
  const you = { holder: "you" };
  assert.equal(code(store(you)), null);
  assert.equal(code(store({ holder: "page", holder_name: "Anna" })), "control_page");
  assert.equal(code(store({ holder: "nobody" })), "control_free");
  assert.equal(code(store(you, "operator")), "role");
  assert.equal(code(store(you, "operator"), "up.flight_mode.set"), null);
  assert.equal(code(store(you, "operator"), "arduino.pids.tunings", { pids: {} }), "role");
  assert.equal(code(store(you, "observer"), "a.cog"), "role");
  assert.equal(code(store(you, "operator"), "a.cog"), null);
  assert.equal(code(store(you, null)), null);
  assert.equal(code(store(you), "up.arm", {}, { isOpen: false, welcome: null }), "no_server");
  assert.equal(code(store(you), "up.arm", {}, { isOpen: true, welcome: { ...WELCOME, is_replay: true } }), "replay");
  const denied = { ...WELCOME, may_control: false, denial: { code: "no_key", text: "" } };
  assert.equal(code(store(you), "up.arm", {}, { isOpen: true, welcome: denied }), "no_key");
  assert.equal(code(store({ holder: "nobody" }), "arduino.profile.request"), null);
  assert.equal(code(store({ holder: "nobody" }, "observer"), "arduino.pids.tunings", { request: true }), null);
  const away = store(you, "pilot", { aircraft_online: false });
  assert.equal(code(away, "up.flight_mode.set"), "aircraft_offline");
  assert.equal(code(away, "arduino.profile.request"), "aircraft_offline");
  assert.equal(code(store(you, "pilot", { aircraft_online: null })), null);
});

test("a profile reads as a page, and a missing value has no row", () => {
  const parts = profileParts({
    mix: "elevon",
    motor: false,
    ailerons: { reversed: true, trim_us: -12, lowest_us: 1000, highest_us: 2000 },
    switch: { low: "ACRO", middle: "FBW", high: "AUTO" },
    receiver_lost: { circle_bank_deg: -20, return_with_motor: false, pi_may_fly: true },
    throttle_slew_percent_s: 50,
  });
  const rows = Object.fromEntries(parts.flatMap((part) => part.rows));
  assert.equal(rows["Ailerons (left elevon)"], "reversed, trim −12 us, 1000 to 2000 us");
  assert.match(rows["Bank of the circle"], /^20°.* left$/);
  assert.equal(rows.High, "AUTO");
  assert.match(rows.Motor, /glider/);
  assert.match(rows["Throttle rises"], /50 %\/s/);
  assert.equal(rows["Raspberry Pi then"], "may fly");
  assert.equal(rows["Returning home"], "glides");
  const unlimited = profileParts({ throttle_slew_percent_s: 0 });
  assert.equal(unlimited[0].rows.length, 1);
  assert.doesNotMatch(unlimited[0].rows[0][1], /%/);
  assert.ok(!parts.some((part) => part.title === "Limits in FBW"));
  assert.deepEqual(profileParts({}), []);
  const odd = { mix: "constructor", motor: "toString", ailerons: 7, switch: "high", receiver_lost: [1] };
  assert.deepEqual(profileParts(odd), [{ title: "Airframe", rows: [["Mix", "constructor"]] }]);
});

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { Fleet, linkState } from "../../../../ground/up_ground/web/static/js/state/fleet.js";
import { SILENT_S } from "../../../../ground/up_ground/web/static/js/state/schema.js";
import { FakeClock } from "./support/fake_clock.mjs";

const DATA = { flight_mode: "FBW", age_ms: { flight: 20 } };
let clock, fleet;

beforeEach(() => {
  clock = new FakeClock();
  fleet = new Fleet(clock.now_s);
});

/** Take the summary of one aircraft, which was 10 ms on its way and waited for 20 ms. */
function take(row) {
  fleet.take({ age_ms: 20, aircraft: [{ name: "kite", alarms: [], ...row }] }, 0.01);
  return fleet.get("kite");
}

test("a summary counts as of now until the next one is late", () => {
  const kite = take({ age_ms: 100, data: DATA });
  assert.ok(Math.abs(kite.age_s(null) - 0.13) < 1e-9);
  clock.advance(1);
  assert.equal(kite.freshness("flight"), "live");
  clock.advance(SILENT_S - 0.16);
  assert.equal(kite.freshness("flight"), "live");
  clock.advance(0.02);
  assert.equal(kite.freshness("flight"), "stale");
  clock.advance(0.03);
  assert.equal(kite.aircraftState, "silent");
  assert.equal(take({ age_ms: 100, data: DATA }).aircraftState, "live");
});

test("a silent aircraft is silent in a summary that is new", () => {
  assert.equal(take({ age_ms: 1000, data: DATA }).aircraftState, "silent");
  assert.equal(take({}).aircraftState, "none");
});

test("without a connection no other summary is due", () => {
  const kite = take({ age_ms: 100, data: DATA });
  clock.advance(SILENT_S);
  assert.equal(kite.aircraftState, "live");
  fleet.end();
  assert.equal(kite.aircraftState, "silent");
});

test("aircraft that the server does not show any more are forgotten", () => {
  take({ data: DATA });
  fleet.keep(["gull"]);
  assert.equal(fleet.get("kite"), null);
});

test("the link is offline without the aircraft or the proxy, and unknown without the server", () => {
  const kite = take({ age_ms: 100, data: DATA });
  const status = (state, aircraft_online) => ({ link: { state, aircraft_online } });
  const states = [
    ["live", kite, status("connected", true)],
    ["live", kite, null],
    ["waiting", null, status("connected", null)],
    ["offline", kite, status("connected", false)],
    ["offline", kite, status("waiting", null)],
  ];
  for (const [wanted, frame, status] of states) {
    assert.equal(linkState(frame, status, true), wanted);
    assert.equal(linkState(frame, status, false), "unknown");
  }
});

import assert from "node:assert/strict";
import { test } from "node:test";
import { onCircle } from "../../../../ground/up_ground/web/static/js/dom.js";
import { flightBatteryLevel } from "../../../../ground/up_ground/web/static/js/instruments/battery.js";
import { ballTransform, isWhole, rollMarks, rungs } from "../../../../ground/up_ground/web/static/js/instruments/horizon.js";
import { beyond, share } from "../../../../ground/up_ground/web/static/js/instruments/servos.js";
import { stickPlace } from "../../../../ground/up_ground/web/static/js/instruments/sticks.js";
import { TapeScale } from "../../../../ground/up_ground/web/static/js/instruments/tape.js";
import { rootScale } from "../../../../ground/up_ground/web/static/js/instruments/tapes.js";

test("the ladder reaches from the nadir to the zenith and is the same on both sides", () => {
  const all = rungs().map((each) => each.pitch_deg);
  assert.equal(Math.min(...all), -90);
  assert.equal(Math.max(...all), 90);
  assert.equal(all.includes(0), false);
  assert.deepEqual(all.map((each) => -each).reverse(), all);
  const tens = rungs().filter((each) => each.label !== "");
  assert.equal(tens.length, 18);
  assert.ok(tens.every((each) => each.label === String(Math.abs(each.pitch_deg))));
});

test("right wing down turns the picture left, nose up moves it down", () => {
  assert.equal(ballTransform(30, 0), "rotate(-30.00) translate(0 0.00)");
  assert.match(ballTransform(0, 10), /translate\(0 50\.00\)/);
  assert.match(ballTransform(0, 400), /translate\(0 450\.00\)/);
});

test("a tape's mark stands at the pointer when the value is the mark's", () => {
  const scale = new TapeScale({ step: 5, units: 16, height: 280 });
  for (const value of [-3, 0, 0.1, 2.49, 2.5, 7.5, 365.93, -1000]) {
    const { first, shift } = scale.at(value);
    for (let place = 0; place < scale.count; place += 1) {
      const mark = first + place * scale.step;
      const y = scale.y(place) + shift;
      assert.ok(Math.abs(y - ((value - mark) / 5) * 16) < 1e-6, `${value} ${mark} ${y}`);
    }
    assert.ok(scale.y(0) + shift >= 140 && scale.y(scale.count - 1) + shift <= -140);
  }
});

test("a tape's labels change only when the value has moved by a step", () => {
  const scale = new TapeScale({ step: 1, units: 14, height: 280 });
  assert.equal(scale.at(10.4).first, scale.at(9.6).first);
  assert.notEqual(scale.at(10.4).first, scale.at(10.6).first);
});

test("a root scale keeps its sign and its end", () => {
  assert.equal(rootScale(0, 10, 96), 0);
  assert.equal(rootScale(10, 10, 96), 96);
  assert.equal(rootScale(-50, 10, 96), -96);
  assert.equal(rootScale(2.5, 10, 96), 48);
});

test("a pulled elevator is a stick drawn down, more throttle one drawn up", () => {
  assert.deepEqual(stickPlace(2000, 2000, "elevator"), { x: "44.0", y: "44.0" });
  assert.deepEqual(stickPlace(1000, 2000, "throttle"), { x: "-44.0", y: "-44.0" });
  assert.equal(stickPlace(null, 1500, "throttle"), null);
  assert.equal(share(9999), 1.1);
  assert.equal(beyond(999), "low");
  assert.equal(beyond(2001), "high");
  assert.equal(beyond(2000), "within");
});

test("a label of the ladder is drawn whole or not at all", () => {
  // The labels of 10 and 20 degrees stand 50 and 100 above the horizon.
  assert.equal(isWhole(47, -50, 0, 0), true);
  assert.equal(isWhole(47, -100, 0, 0), false); // behind the bank arc
  assert.equal(isWhole(47, -100, 0, 10), true); // the nose up moves it down
  assert.equal(isWhole(47, 100, 0, 0), true);
  assert.equal(isWhole(47, 100, 180, 0), false); // on the back the ground is above
  assert.equal(isWhole(47, 150, 0, 0), false); // below the picture
});

test("the flight battery looks as the aircraft judges it; without limits plainly", () => {
  const look = (low, critical) =>
    flightBatteryLevel({ flag: (path) => ({ "arduino.flight_battery_low": low, "arduino.flight_battery_critical": critical })[path] });
  assert.equal(look(null, null), "");
  assert.equal(look(false, false), "");
  assert.equal(look(true, false), "warning");
  assert.equal(look(true, true), "alarm");
  assert.equal(look(null, true), "alarm");
});

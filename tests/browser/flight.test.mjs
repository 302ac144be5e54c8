// What the page shows is what the aircraft does.
import assert from "node:assert/strict";
import { before, test } from "node:test";

import { GroundPage } from "./support/ground_page.mjs";
import { Pilot } from "./support/pilot.mjs";
import { record, series } from "./support/recorder.mjs";
import { browser, stopAfter } from "./support/setup.mjs";
import { startShowcase } from "./support/showcase.mjs";
import { between, distance_m, lateness, truthOf } from "./support/truth.mjs";
import { until } from "./support/wait.mjs";

/** What wanders and jitters in the phone's GPS, metres. */
const GPS_M = 9;
/** What its barometer errs, metres. */
const BAROMETER_M = 2;
/** What the firmware makes of its IMU in turbulence, degrees. */
const ESTIMATE_DEG = 4;
/** A location is stale after this time; live values have arrived since. */
const LOCATION_S = 1.9;
const SILENT_S = 0.9;
let showcase;
let ground;

before(async () => {
  showcase = stopAfter(await startShowcase());
  ground = await (await GroundPage.open(browser, showcase.address)).isLive();
});

test("the aircraft moves on the map where it truly flies", async (t) => {
  const recorded = await record(ground.page, {
    latitude: { selector: "#panel-map", attribute: "data-latitude" },
    longitude: { selector: "#panel-map", attribute: "data-longitude" },
    altitude: { selector: '[data-key="altitude"]' },
  });
  const track_px = await trackLength();
  const points = await until(async () => {
    const found = places(await recorded.read());
    const isFar = found.length > 4 && distance_m(found[0], found[found.length - 1]) > 60;
    return isFar ? found : null;
  }, "five places on the map, 60 m apart");
  const truth = await truthOf(showcase);
  const latest = [];
  for (const point of points.slice(1)) {
    const near = between(truth, point.unix_s - LOCATION_S - SILENT_S, point.unix_s + 0.1)
      .map((row) => ({
        late_s: point.unix_s - row.unix_s,
        off_m: distance_m(point, { latitude: row.latitude_deg, longitude: row.longitude_deg }),
      }))
      .sort((one, other) => one.off_m - other.off_m)[0];
    assert.ok(near.off_m < GPS_M, `shown ${near.off_m.toFixed(1)} m off: ${JSON.stringify(point)}`);
    latest.push(near.late_s);
  }
  const altitudes = series(await recorded.read(), "altitude");
  for (const { unix_s, value } of altitudes.slice(1)) {
    const off = between(truth, unix_s - LOCATION_S, unix_s + 0.1).map((row) => Math.abs(row.altitude_m - value));
    assert.ok(Math.min(...off) < BAROMETER_M, `altitude ${value}: ${Math.min(...off)} m off`);
  }
  assert.ok(altitudes.length > 3);
  assert.ok((await trackLength()) > track_px + 5);
  t.diagnostic(`${points.length} places, at most ${Math.max(...latest).toFixed(2)} s old`);
});

test("the horizon follows the sticks of a radio", async (t) => {
  const pilot = await new Pilot(showcase).ready();
  const recorded = await record(ground.page, {
    roll: { selector: "#horizon-ball", attribute: "data-roll" },
    pitch: { selector: "#horizon-ball", attribute: "data-pitch" },
    state: { selector: "html", attribute: "data-aircraft-state" },
  });
  pilot.move({ aux1: 2000, aux2: 2000, throttle: 1600, ailerons: 1850 });
  await pilot.until(({ roll_deg }) => roll_deg > 28, "a bank to the right");
  await ground.until(() => Number(document.querySelector("#horizon-ball").dataset.roll) > 25, "it shown");
  assert.ok((await drawnRoll()) > 20);
  pilot.move({ ailerons: 1150 });
  await pilot.until(({ roll_deg }) => roll_deg < -28, "a bank to the left");
  await ground.until(() => Number(document.querySelector("#horizon-ball").dataset.roll) < -25, "it shown");
  assert.ok((await drawnRoll()) < -20);
  pilot.move({ ailerons: 1500, elevator: 1700 });
  await pilot.until(({ roll_deg }) => Math.abs(roll_deg) < 8, "level wings");
  await ground.until(() => Math.abs(document.querySelector("#horizon-ball").dataset.roll) < 10, "it shown");
  const records = await recorded.read();
  await pilot.leave();
  const truth = await truthOf(showcase);
  for (const [name, column] of [["roll", "roll_deg"], ["pitch", "pitch_deg"]]) {
    const shown = series(records, name);
    for (const { unix_s, value } of shown.slice(1)) {
      const off = between(truth, unix_s - SILENT_S, unix_s + 0.1).map((row) => Math.abs(row[column] - value));
      assert.ok(Math.min(...off) < ESTIMATE_DEG, `${name} ${value}: ${Math.min(...off)} deg off`);
    }
    const { late_s, off } = lateness(shown, truth, column);
    assert.ok(off < ESTIMATE_DEG, `${name} is ${off} deg off`);
    t.diagnostic(`${name}: ${shown.length} values, ${off.toFixed(2)} deg off, ${late_s.toFixed(2)} s late`);
  }
});

test("the overlay shows the flight with nothing behind it", async () => {
  const overlay = await GroundPage.open(browser, `${showcase.address}overlay`);
  // A value that was painted before the newest frame came agrees with the next one.
  await overlay.until(() => {
    const frame = window.testMessages.findLast(({ message }) => message.type === "frame")?.message.data;
    const at = (selector) => document.querySelector(selector);
    if (!at('[data-freshness="live"] > #home-arrow') || !frame?.home?.bearing) {
      return false;
    }
    const text = (key) => at(`[data-key="${key}"]`).textContent;
    const turn_deg = Number(at("#home-arrow").getAttribute("transform").slice("rotate(".length, -1));
    const off_deg = (turn_deg - frame.home.bearing + (frame.navigation.heading ?? frame.heading.actual)) % 360;
    const isAtAuto = ["SETPOINT", "OUTPUT"].includes(frame.flight_mode);
    return (
      Math.abs(off_deg) < 0.1 &&
      Math.abs(at("#horizon-ball").dataset.roll - frame.orientation.roll) < 0.1 &&
      Math.abs(text("motion.ground_speed") - frame.navigation.speed) < 0.1 &&
      text("arduino.flight_battery_v") === `${frame.arduino.flight_battery_v.toFixed(1)} V` &&
      text("flight_mode") === (isAtAuto ? frame.flight_control.mode : frame.flight_mode) &&
      text("link.state") === ""
    );
  }, "the newest frame on the overlay");
  const grounds = await overlay.page.evaluate(() =>
    ["html", "body", "#pfd"].map((each) => getComputedStyle(document.querySelector(each)).backgroundColor),
  );
  const sky = await overlay.page.evaluate(() => getComputedStyle(document.querySelector("#pfd .sky")).fill);
  assert.deepEqual([...grounds, sky], Array(4).fill("rgba(0, 0, 0, 0)"));
  overlay.assertClean();
});

test("the page has done nothing that it may not", () => ground.assertClean());

/** Places of a map's record: latitude and longitude change together. */
function places(records) {
  const found = [];
  for (const { name, unix_ms, value } of records) {
    const last = found[found.length - 1];
    const here = last?.unix_s === unix_ms / 1000 ? last : { ...last, unix_s: unix_ms / 1000 };
    here[name] = Number(value);
    if (here !== last) {
      found.push(here);
    }
  }
  return found.filter(({ latitude, longitude }) => latitude && longitude);
}

/** How long the line of the track is on the screen, px. */
async function trackLength() {
  return ground.page.evaluate(() =>
    [...document.querySelectorAll("#panel-map path.track")].reduce((sum, path) => sum + path.getTotalLength(), 0),
  );
}

/** By how much the horizon is turned on the screen: positive where the right wing is low. */
async function drawnRoll() {
  return ground.page.evaluate(() => {
    const { a, b } = document.querySelector("#horizon-ball").getCTM();
    return (-Math.atan2(b, a) * 180) / Math.PI;
  });
}

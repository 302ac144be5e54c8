import assert from "node:assert/strict";
import { test } from "node:test";

import {
  bearing_deg, distance_m, distanceText, offsetOf, placeAt, placeOf,
} from "../../../../../ground/up_ground/web/static/js/state/earth.js";
import { linesBetween, stepOf, stepText, windowOf } from "../../../../../ground/up_ground/web/static/js/state/earth.js";
import { placeText } from "../../../../../ground/up_ground/web/static/js/map/map_actions.js";
import { circlesOf, limitOf } from "../../../../../ground/up_ground/web/static/js/map/overlay.js";
import { homeText, pictureOf } from "../../../../../ground/up_ground/web/static/js/map/picture.js";
import { NewestFrame } from "../../../../../ground/up_ground/web/static/js/state/newest_frame.js";

const HOME = { latitude: 50.1, longitude: 8.6 };
const near = (value, wanted, by) => assert.ok(Math.abs(value - wanted) <= by, `${value} is not ${wanted}`);

test("a degree of latitude is 111.2 km, one of longitude shrinks with the cosine", () => {
  near(distance_m(HOME, { latitude: 51.1, longitude: 8.6 }), 111195, 5);
  near(distance_m(HOME, { latitude: 50.1, longitude: 8.61 }), 1111.95 * Math.cos((50.1 * Math.PI) / 180), 0.5);
  assert.equal(distance_m(HOME, HOME), 0);
});

test("bearings go clockwise from north", () => {
  near(bearing_deg(HOME, { latitude: 51, longitude: 8.6 }), 0, 1e-9);
  near(bearing_deg(HOME, { latitude: 50.1, longitude: 8.61 }), 90, 0.01);
  near(bearing_deg(HOME, { latitude: 49, longitude: 8.6 }), 180, 1e-9);
  near(bearing_deg(HOME, { latitude: 50.1, longitude: 8.59 }), 270, 0.01);
});

test("metres around a place go there and back, across the date line too", () => {
  const place = placeAt(HOME, { east_m: 1234, north_m: -567 });
  const offset = offsetOf(HOME, place);
  near(offset.east_m, 1234, 0.01);
  near(offset.north_m, -567, 0.01);
  near(distance_m(HOME, place), Math.hypot(1234, 567), 1);
  const west = { latitude: 0, longitude: -179.999 };
  near(offsetOf({ latitude: 0, longitude: 179.999 }, west).east_m, 222.4, 0.1);
});

test("an invalid place is rejected", () => {
  assert.deepEqual(placeOf(50.1, 8.6), HOME);
  for (const [latitude, longitude] of [[91, 0], [0, 181], [null, 8], ["50", 8], [NaN, 8]]) {
    assert.equal(placeOf(latitude, longitude), null);
  }
});

test("distances read as people say them", () => {
  assert.equal(distanceText(7.46), "7.5 m");
  assert.equal(distanceText(340.2), "340 m");
  assert.equal(distanceText(999.6), "1.00 km");
  assert.equal(distanceText(14234), "14.2 km");
});

test("the squares of the grid are 1, 2 or 5 times a power of ten and never too small", () => {
  for (let metresPerPixel = 0.01; metresPerPixel < 1000; metresPerPixel *= 1.1) {
    const step = stepOf(metresPerPixel, 70);
    assert.match(step.toExponential(0), /^[125]e/);
    assert.ok(step / metresPerPixel >= 70 * (1 - 1e-9) && step / metresPerPixel < 70 * 2.51);
  }
  assert.equal(stepOf(1, 50), 50);
  assert.equal(stepText(0.5), "500 mm");
  assert.equal(stepText(200), "200 m");
  assert.equal(stepText(5000), "5 km");
});

test("the lines of a stretch are all those in it", () => {
  assert.deepEqual(linesBetween(-25, 31, 10), [-20, -10, 0, 10, 20, 30]);
  assert.deepEqual(linesBetween(31, -25, 10), [-20, -10, 0, 10, 20, 30]);
  assert.deepEqual(linesBetween(1, 9, 10), []);
});

test("the plain map shows every point with a margin, and not less than a field", () => {
  const size = { width_px: 400, height_px: 300 };
  const points = [{ east_m: -500, north_m: 0 }, { east_m: 300, north_m: 900 }];
  const view = windowOf(points, size);
  for (const { east_m, north_m } of points) {
    assert.ok(Math.abs(east_m - view.east_m) < (size.width_px / 2) * view.metresPerPixel);
    assert.ok(Math.abs(north_m - view.north_m) < (size.height_px / 2) * view.metresPerPixel);
  }
  assert.equal(windowOf([], size).metresPerPixel * 300, 200);
});

test("the way home has the age of a stale position", () => {
  const picture = { aircraft: placeAt(HOME, { east_m: 0, north_m: 340 }), home: HOME, freshness: "live", age: "12.3 s" };
  assert.match(homeText(picture), /^340 m .* 000°.* 180°$/);
  assert.match(homeText({ ...picture, freshness: "stale" }), /12.3 s/);
  assert.doesNotMatch(homeText({ ...picture, home: null }), /\d/);
  assert.doesNotMatch(homeText({ ...picture, aircraft: null }), /\d/);
});

function storeOf(data) {
  const store = new NewestFrame(() => 0);
  store.track = { points: [] };
  store.status = { home: { latitude: 1, longitude: 2 } };
  store.updateFrame({ data, beacon: 1, age_ms: 0 }, 0);
  return store;
}

const NAVIGATION = {
  latitude: 50.2, longitude: 8.7, heading: 33, sd: { position: 2.5 },
  target: { latitude: 50.3, longitude: 8.8, radius: 60 },
};

test("the map shows the estimate with two standard deviations, and the fix beside it", () => {
  const picture = pictureOf(storeOf({
    location: { latitude: 50.1, longitude: 8.6 }, navigation: NAVIGATION,
    age_ms: { navigation: 100, location: 100 }, home: { ...HOME, time_s: 65 },
  }));
  assert.deepEqual(picture.aircraft, { latitude: 50.2, longitude: 8.7 });
  assert.equal(picture.heading_deg, 33);
  assert.deepEqual(picture.home, HOME);
  assert.match(homeText(picture), / 1:05$/);
  const limited = pictureOf(storeOf({ navigation: NAVIGATION, home: HOME, fence: { radius: 300 } }));
  assert.deepEqual(circlesOf(limited)[0], { name: "fence", place: HOME, radius_m: 300 });
  assert.equal(limitOf(limited).length, 48);
  assert.deepEqual(limitOf({ ...limited, home: null }), []);
  const circles = new Map(circlesOf({ ...picture, chosen: null }).map(({ name, ...more }) => [name, more]));
  assert.deepEqual([...circles.keys()], ["uncertainty", "target", "fix", "target-point"]);
  assert.equal(circles.get("uncertainty").radius_m, 5);
  assert.deepEqual(circles.get("uncertainty").place, picture.aircraft);
  assert.equal(circles.get("target").radius_m, 60);
  assert.deepEqual(circles.get("fix").place, HOME);
});

test("without an estimate the map shows the fix, and the server's home", () => {
  const picture = pictureOf(storeOf({ location: { latitude: 50.1, longitude: 8.6 }, age_ms: { location: 100 } }));
  assert.deepEqual(picture.aircraft, HOME);
  assert.deepEqual(picture.home, { latitude: 1, longitude: 2 });
  assert.equal(picture.time_s, undefined);
  assert.deepEqual(circlesOf(picture), []);
});

test("an aircraft that does not reach home in this wind is told from one whose way is unknown", () => {
  const home = { ...HOME, time_s: null };
  const blown = pictureOf(storeOf({ navigation: NAVIGATION, age_ms: { navigation: 0 }, home }));
  assert.equal(blown.time_s, null);
  const unset = pictureOf(storeOf({ navigation: NAVIGATION, age_ms: { navigation: 0 } }));
  assert.equal(unset.time_s, undefined);
  assert.notEqual(homeText(blown), homeText({ ...blown, time_s: undefined }));
});

test("a chosen place has its distance from home, else from the aircraft", () => {
  const place = placeAt(HOME, { east_m: 340, north_m: 0 });
  assert.match(placeText(place, HOME, null), /340 m .* 090°$/);
  assert.match(placeText(place, null, HOME), /340 m .* 090°$/);
  assert.doesNotMatch(placeText(place, null, null), /m/);
});

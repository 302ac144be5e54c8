import assert from "node:assert/strict";
import { test } from "node:test";
import {
  freshnessOf,
  isSilent,
  readingOf,
} from "../../../../ground/up_ground/web/static/js/state/newest_frame.js";

test("a page without a frame is silent and has nothing to show", () => {
  assert.equal(isSilent(null), true);
  assert.equal(freshnessOf("orientation", null, 10), "none");
  assert.equal(freshnessOf(null, null, undefined), "none");
});

test("everything is stale once the aircraft is silent", () => {
  assert.equal(isSilent(0.9), false);
  assert.equal(isSilent(0.901), true);
  assert.equal(freshnessOf("orientation", 0.95, 0), "stale");
  assert.equal(freshnessOf("battery", 0.95, 0), "stale");
  assert.equal(freshnessOf(null, 0.95, undefined), "stale");
});

test("a reading is as old as it was on board plus its way", () => {
  assert.equal(freshnessOf("orientation", 0.1, 790), "live");
  assert.equal(freshnessOf("orientation", 0.1, 810), "stale");
});

test("what comes once a second is stale later", () => {
  for (const reading of ["location", "altitude", "heading"]) {
    assert.equal(freshnessOf(reading, 0.1, 1790), "live");
    assert.equal(freshnessOf(reading, 0.1, 1810), "stale");
  }
  assert.equal(freshnessOf("battery", 0.1, 119000), "live");
  assert.equal(freshnessOf("battery", 0.1, 120000), "stale");
});

test("a reading that never arrived has no freshness, one without an age has its frame's", () => {
  assert.equal(freshnessOf("rx", 0.1, null), "none");
  assert.equal(freshnessOf("rx", 5, null), "none");
  assert.equal(freshnessOf("rx", 0.1, undefined), "live");
});

test("a negative age makes nothing fresher", () => {
  assert.equal(freshnessOf("rx", 0.95, -5000), "stale");
  assert.equal(freshnessOf("rx", 0.1, -5000), "live");
});

test("each value belongs to the reading that brings it", () => {
  assert.equal(readingOf("rates.yaw"), "orientation");
  assert.equal(readingOf("arduino.failsafe"), "flight");
  // The Raspberry Pi knows it when the board says nothing.
  assert.equal(readingOf("arduino.connected"), null);
  assert.equal(readingOf("constructor"), null);
});

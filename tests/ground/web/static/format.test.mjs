import assert from "node:assert/strict";
import { test } from "node:test";
import {
  ageText,
  compassDegrees,
  flagText,
  headingText,
  numberText,
  UNKNOWN,
} from "../../../../ground/up_ground/web/static/js/state/format.js";

test("a value that is not a number is shown as unknown", () => {
  for (const none of [null, undefined, NaN, Infinity]) {
    assert.equal(numberText(none, 1), UNKNOWN);
    assert.equal(ageText(none), UNKNOWN);
  }
  assert.equal(flagText(null), UNKNOWN);
  assert.equal(headingText(null), UNKNOWN);
  assert.equal(compassDegrees(null), null);
});

test("zero has no minus", () => {
  assert.equal(numberText(-0.04, 1), "0.0");
  assert.equal(numberText(-0, 0), "0");
  assert.equal(numberText(-0.04, 1, { sign: true }), "+0.0");
});

test("a sign is shown where it is asked for", () => {
  assert.equal(numberText(3.25, 1, { sign: true }), "+3.3");
  assert.equal(numberText(-3.2, 1, { sign: true }), "-3.2");
});

test("ages are read in few figures", () => {
  assert.equal(ageText(-1), "0.00 s");
  assert.equal(ageText(0.034), "0.03 s");
  assert.equal(ageText(9.996), "10.0 s");
  assert.equal(ageText(99.96), "2 min");
  assert.equal(ageText(7200), "2 h");
  assert.equal(ageText(1e9), "days");
});

test("a heading has three figures and never 360", () => {
  assert.equal(headingText(0), "000");
  assert.equal(headingText(359.7), "000");
  assert.equal(headingText(-1), "359");
  assert.equal(headingText(725), "005");
});

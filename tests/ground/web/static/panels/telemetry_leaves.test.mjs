import assert from "node:assert/strict";
import { test } from "node:test";

import { ChartChoice } from "../../../../../ground/up_ground/web/static/js/charts/chosen_chart.js";
import { span } from "../../../../../ground/up_ground/web/static/js/charts/line_chart.js";
import { leavesOf, matches, pathText, valueText } from "../../../../../ground/up_ground/web/static/js/panels/telemetry_row.js";
import { plainNumber } from "../../../../../ground/up_ground/web/static/js/state/format.js";
import * as validate from "../../../../../ground/up_ground/web/static/js/state/validate.js";

function paths(tree) {
  return leavesOf(tree).leaves.map(({ path }) => path);
}

test("every value is a leaf, in the order of the frame", () => {
  const tree = { b: { c: 1, a: null }, a: [true, { x: "y" }], empty: {}, none: [] };
  assert.deepEqual(paths(tree), ["b.c", "b.a", "a.0", "a.1.x", "empty", "none"]);
  for (const { keys, value } of leavesOf(tree).leaves) {
    assert.equal(validate.atKeys(tree, keys), value);
  }
  assert.deepEqual(paths({}), []);
  assert.deepEqual(paths(null), []);
});

test("a key may have dots, and be called as anything", () => {
  const tree = JSON.parse('{"a.b": 1, "a": {"b": 2}, "__proto__": {"c": 3}, "": 4}');
  const { leaves } = leavesOf(tree);
  assert.deepEqual(leaves.map(({ path }) => path), ["a.b", "a.b", "__proto__.c", ""]);
  assert.deepEqual(leaves.map(({ keys }) => validate.atKeys(tree, keys)), [1, 2, 3, 4]);
});

test("a frame of any size and depth makes a list that has an end", () => {
  const wide = Object.fromEntries(Array.from({ length: 5000 }, (_, n) => [`k${n}`, n]));
  const { leaves, isCut } = leavesOf(wide);
  assert.equal(leaves.length, 1000);
  assert.equal(isCut, true);
  const exact = leavesOf(Object.fromEntries(Object.entries(wide).slice(0, 1000)));
  assert.equal(exact.isCut, false);
  let deep = 1;
  for (let level = 0; level < 3000; level += 1) {
    deep = { d: deep };
  }
  const [leaf] = leavesOf(deep).leaves;
  assert.equal(leaf.keys.length, 24);
});

test("a value of any type is a short line that shows what it has", () => {
  assert.equal(valueText("FBW"), '"FBW"');
  assert.equal(valueText("12"), '"12"');
  assert.equal(valueText(12), "12");
  assert.equal(valueText(null), "null");
  assert.equal(valueText(false), "false");
  assert.equal(valueText({}), "{}");
  assert.equal(valueText("x".repeat(5000)).length, 165);
  assert.equal(valueText("a\u202eb\nc\u0000"), '"a\\u{202e}b\\u{a}c\\u{0}"');
  assert.equal(valueText("\ud800"), '"\\u{d800}"');
  assert.equal(pathText("a\u2066b"), "a\\u{2066}b");
});

test("a number of which nothing is known has the figures that mean something", () => {
  assert.equal(plainNumber(0.1 + 0.2), "0.3");
  assert.equal(plainNumber(49.2123456), "49.2123456");
  assert.equal(plainNumber(954428466), "954428466");
  assert.equal(plainNumber(Math.fround(27.59)), "27.59");
  assert.equal(plainNumber(Math.fround(1 / 3)), "0.33333334");
  assert.equal(plainNumber(1e-7), "1e-7");
  assert.equal(plainNumber(-0), "0");
  assert.equal(plainNumber(NaN), "--");
});

test("a filter is words that must all be in the path", () => {
  assert.ok(matches("hook.opening", ""));
  assert.ok(matches("hook.opening", "  OPEN hook "));
  assert.ok(!matches("hook.opening", "hook x"));
});

test("the selected chart is remembered, and invalid storage is ignored", () => {
  const kept = new Map();
  const memory = { get: (key) => kept.get(key) ?? null, set: (key, value) => kept.set(key, value) };
  const choice = new ChartChoice(memory);
  assert.equal(choice.keys, null);
  choice.choose(["a.b", "c"]);
  assert.ok(new ChartChoice(memory).is(["a.b", "c"]));
  assert.ok(!choice.is(["a", "b", "c"]));
  choice.choose(null);
  assert.equal(new ChartChoice(memory).keys, null);
  for (const nonsense of ["{", "7", "[]", "[7]", '"a"', JSON.stringify(Array(99).fill("a"))]) {
    kept.set("chart", nonsense);
    assert.equal(new ChartChoice(memory).keys, null, nonsense);
  }
});

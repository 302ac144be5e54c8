import assert from "node:assert/strict";
import { test } from "node:test";
import {
  at,
  flag,
  number,
  text,
  texts,
} from "../../../../ground/up_ground/web/static/js/state/validate.js";

const ODD = [null, undefined, "7", [], {}, NaN, Infinity, -Infinity, 1e300, true];

test("only a finite number of sane size is a number", () => {
  assert.equal(number(7.5), 7.5);
  assert.equal(number(0), 0);
  for (const odd of ODD) {
    assert.equal(number(odd), null);
  }
});

test("values of other types are rejected", () => {
  assert.equal(flag(1), null);
  assert.equal(flag(false), false);
  assert.equal(text(7), null);
  assert.equal(text("FBW"), "FBW");
  assert.equal(texts("a"), null);
  assert.deepEqual(texts(["a", 1, null, "b"]), ["a", "b"]);
});

test("texts are bounded", () => {
  assert.equal(text("x".repeat(10000)).length, 400);
  assert.equal(texts(Array(1000).fill("x")).length, 32);
});

test("a path finds only own properties", () => {
  const tree = JSON.parse('{"a": {"b": 1}, "__proto__": {"c": 2}}');
  assert.equal(at(tree, "a.b"), 1);
  assert.equal(at(tree, "a.b.c"), undefined);
  assert.equal(at(tree, "a.constructor"), undefined);
  assert.equal(at(tree, "toString"), undefined);
  assert.equal(at({}, "__proto__.c"), undefined);
  assert.equal(at(null, "a"), undefined);
});

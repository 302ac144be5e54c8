import assert from "node:assert/strict";
import { test } from "node:test";
import { Backoff } from "../../../../ground/up_ground/web/static/js/link/backoff.js";

test("attempts come after a quarter of a second, then at most every two", () => {
  const backoff = new Backoff();
  const waits_s = Array.from({ length: 6 }, () => backoff.next_s());
  assert.deepEqual(waits_s, [0.25, 0.5, 1, 2, 2, 2]);
  assert.equal(backoff.attempts, 6);
});

test("a success begins anew", () => {
  const backoff = new Backoff();
  backoff.next_s();
  backoff.next_s();
  backoff.reset();
  assert.equal(backoff.next_s(), 0.25);
});

test("a thousand failures later it still is two seconds", () => {
  const backoff = new Backoff();
  for (let count = 0; count < 5000; count += 1) {
    backoff.next_s();
  }
  assert.equal(backoff.next_s(), 2);
});

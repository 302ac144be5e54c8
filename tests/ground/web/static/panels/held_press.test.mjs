import assert from "node:assert/strict";
import { test } from "node:test";

import { HeldPress, HOLD_S } from "../../../../../ground/up_ground/web/static/js/panels/held_press.js";

/** Look every 16 ms, as a page does, and count how often the press fired. */
function hold(press, from_s, to_s, reason = () => null) {
  let fired = 0;
  for (let now_s = from_s; now_s <= to_s + 1e-9; now_s += 0.016) {
    fired += press.update(now_s, reason(now_s)) ? 1 : 0;
  }
  return fired;
}

test("a press that is held fires once, however long it is held on", () => {
  const press = new HeldPress();
  press.press("pointer", 10);
  assert.equal(hold(press, 10, 10 + HOLD_S - 0.02), 0);
  assert.equal(hold(press, 10 + HOLD_S - 0.02, 20), 1);
  assert.equal(press.state, "done");
  press.release("pointer");
  assert.equal(press.state, "idle");
});

test("released a moment too early it does nothing and shows why", () => {
  const press = new HeldPress();
  press.press("pointer", 0);
  assert.equal(hold(press, 0, HOLD_S - 0.02), 0);
  press.release("pointer");
  assert.equal(press.state, "idle");
  assert.equal(press.reason.code, "too_early");
  assert.equal(hold(press, HOLD_S, 5), 0);
});

test("an objection that comes while it is held ends it for good, gone again or not", () => {
  const press = new HeldPress();
  press.press("pointer", 0);
  const silent = (now_s) => (now_s > 0.7 && now_s < 0.8 ? { code: "silent" } : null);
  assert.equal(hold(press, 0, 10, silent), 0);
  assert.equal(press.state, "void");
  assert.equal(press.reason.code, "silent");
  press.release("pointer");
  press.press("pointer", 11);
  assert.equal(hold(press, 11, 13), 1);
});

test("an objection at the first moment lets it not even begin", () => {
  const press = new HeldPress();
  press.press("key Enter", 0, { code: "control_free" });
  assert.equal(press.state, "void");
  assert.equal(hold(press, 0, 5), 0);
});

test("a page that hung does not fire when it wakes", () => {
  const press = new HeldPress();
  press.press("pointer", 0);
  assert.equal(press.update(0.3), false);
  assert.equal(press.update(5), false);
  assert.equal(press.state, "void");
  assert.equal(press.reason.code, "page_delayed");
});

test("the repetition of a held key is not a second press", () => {
  const press = new HeldPress();
  press.press("key  ", 0);
  hold(press, 0, 0.5);
  press.press("key  ", 0.5);
  assert.equal(hold(press, 0.5, 2), 1);
});

test("a second finger makes it void until both have gone", () => {
  const press = new HeldPress();
  press.press("pointer 1", 0);
  hold(press, 0, 0.5);
  press.press("pointer 2", 0.5);
  assert.equal(press.state, "void");
  press.release("pointer 1");
  assert.equal(press.state, "void");
  assert.equal(hold(press, 0.5, 9), 0);
  press.release("pointer 2");
  assert.equal(press.state, "idle");
});

test("an abandoned press does not count", () => {
  const press = new HeldPress();
  press.press("pointer", 0);
  hold(press, 0, 1);
  press.abandon({ code: "unfocused" });
  assert.equal(press.state, "idle");
  assert.equal(press.reason.code, "unfocused");
  assert.equal(hold(press, 1, 9), 0);
  press.release("pointer");
  assert.equal(press.state, "idle");
});

test("the ring fills from nothing to whole, and is empty for a void press", () => {
  const press = new HeldPress();
  assert.equal(press.progress(0), 0);
  press.press("pointer", 0);
  assert.equal(press.progress(HOLD_S / 2), 0.5);
  assert.equal(press.progress(HOLD_S * 2), 1);
  press.void({ code: "gone" });
  assert.equal(press.progress(HOLD_S / 2), 0);
});

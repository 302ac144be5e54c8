import assert from "node:assert/strict";
import { test } from "node:test";
import { Motion } from "../../../../ground/up_ground/web/static/js/state/motion.js";

const DEGREE_M = (Math.PI / 180) * 6371009;

test("one fix gives no speed", () => {
  const motion = new Motion();
  motion.place(50, 8, 10);
  motion.place(50, 8, 10.01);
  assert.equal(motion.groundSpeed_m_s, null);
});

test("the speed of fixes that come once a second, each told in ten frames with jitter", () => {
  const motion = new Motion();
  for (let frame = 0; frame < 60; frame += 1) {
    const fix = Math.floor(frame / 10);
    const jitter_s = ((frame * 7) % 5) * 0.004;
    motion.place(50 + (fix * 15) / DEGREE_M, 8, fix + jitter_s);
  }
  assert.ok(Math.abs(motion.groundSpeed_m_s - 15) < 0.4, String(motion.groundSpeed_m_s));
});

test("an aircraft that stands has no speed, rather than an unknown one", () => {
  const motion = new Motion();
  for (let fix = 0; fix < 5; fix += 1) {
    motion.place(50, 8, fix);
  }
  assert.equal(motion.groundSpeed_m_s, 0);
});

test("a gap of ten seconds is not averaged over", () => {
  const motion = new Motion();
  motion.place(50, 8, 0);
  motion.place(50 + 10 / DEGREE_M, 8, 1);
  motion.place(51, 8, 11);
  assert.equal(motion.groundSpeed_m_s, null);
  motion.place(51 + 10 / DEGREE_M, 8, 12);
  assert.ok(Math.abs(motion.groundSpeed_m_s - 10) < 0.01);
});

test("climbing is positive, and unknown numbers change nothing", () => {
  const motion = new Motion();
  motion.height(100, 0);
  motion.height(103, 1);
  motion.height(null, 2);
  motion.height(200, null);
  assert.ok(Math.abs(motion.climb_m_s - 3) < 1e-9);
  motion.height(100, 2);
  motion.height(96, 3);
  assert.ok(motion.climb_m_s < 0);
});

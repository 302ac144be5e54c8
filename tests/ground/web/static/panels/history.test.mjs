import assert from "node:assert/strict";
import { test } from "node:test";

import { History, WINDOW_S } from "../../../../../ground/up_ground/web/static/js/charts/history.js";
import { span } from "../../../../../ground/up_ground/web/static/js/charts/line_chart.js";

function fill(history, from_s, to_s, period_s = 0.1) {
  for (let index = 0; from_s + index * period_s <= to_s + 1e-9; index += 1) {
    const time_s = from_s + index * period_s;
    history.add(time_s, { roll: time_s });
  }
}

test("an even sequence is one line without a gap", () => {
  const history = new History(["roll"]);
  fill(history, 100, 110);
  const [times_s, rolls] = history.columns(110);
  assert.equal(times_s.length, 101);
  assert.ok(Math.abs(times_s[0] + 10) < 1e-9);
  assert.ok(!rolls.includes(null));
});

test("no line goes across a silence", () => {
  const history = new History(["roll"]);
  fill(history, 100, 105);
  fill(history, 108, 109);
  const [times_s, rolls] = history.columns(109);
  const holes = rolls.flatMap((value, index) => (value === null ? [times_s[index]] : []));
  assert.equal(holes.length, 1);
  assert.ok(holes[0] > -4 && holes[0] < -1);
});

test("a short delay is not a silence", () => {
  const history = new History(["roll"]);
  fill(history, 100, 105);
  fill(history, 105.6, 106);
  assert.ok(!history.columns(106)[1].includes(null));
});

test("a slow period is not a silence once it is known", () => {
  const history = new History(["roll"]);
  fill(history, 100, 140, 2);
  const [times_s, rolls] = history.columns(140);
  const late = rolls.filter((value, index) => times_s[index] > -20);
  assert.ok(!late.includes(null));
});

test("nothing up to now ends the line before now", () => {
  const history = new History(["roll"]);
  fill(history, 100, 105);
  const [times_s, rolls] = history.columns(107);
  assert.equal(times_s.at(-1), 0);
  assert.equal(rolls.at(-1), null);
});

test("a value that is not known is a hole, the others go on", () => {
  const history = new History(["roll", "pitch"]);
  history.add(1, { roll: 1, pitch: 2 });
  history.add(1.1, { roll: null, pitch: 2 });
  history.add(1.2, { roll: NaN, pitch: 2 });
  const [, rolls, pitches] = history.columns(1.2);
  assert.deepEqual(rolls, [1, null, null]);
  assert.deepEqual(pitches, [2, 2, 2]);
});

test("a frame of another time than the last one's never goes back in time", () => {
  const history = new History(["roll"]);
  fill(history, 100, 101);
  const before = history.length;
  history.add(100.5, { roll: 9 });
  history.add(101, { roll: 9 });
  history.add(NaN, { roll: 9 });
  assert.equal(history.length, before);
});

test("an hour at 50 a second keeps little more than the last minute", () => {
  const history = new History(["roll"]);
  fill(history, 0, 3600, 0.02);
  assert.ok(history.length < (WINDOW_S + 2) * 50 + 300, String(history.length));
  assert.ok(history.columns(3600)[0][0] >= -WINDOW_S);
});

test("after clearing there is nothing", () => {
  const history = new History(["roll"]);
  fill(history, 0, 10);
  history.clear();
  assert.deepEqual(history.columns(10), [[], []]);
});

test("an axis shows all values, and never a sliver", () => {
  assert.deepEqual(span(null, null, 20), [-10, 10]);
  const [least, most] = span(5, 5, 20);
  assert.deepEqual([least, most], [-5, 15]);
  const [low, high] = span(-50, 50, 20);
  assert.ok(low < -50 && high > 50);
});

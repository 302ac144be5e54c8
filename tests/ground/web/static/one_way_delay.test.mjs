import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { OneWayDelayEstimator } from "../../../../ground/up_ground/web/static/js/link/one_way_delay.js";

const APART_S = 4321;
const ONE_WAY_S = 0.03;
const DRIFT = 1e-4;

let way;

beforeEach(() => {
  way = new OneWayDelayEstimator();
});

/** A message sent at `sent_s` of the page's clock with that transit time. */
function hear(sent_s, way_s, asked_s = null, drift = 0) {
  return way.take((sent_s * (1 + drift) + APART_S) * 1000, sent_s + way_s, asked_s);
}

function near(told_s, true_s, within_s = 0.002) {
  assert.ok(Math.abs(told_s - true_s) <= within_s, `${told_s} told, ${true_s} true`);
}

test("with a question the way is half of the quickest round trip", () => {
  near(hear(10, ONE_WAY_S, 10 - ONE_WAY_S), ONE_WAY_S);
  near(hear(10.5, ONE_WAY_S), ONE_WAY_S);
});

test("a queued message has its true age, and the next is fresh", () => {
  hear(10, ONE_WAY_S, 10 - ONE_WAY_S);
  near(hear(11, 3), 3);
  near(hear(11.1, 2.9), 2.9);
  near(hear(15, ONE_WAY_S), ONE_WAY_S);
});

test("without any question the quickest message counts as no time", () => {
  near(hear(10, ONE_WAY_S), 0);
  near(hear(11, 0.5), 0.5 - ONE_WAY_S);
});

test("a queue that stands from the first message on is known by a question", () => {
  assert.ok(hear(10, 2, 10 - ONE_WAY_S) >= 1.9);
  for (let second = 11; second < 60; second += 1) {
    const told_s = hear(second, 2, second - ONE_WAY_S);
    assert.ok(told_s >= 1.9 && told_s <= 2 + ONE_WAY_S, String(told_s));
  }
});

test("a queue that stands for an hour is not taken for the way", () => {
  hear(0, ONE_WAY_S, -ONE_WAY_S);
  for (let second = 1; second <= 3600; second += 1) {
    hear(second, 2, second - ONE_WAY_S);
  }
  near(hear(3601, 2), 2, 0.1 + 2 * 3600 * DRIFT);
});

test("clocks that drift make nothing old", () => {
  for (const drift of [-DRIFT, DRIFT]) {
    way = new OneWayDelayEstimator();
    for (let second = 0; second < 20000; second += 1) {
      near(hear(second, ONE_WAY_S, second - ONE_WAY_S, drift), ONE_WAY_S, 0.01);
    }
  }
});

test("no delay is underestimated by more than 0.1 s, nor overestimated by a quick request", () => {
  let state = 7;
  const random = () => {
    state = (state * 48271) % 2147483647;
    return state / 2147483647;
  };
  for (let flight = 0; flight < 300; flight += 1) {
    way = new OneWayDelayEstimator();
    const here_s = random() * 0.3;
    const there_s = random() * 0.3;
    const queue_s = random() < 0.5 ? 0 : random() * 5;
    let now_s = 0;
    let quickest_s = Infinity;
    for (let count = 0; count < 50; count += 1) {
      const sent_s = Math.max(count * 0.5, 0);
      const way_s = Math.max(here_s + queue_s + random(), now_s - sent_s);
      now_s = sent_s + way_s;
      const asking_s = count === 0 || random() < 0.5 ? there_s + random() * 0.5 : null;
      quickest_s = Math.min(quickest_s, asking_s ?? Infinity);
      const told_s = hear(sent_s, way_s, asking_s === null ? null : sent_s - asking_s);
      assert.ok(told_s >= way_s - 0.1 - 0.012, `${told_s} told, ${way_s} true`);
      assert.ok(told_s <= way_s + quickest_s + 0.001, `${told_s} told, ${way_s} true`);
    }
  }
});

test("a page or server that slept resets the estimate", () => {
  for (const asleep_s of [-60, 60]) {
    way = new OneWayDelayEstimator();
    hear(10, ONE_WAY_S, 10 - ONE_WAY_S);
    const stamp_ms = (20 + APART_S - asleep_s) * 1000;
    way.take(stamp_ms, 20 + ONE_WAY_S, 20 - ONE_WAY_S);
    near(way.take(stamp_ms + 1000, 21 + ONE_WAY_S), ONE_WAY_S);
    near(way.take(stamp_ms + 2000, 25), 3);
  }
});

test("a server that tells no clock, or an odd one, is not judged", () => {
  hear(10, ONE_WAY_S, 10 - ONE_WAY_S);
  for (const odd of [undefined, null, "5", NaN, Infinity, 1e300, [1], true, {}]) {
    assert.equal(way.take(odd, 12, 11), null);
  }
  near(hear(13, 1), 1);
});

import assert from "node:assert/strict";
import { test } from "node:test";

import { piecesOf } from "../../../../../ground/up_ground/web/static/js/map/track_line.js";
import { Silence } from "../../../../../ground/up_ground/web/static/js/state/track.js";
import { Track } from "../../../../../ground/up_ground/web/static/js/state/track.js";

/** Fly north by 0.001 degrees a frame. */
function fly(track, from_s, to_s, period_s = 0.1) {
  for (let index = 0; from_s + index * period_s <= to_s + 1e-9; index += 1) {
    const time_s = from_s + index * period_s;
    track.append(50 + time_s / 100, 8, 100, time_s);
  }
}

test("no line of the map leads across a silence", () => {
  const track = new Track();
  fly(track, 10, 11);
  fly(track, 17, 18);
  fly(track, 18.5, 19);
  const pieces = piecesOf(track.points);
  assert.equal(pieces.length, 2);
  assert.deepEqual(pieces[1][0], [50.17, 8]);
  assert.ok(pieces.flat().every((each) => each.length === 2));
});

test("the silences that the server knows of are drawn as such too, and what it says is judged", () => {
  const track = new Track();
  track.replace([[50, 8, 1], [50.1, 8, null, true], [50.2, 8, 1, "yes"], [50.3, 8, 1, true, 7]], 100);
  assert.deepEqual(piecesOf(track.points).map((each) => each.length), [1, 2, 1]);
  fly(track, 100.1, 101);
  assert.equal(piecesOf(track.points).length, 3);
});

test("an aircraft that comes back long after the page was told its way is not joined to it", () => {
  const track = new Track();
  track.replace([[50, 8, 1], [50.1, 8, 1]], 100);
  fly(track, 106, 107);
  assert.equal(piecesOf(track.points).length, 2);
});

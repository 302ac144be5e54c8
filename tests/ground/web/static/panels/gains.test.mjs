import assert from "node:assert/strict";
import { test } from "node:test";

import {
  cellsOf,
  difference,
  gainText,
  GainsEditor,
  readGain,
  setBefore,
  setOf,
} from "../../../../../ground/up_ground/web/static/js/panels/gains_editor.js";

const axis = (p, i = 0, d = 0) => ({ p, i, d });
const loop = (roll, pitch, yaw) => ({ ailerons: axis(roll), elevator: axis(pitch), rudder: axis(yaw) });
const SET = { ratePIDs: loop(2, 2.1, 1), stabPIDs: loop(4.1, 1, 0) };
const changed = (path, value) => setOf(new Map([...cellsOf(SET), [path, value]]));

function editor(set = SET) {
  const made = new GainsEditor();
  made.takeFlying(set);
  return made;
}

test("a set goes to cells and back whole", () => {
  assert.equal(cellsOf(SET).size, 18);
  assert.deepEqual(setOf(cellsOf(SET)), SET);
  assert.deepEqual(setOf(cellsOf({ ...SET, navPIDs: loop(1, 1, 1) })), SET);
  assert.equal(cellsOf(null).size, 0);
  assert.equal(cellsOf({ ratePIDs: { ailerons: { p: "2", i: NaN, d: 0 } } }).size, 1);
});

test("a difference is described with its size", () => {
  const words = (path, value) => difference(cellsOf(SET), cellsOf(changed(path, value)))[0].words;
  assert.equal(words("ratePIDs.ailerons.p", 2.4), "rate roll P 2.0 → 2.4, +20 %");
  assert.equal(words("stabPIDs.elevator.p", 0.995), "stabilize pitch P 1.0 → 0.995, −0.5 %");
  assert.equal(words("ratePIDs.rudder.i", 0.3), "rate yaw I 0.0 → 0.3, was off");
  assert.equal(words("ratePIDs.rudder.p", 0), "rate yaw P 1.0 → 0.0, off");
  assert.equal(words("ratePIDs.elevator.p", 4.2), "rate pitch P 2.1 → 4.2, +100 %");
});

test("digits added by single precision are neither shown nor a difference", () => {
  assert.equal(gainText(2.0999999046325684), "2.1");
  assert.equal(gainText(0.7), "0.7");
  assert.equal(gainText(50), "50.0");
  const rounded = cellsOf(changed("ratePIDs.elevator.p", 2.0999999046325684));
  assert.deepEqual(difference(cellsOf(SET), rounded), []);
});

test("an invalid gain is rejected with its reason", () => {
  for (const written of ["0", "50", "2.4", " .5 ", "1e-3", "3."]) {
    assert.equal(readGain(written).problem, "", written);
  }
  for (const written of ["50.1", "-0.1", "1e9"]) {
    assert.equal(readGain(written).problem, "must be 0 to 50", written);
  }
  assert.match(readGain("2,4").problem, /write a point/);
  for (const written of ["abc", "NaN", "Infinity", "0x10", "1 2", ""]) {
    assert.notEqual(readGain(written).problem, "", written);
  }
});

test("the whole set is sent, untouched gains with every digit", () => {
  const made = editor(changed("ratePIDs.elevator.p", 2.0999999046325684));
  assert.equal(made.wanted, null);
  made.write("ratePIDs.ailerons.p", "2.4");
  assert.equal(made.wanted.ratePIDs.ailerons.p, 2.4);
  assert.equal(made.wanted.ratePIDs.elevator.p, 2.0999999046325684);
  assert.equal(cellsOf(made.wanted).size, 18);
});

test("nothing is sent while one cell is invalid", () => {
  const made = editor();
  made.write("ratePIDs.ailerons.p", "2.4");
  made.write("ratePIDs.ailerons.i", "51");
  assert.equal(made.wanted, null);
  assert.deepEqual(made.problems, [
    { path: "ratePIDs.ailerons.i", words: "rate roll I must be 0 to 50" },
  ]);
  assert.equal(made.difference.length, 1);
});

test("an edit back to the active value is not an edit", () => {
  const made = editor();
  made.write("ratePIDs.ailerons.p", "2.4");
  made.write("ratePIDs.ailerons.p", "2.00");
  assert.equal(made.isEdited, false);
});

test("active gains from another page never overwrite an edit: they are a conflict", () => {
  const made = editor();
  made.write("ratePIDs.ailerons.p", "2.4");
  made.takeFlying(changed("ratePIDs.ailerons.p", 2.2));
  assert.equal(made.textOf("ratePIDs.ailerons.p"), "2.4");
  assert.deepEqual(made.conflicts, [
    {
      path: "ratePIDs.ailerons.p",
      words: "rate roll P: 2.2 flies now, it was 2.0 when you wrote 2.4",
    },
  ]);
  made.write("ratePIDs.ailerons.p", "2.5");
  assert.equal(made.conflicts.length, 1);
  made.accept();
  assert.deepEqual(made.conflicts, []);
  assert.equal(made.wanted.ratePIDs.ailerons.p, 2.5);
});

test("active gains from another page in other cells are sent back", () => {
  const made = editor();
  made.write("ratePIDs.ailerons.p", "2.4");
  made.takeFlying(changed("stabPIDs.elevator.d", 0.2));
  assert.deepEqual(made.conflicts, []);
  assert.equal(made.textOf("stabPIDs.elevator.d"), "0.2");
  assert.equal(made.wanted.stabPIDs.elevator.d, 0.2);
});

test("an edit that became active is not an edit", () => {
  const made = editor();
  made.write("ratePIDs.ailerons.p", "2.4");
  made.takeFlying(changed("ratePIDs.ailerons.p", 2.4000000953674316));
  assert.equal(made.isEdited, false);
});

test("undo is the set before the active one, if known", () => {
  const [first, second] = [SET, changed("ratePIDs.ailerons.p", 2.4)];
  const acked = { before: first, after: second, outcome: "ack" };
  const refused = { before: second, after: changed("ratePIDs.ailerons.p", 9), outcome: "nack" };
  assert.deepEqual(setBefore([acked, refused], cellsOf(second)), first);
  assert.equal(setBefore([acked], cellsOf(changed("ratePIDs.ailerons.p", 7))), null);
  assert.equal(setBefore([refused], cellsOf(second)), null);
  assert.equal(setBefore([], cellsOf(second)), null);
});

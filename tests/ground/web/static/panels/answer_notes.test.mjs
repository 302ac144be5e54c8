import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { AnswerNotes } from "../../../../../ground/up_ground/web/static/js/panels/command_sender.js";

let calls, store, connection, notes, note;

/** As much of an element as a note needs. */
class Note {
  textContent = "";
  has = {};

  setAttribute(name, value) {
    this.has[name] = value;
  }
}

beforeEach(() => {
  calls = {};
  store = { aircraft: "one", now_s: 100, status: { control: { holder: "you" } }, subscribe: (call) => (calls.update = call) };
  connection = { on: (type, call) => (calls[type] = call) };
  notes = new AnswerNotes(store, connection);
  calls.update();
  note = new Note();
  notes.show(note, "carried out", "good");
});

function wait(seconds) {
  store.now_s += seconds;
  calls.update();
}

test("an answer tells its age, turns grey, and goes", () => {
  wait(1);
  assert.deepEqual([note.has["data-age"], note.has["data-old"]], ["", "false"]);
  wait(5);
  assert.deepEqual([note.has["data-age"], note.has["data-old"]], ["6 s ago", "false"]);
  wait(10);
  assert.deepEqual([note.has["data-age"], note.has["data-old"]], ["16 s ago", "true"]);
  assert.equal(note.textContent, "carried out");
  wait(110);
  assert.deepEqual([note.textContent, note.has["data-age"], note.has["data-look"]], ["", "", "plain"]);
});

test("an answer goes with the control that it was given to", () => {
  store.status = { control: { holder: "page" } };
  calls.update();
  assert.equal(note.textContent, "");
});

test("an answer goes with the aircraft that gave it", () => {
  store.aircraft = "two";
  calls.update();
  assert.equal(note.textContent, "");
});

test("an answer goes with the connection, and a later one stays", () => {
  calls.closed();
  assert.equal(note.textContent, "");
  notes.show(note, "nobody knows", "bad");
  calls.update();
  assert.equal(note.textContent, "nobody knows");
});

test("a text written by another part is kept", () => {
  note.textContent = "must be 0 to 360 deg";
  wait(130);
  calls.closed();
  assert.equal(note.textContent, "must be 0 to 360 deg");
  assert.equal(note.has["data-age"], "");
});

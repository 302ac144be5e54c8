import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { noticeWords } from "../../../../../ground/up_ground/web/static/js/panels/control_notice.js";
import { ControlWishes } from "../../../../../ground/up_ground/web/static/js/panels/control_wishes.js";
import { controlWords } from "../../../../../ground/up_ground/web/static/js/panels/control_words.js";

const WELCOME = { page: 3, may_control: true, is_replay: false };
const HELD = { holder: "page", holder_name: "Anna", asked_by: null, pages: [] };
let wishes;

beforeEach(() => {
  wishes = new ControlWishes();
});

test("a wish is of one aircraft alone, and so is what became of it", () => {
  wishes.asked("one", "Anna", 10);
  assert.equal(wishes.isWaiting("one", HELD, 3, 11), true);
  assert.match(wishes.words("one", 11), /^You have asked Anna for control/);
  assert.equal(wishes.isWaiting("two", HELD, 3, 11), false);
  assert.equal(wishes.words("two", 11), "");
  wishes.fault("Anna keeps control", "two", 12);
  assert.equal(wishes.words("two", 12), "");
  assert.equal(wishes.words("one", 12), "Anna keeps control");
  assert.equal(wishes.isWaiting("one", HELD, 3, 12), false);
  assert.equal(wishes.words("one", 60), "");
});

test("a wish ends by control, by its withdrawal, by its time, and with the connection", () => {
  wishes.asked("one", "Anna", 10);
  assert.equal(wishes.isWaiting("one", { ...HELD, holder: "you" }, 3, 11), false);
  assert.equal(wishes.words("one", 11), "");
  wishes.asked("one", "Anna", 20);
  wishes.withdraw("one");
  assert.equal(wishes.isWaiting("one", HELD, 3, 21), false);
  wishes.asked("one", "Anna", 30);
  assert.equal(wishes.isWaiting("one", HELD, 3, 60), true);
  assert.equal(wishes.isWaiting("one", HELD, 3, 64), false);
  assert.match(wishes.words("one", 64), /^Anna did not give control/);
  wishes.asked("one", "Anna", 70);
  wishes.forget();
  assert.equal(wishes.isWaiting("one", HELD, 3, 71), false);
});

test("what the server knows of this page's asking counts, and is not told as somebody else's", () => {
  const asked = { ...HELD, asked_by: { page: 3, name: "page 3" } };
  assert.equal(wishes.isWaiting("one", asked, 3, 10), true);
  assert.equal(controlWords(asked, WELCOME).asked, "");
  assert.equal(wishes.isWaiting("one", asked, 4, 10), false);
  assert.equal(controlWords(asked, { ...WELCOME, page: 4 }).asked, "page 3 asks for control.");
  assert.equal(wishes.isWaiting("one", { ...HELD, asked_by: { page: null, name: "ground 2" } }, null, 10), false);
});

test("the notice names the aircraft where there are several", () => {
  const status = { aircraft: "one", control: { asked_by: { page: 2, name: "Ben" } } };
  assert.equal(noticeWords(status, 1), "Ben asks you for control.");
  assert.equal(noticeWords(status, 2), "Ben asks you for control of one.");
});

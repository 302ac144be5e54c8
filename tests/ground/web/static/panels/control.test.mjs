import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { noticeText } from "../../../../../ground/up_ground/web/static/js/panels/control.js";
import { ControlRequests } from "../../../../../ground/up_ground/web/static/js/panels/control_requests.js";
import { controlTexts } from "../../../../../ground/up_ground/web/static/js/panels/control_requests.js";

const WELCOME = { page: 3, may_control: true, is_replay: false };
const HELD = { holder: "page", holder_name: "Anna", asked_by: null, pages: [] };
let requests;

beforeEach(() => {
  requests = new ControlRequests();
});

test("a request and its outcome belong to one aircraft", () => {
  requests.asked("one", "Anna", 10);
  assert.equal(requests.isWaiting("one", HELD, 3, 11), true);
  assert.equal(requests.state("one", 11).code, "requested");
  assert.equal(requests.isWaiting("two", HELD, 3, 11), false);
  assert.equal(requests.state("two", 11), null);
  requests.fault({ code: "denied", text: "Anna keeps control" }, "two", 12);
  assert.equal(requests.state("two", 12), null);
  assert.equal(requests.state("one", 12).code, "denied");
  assert.equal(requests.isWaiting("one", HELD, 3, 12), false);
  assert.equal(requests.state("one", 60), null);
});

test("a wish ends by control, by its withdrawal, by its time, and with the connection", () => {
  requests.asked("one", "Anna", 10);
  assert.equal(requests.isWaiting("one", { ...HELD, holder: "you" }, 3, 11), false);
  assert.equal(requests.state("one", 11), null);
  requests.asked("one", "Anna", 20);
  requests.withdraw("one");
  assert.equal(requests.isWaiting("one", HELD, 3, 21), false);
  requests.asked("one", "Anna", 30);
  assert.equal(requests.isWaiting("one", HELD, 3, 60), true);
  assert.equal(requests.isWaiting("one", HELD, 3, 64), false);
  assert.equal(requests.state("one", 64).code, "request_timeout");
  requests.asked("one", "Anna", 70);
  requests.clear();
  assert.equal(requests.isWaiting("one", HELD, 3, 71), false);
});

test("a request known to the server counts as this page's own", () => {
  const asked = { ...HELD, asked_by: { page: 3, name: "page 3" } };
  assert.equal(requests.isWaiting("one", asked, 3, 10), true);
  assert.equal(controlTexts(asked, WELCOME).asked, "");
  assert.equal(requests.isWaiting("one", asked, 4, 10), false);
  assert.notEqual(controlTexts(asked, { ...WELCOME, page: 4 }).asked, "");
  assert.equal(requests.isWaiting("one", { ...HELD, asked_by: { page: null, name: "ground 2" } }, null, 10), false);
});

test("the notice names the aircraft where there are several", () => {
  const status = { aircraft: "kite-1", control: { asked_by: { page: 2, name: "Ben" } } };
  assert.ok(!noticeText(status, 1).includes("kite-1"));
  assert.ok(noticeText(status, 2).includes("kite-1"));
});

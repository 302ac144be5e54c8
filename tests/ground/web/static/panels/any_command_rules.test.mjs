import assert from "node:assert/strict";
import { test } from "node:test";

import { questionOf } from "../../../../../ground/up_ground/web/static/js/panels/any_command.js";
import { nameReason, warningOf } from "../../../../../ground/up_ground/web/static/js/panels/disabled_reason.js";

const GAINS = "arduino.pids.tunings";
const sender = { disabledReason: () => null };

/** An aircraft that is armed, and whose rule about gains is known. */
function flying(tune_in_flight) {
  return { aircraftState: "live", status: { tune_in_flight }, flag: (path) => path === "armed", text: () => null };
}

test("arming and disarming are not sent by name", () => {
  for (const name of ["up.arm", "up.disarm"]) {
    assert.equal(nameReason(flying(true), sender, name).code, "held_only");
    assert.equal(nameReason(flying(true), sender, name, {}).code, "held_only");
  }
});

test("gains are under the rule of their own panel, and asking for them is not", () => {
  assert.equal(nameReason(flying(false), sender, GAINS, { pids: {} }).code, "tune_armed");
  assert.equal(nameReason(flying(false), sender, GAINS, { request: true, pids: {} }).code, "tune_armed");
  assert.equal(nameReason(flying(false), sender, GAINS, { request: true }), null);
  assert.equal(nameReason(flying(false), sender, GAINS), null);
  assert.equal(nameReason(flying(true), sender, GAINS, { pids: {} }), null);
  const warning = warningOf(flying(true), GAINS, { pids: {} });
  assert.notEqual(warning, "");
  assert.ok(questionOf(GAINS, { pids: {} }, { text: "Sets them." }, warning).text.endsWith(warning));
  assert.equal(warningOf(flying(true), "android.speak", { text: "x" }), "");
});

test("a reason against any Command is one against a Command by its name", () => {
  const nobody = { disabledReason: () => ({ code: "control_free", text: "" }) };
  assert.equal(nameReason(flying(true), nobody, "android.speak", {}).code, "control_free");
  assert.equal(nameReason(flying(true), nobody, "up.arm").code, "control_free");
});

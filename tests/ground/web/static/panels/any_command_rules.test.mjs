import assert from "node:assert/strict";
import { test } from "node:test";

import { questionOf } from "../../../../../ground/up_ground/web/static/js/panels/any_command.js";
import { ruleAgainst, warningOf } from "../../../../../ground/up_ground/web/static/js/panels/any_command_rules.js";

const GAINS = "arduino.pids.tunings";
const asker = { objection: () => "" };

/** An aircraft that is armed, and whose rule about gains is known. */
function flying(tune_in_flight) {
  return { aircraftState: "live", status: { tune_in_flight }, flag: (path) => path === "armed", text: () => null };
}

test("arming and disarming are not sent by name", () => {
  for (const name of ["up.arm", "up.disarm"]) {
    assert.match(ruleAgainst(flying(true), asker, name), /the button that is held/);
    assert.match(ruleAgainst(flying(true), asker, name, {}), /the button that is held/);
  }
});

test("gains are under the rule of their own panel, and asking for them is not", () => {
  assert.match(ruleAgainst(flying(false), asker, GAINS, { pids: {} }), /refused while the aircraft is armed/);
  assert.match(ruleAgainst(flying(false), asker, GAINS, { request: true, pids: {} }), /refused while/);
  assert.equal(ruleAgainst(flying(false), asker, GAINS, { request: true }), "");
  assert.equal(ruleAgainst(flying(false), asker, GAINS), "");
  assert.equal(ruleAgainst(flying(true), asker, GAINS, { pids: {} }), "");
  const warning = warningOf(flying(true), GAINS, { pids: {} });
  assert.match(warning, /flies immediately/);
  assert.match(questionOf(GAINS, { pids: {} }, { text: "Sets them." }, warning).text, /flies immediately/);
  assert.equal(warningOf(flying(true), "android.speak", { text: "x" }), "");
});

test("what nobody may, nobody may by name", () => {
  const nobody = { objection: () => "Nobody has control: ask for it to command." };
  assert.match(ruleAgainst(flying(true), nobody, "android.speak", {}), /Nobody has control/);
  assert.match(ruleAgainst(flying(true), nobody, "up.arm"), /Nobody has control/);
});

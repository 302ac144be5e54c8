// With `flight controller: raspberry` the page selects the modes of the board and of the controller.
import assert from "node:assert/strict";
import { before, test } from "node:test";

import { GroundPage } from "./support/ground_page.mjs";
import { browser, stopAfter } from "./support/setup.mjs";
import { startShowcase } from "./support/showcase.mjs";
import { until } from "./support/wait.mjs";

/** What the board flies when the ground selects a mode. */
const FLOWN = { RATE: "RATE", FBW: "FBW", AUTO: "OUTPUT", LOITER: "OUTPUT", RETURN: "OUTPUT" };
let showcase;
let ground;

before(async () => {
  showcase = stopAfter(await startShowcase(["--controller", "raspberry"]));
  ground = await (await GroundPage.open(browser, showcase.address)).isLive();
  await ground.takeControl();
});

test("every mode is offered and flown, whichever is flown before", async () => {
  await until(async () => (await ground.frame()).flight_mode === "OUTPUT" || null, "the controller's Outputs");
  for (const mode of ["RATE", "FBW", "AUTO", "FBW", "LOITER", "RATE", "RETURN", "AUTO"]) {
    const answer = await ground.fly(mode);
    assert.equal(answer.outcome, "ack", JSON.stringify(answer));
    await until(async () => (await ground.frame()).flight_mode === FLOWN[mode] || null, `${mode} in telemetry`);
    await ground.until(
      (mode) => document.querySelector(`[data-mode="${mode}"]`).getAttribute("aria-pressed") === "true",
      `${mode} marked`,
      mode,
    );
  }
  ground.assertClean();
});

// The aircraft executes each request of the page, or refuses it with its reason.
import assert from "node:assert/strict";
import { before, test } from "node:test";

import { GroundPage } from "./support/ground_page.mjs";
import { Pilot } from "./support/pilot.mjs";
import { record } from "./support/recorder.mjs";
import { browser, stopAfter } from "./support/setup.mjs";
import { startShowcase } from "./support/showcase.mjs";
import { until } from "./support/wait.mjs";

/** How long a press must last, less what a frame of the screen takes. */
const HELD_MS = 1450;
let showcase;
let ground;

before(async () => {
  showcase = stopAfter(await startShowcase());
  ground = await (await GroundPage.open(browser, showcase.address)).isLive();
  await ground.takeControl();
});

/** Wait until telemetry says something. */
async function flies(condition, what) {
  await until(async () => condition(await ground.frame()) || null, what);
}

/** How many Commands the page has sent and heard of. */
async function answers() {
  return (await ground.messages("answer")).length;
}

test("a flight mode is flown after a question, and its ack is shown", async () => {
  for (const mode of ["RATE", "FBW"]) {
    const answer = await ground.answerTo(() => ground.press(`[data-mode="${mode}"]`));
    assert.equal(answer.outcome, "ack", JSON.stringify(answer));
    assert.equal(answer.code_shown, "ack");
    await flies((frame) => frame.flight_mode === mode, `${mode} in telemetry`);
    await ground.until(
      (mode) => document.querySelector('[data-key="flight_mode"]').textContent === mode,
      `${mode} on the page`,
      mode,
    );
  }
});

test("a declined confirmation sends nothing", async () => {
  const before = await answers();
  await ground.page.click('[data-mode="RATE"]');
  await ground.page.click("#confirm-no");
  assert.equal(await answers(), before);
  assert.equal((await ground.frame()).flight_mode, "FBW");
  assert.equal(await ground.page.isVisible("dialog#confirm"), false);
});

test("an invalid Command is not sent", async () => {
  const before = await answers();
  await ground.page.fill("#telemetry-period", "19");
  await ground.page.click("#telemetry-period-send");
  assert.equal(await ground.attribute("#telemetry-period", "aria-invalid"), "true");
  assert.equal(await ground.page.isVisible("dialog#confirm"), false);
  assert.equal(await answers(), before);
});

test("a disarm in flight is refused by the aircraft, and the page says why", async () => {
  const recorded = await record(ground.page, {
    press: { selector: "#disarm-button", attribute: "data-press" },
  });
  const answer = await ground.answerTo(() => ground.hold("#disarm-button"));
  const presses = await recorded.read();
  const done = presses.findIndex(({ value }) => value === "done");
  assert.equal(presses[done - 1].value, "pressed");
  assert.ok(presses[done].unix_ms - presses[done - 1].unix_ms > HELD_MS);
  assert.equal(answer.outcome, "nack");
  assert.equal(answer.code, "refused");
  assert.equal(answer.code_shown, "nack refused");
  assert.ok(answer.shown.endsWith(answer.reason), answer.shown);
  assert.equal((await ground.frame()).armed, true);
});

test("a press that does not last does nothing", async () => {
  const before = await answers();
  const hand = ground.mouse("#disarm-button");
  await hand.down();
  await ground.until(() => Number(document.querySelector("#disarm-button").dataset.progress) > 0.3, "a press");
  await hand.up();
  assert.equal(await ground.attribute("#arming-note", "data-code"), "too_early");
  assert.equal(await answers(), before);
});

test("with the throttle low the page disarms the motor and arms it again", async () => {
  const pilot = await new Pilot(showcase).ready();
  const glide = { aux1: 2000, aux2: 2000, throttle: 1000, ailerons: 1500, elevator: 1500 };
  pilot.move(glide);
  await flies((frame) => frame.rx.throttle < 1050, "the low throttle in telemetry");
  const disarmed = await until(async () => {
    const answer = await ground.answerTo(() => ground.hold("#disarm-button"));
    // It was not low for 2 s yet.
    return answer.outcome === "ack" ? answer : null;
  }, "the disarming");
  assert.equal(disarmed.code_shown, "ack");
  await ground.until(() => document.querySelector("#bar-armed").textContent === "disarmed", "disarmed");
  const armed = await ground.answerTo(() => ground.hold("#arm-button"));
  assert.equal(armed.outcome, "ack", JSON.stringify(armed));
  await ground.until(() => document.querySelector("#bar-armed").textContent === "ARMED", "armed");
  await pilot.leave();
});

test("the page has done nothing that it may not", () => ground.assertClean());

// Gains go from the page into the firmware and back, and not where the aircraft forbids it.
import assert from "node:assert/strict";
import { afterEach, before, test } from "node:test";

import { CarefulFlight } from "./support/careful_flight.mjs";
import { GroundPage } from "./support/ground_page.mjs";
import { run } from "./support/program.mjs";
import { browser, stopAfter } from "./support/setup.mjs";
import { startShowcase } from "./support/showcase.mjs";
import { until } from "./support/wait.mjs";

const FIELD = '#gains input[name="ratePIDs.ailerons.p"]';
const FAR = 0.0001;
let showcase;
let careful;

before(async () => {
  showcase = stopAfter(await startShowcase());
  careful = stopAfter(await CarefulFlight.start());
});

afterEach(() => GroundPage.closeAll());

/** The board's own report of its active gains, to another ground station. */
async function gainsOfBoard() {
  const port = String(showcase.groundPort);
  const environment = { XDG_STATE_HOME: showcase.folder };
  const words = ["send", "--port", port, "arduino.pids.tunings", "request=true"];
  return until(async () => {
    const { said } = await run("up-ground", words, { environment });
    const found = /arduino\.pids\.values (.*)/.exec(said);
    return found && JSON.parse(found[1]);
  }, "the board's gains");
}

function isSame(one, other) {
  return Math.abs(one - other) < FAR;
}

test("a change reaches the firmware, its ack the page, and undo takes it back", async () => {
  const ground = await (await GroundPage.open(browser, showcase.address)).isLive();
  await ground.takeControl();
  await ground.until((s) => document.querySelector(s)?.value, "the gains that fly", FIELD);
  const old = Number(await ground.page.inputValue(FIELD));
  const wanted = Number((old * 0.9).toFixed(3));

  await ground.page.fill(FIELD, String(wanted));
  await ground.until(() => !document.querySelector("#gains-difference").hidden, "the difference");
  const difference = await ground.text("#gains-difference");
  assert.ok(difference.includes(String(wanted)), difference);
  const answer = await ground.answerTo(() => ground.press("#gains-send"));
  assert.equal(answer.outcome, "ack", JSON.stringify(answer));
  assert.equal(answer.code_shown, "ack");
  await ground.until(() => document.querySelector("#gains-difference").hidden, "no difference left");

  await ground.leaveControl();
  const flown = await gainsOfBoard();
  assert.ok(isSame(flown.ratePIDs.ailerons.p, wanted), JSON.stringify(flown.ratePIDs));

  await ground.takeControl();
  await ground.until(() => !document.querySelector("#gains-undo").disabled, "the offer to undo");
  const undone = await ground.answerTo(() => ground.press("#gains-undo"));
  assert.equal(undone.outcome, "ack", JSON.stringify(undone));
  await ground.leaveControl();
  const again = await gainsOfBoard();
  assert.ok(isSame(again.ratePIDs.ailerons.p, old), JSON.stringify(again.ratePIDs));
  const others = (gains) => JSON.stringify([gains.ratePIDs.elevator, gains.stabPIDs, gains.navPIDs]);
  assert.equal(others(again), others(flown));
  ground.assertClean();
});

test("an invalid gain is not sent", async () => {
  const ground = await (await GroundPage.open(browser, showcase.address)).isLive();
  await ground.takeControl();
  await ground.until((s) => document.querySelector(s)?.value, "the gains that fly", FIELD);
  await ground.page.fill(FIELD, "99");
  await ground.until(() => document.querySelector("#gains-send").disabled, "no way to send it");
  assert.equal(await ground.attribute("#gains-difference", "data-problems"), "1");
  ground.assertClean();
});

test("in flight an aircraft that forbids it refuses, and the page says why", async () => {
  const ground = await (await GroundPage.open(browser, careful.address)).isLive();
  await ground.takeControl();
  await ground.until(() => document.querySelector("#bar-armed").textContent === "ARMED", "armed");
  await ground.until((s) => document.querySelector(s)?.value, "the gains that fly", FIELD);
  await ground.until(() => document.querySelector("#gains-send").disabled, "nothing offered");
  await ground.reason("#gains-why", "tune_armed");
  // Past everything that the page forbids: the aircraft has the last word.
  const { flying } = (await ground.messages("gains")).pop().message;
  const answer = await ground.answerTo(() =>
    ground.page.evaluate((pids) => {
      const { aircraft } = window.testMessages.find(({ message }) => message.type === "status").message;
      const { beacon } = window.testMessages.findLast(({ message }) => message.type === "frame").message;
      const data = { pids };
      const message = { type: "command", ask: 900, aircraft, name: "arduino.pids.tunings", data, beacon };
      window.testSockets[window.testSockets.length - 1].send(JSON.stringify(message));
    }, flying),
  );
  assert.equal(answer.outcome, "nack", JSON.stringify(answer));
  assert.equal(answer.code, "forbidden");
  ground.assertClean();
});

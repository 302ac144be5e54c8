// Two browsers and one control: its owner commands, the other watches, and it is handed over.
import assert from "node:assert/strict";
import { before, test } from "node:test";

import { GroundPage } from "./support/ground_page.mjs";
import { browser, stopAfter } from "./support/setup.mjs";
import { startShowcase } from "./support/showcase.mjs";

let showcase;
let first;
let second;

before(async () => {
  showcase = stopAfter(await startShowcase());
  first = await (await GroundPage.open(browser, showcase.address)).isLive();
  second = await (await GroundPage.open(browser, showcase.address)).isLive();
});

/** Whether a page offers to command. */
async function offers(page) {
  return page.page.isEnabled('[data-mode="FBW"]');
}

test("one has control, the other watches and shows the owner", async () => {
  await first.takeControl();
  await second.untilHolder("page");
  await first.until(() => !document.querySelector('[data-mode="FBW"]').disabled, "modes offered");
  await second.until(() => document.querySelector('[data-mode="FBW"]').disabled, "modes not offered");
  assert.equal(await second.page.isEnabled("#arm-button"), false);
  await second.reason("#commands-why", "control_page");
  const answer = await first.answerTo(() => first.press('[data-mode="FBW"]'));
  assert.equal(answer.outcome, "ack", JSON.stringify(answer));
});

test("the owner may keep control, wherever the page is scrolled to", async () => {
  await first.show("#mark");
  await second.page.click("#control-request");
  await first.until(() => !document.querySelector("#control-notice").hidden, "the question");
  assert.equal(await first.page.isVisible("#control-asked"), true);
  const { y, height } = await first.page.locator("#control-notice-deny").boundingBox();
  assert.ok(y > 0 && y + height < 900, "in sight");
  await second.until(() => document.querySelector("#control-request").dataset.waiting === "true", "waiting");
  assert.equal(await second.page.isVisible("#control-asked"), false);
  assert.equal(await second.attribute("#control-note", "data-code"), "requested");
  await first.page.click("#control-notice-deny");
  await second.reason("#control-note", "denied");
  await second.until(() => document.querySelector("#control-request").dataset.waiting === "false", "the offer to request it");
  await first.until(() => document.querySelector("#control-deny").hidden, "the question gone");
  await second.untilHolder("page");
  assert.equal(await offers(first), true);
  assert.equal(await offers(second), false);
});

test("a request may be withdrawn", async () => {
  await second.page.click("#control-request");
  await first.until(() => !document.querySelector("#control-notice").hidden, "the question");
  await second.until(() => document.querySelector("#control-request").dataset.waiting === "true", "waiting");
  await second.page.click("#control-request");
  await first.until(() => document.querySelector("#control-notice").hidden, "the question gone");
  await second.until(() => document.querySelector("#control-request").dataset.waiting === "false", "not waiting");
  assert.equal(await offers(first), true);
});

test("the owner may give control, and the roles change over", async () => {
  await second.page.click("#control-request");
  await first.until(() => !document.querySelector("#control-give").hidden, "the question");
  await first.page.click("#control-give");
  await second.untilHolder("you");
  await first.untilHolder("page");
  await second.until(() => !document.querySelector('[data-mode="FBW"]').disabled, "modes offered");
  await first.until(() => document.querySelector('[data-mode="FBW"]').disabled, "modes not offered");
  const answer = await second.answerTo(() => second.press('[data-mode="FBW"]'));
  assert.equal(answer.outcome, "ack", JSON.stringify(answer));
});

test("a page that is loaded again has control again", async () => {
  await second.page.reload();
  await second.isLive();
  await second.untilHolder("you");
});

test("a page that is closed leaves control to the others", async () => {
  second.assertClean();
  await second.close();
  await first.untilHolder("nobody");
  await first.takeControl();
  first.assertClean();
});

// The guide's steps in the page, with a real browser: node guide_page.mjs ADDRESS PROXY
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";

import { LAPTOP, startBrowser } from "../browser/support/browser.mjs";
import { GroundPage } from "../browser/support/ground_page.mjs";

const GUIDE = readFileSync(join(import.meta.dirname, "../../docs/guide.md"), "utf8");
const PAGE = GUIDE.slice(GUIDE.indexOf("<!-- steps: page -->"), GUIDE.indexOf("\n## 3"));
const ROLL_P = '#gains input[name="ratePIDs.ailerons.p"]';
const MARK = /Write `([^`]+)` under \*Mark in the flight log\*/.exec(PAGE)[1];
const [address, proxy] = process.argv.slice(2);
let place = 0;

/** Press the button that the guide names next. */
async function press(name) {
  const found = PAGE.indexOf(`**${name}**`, place);
  assert.notEqual(found, -1, `the guide does not say **${name}** there`);
  place = found + name.length;
  await ground.page.getByRole("button", { name, exact: true }).click();
}

/** Wait until the page shows the guide's quotation, ignoring its numbers. */
async function says(selector, quoted) {
  assert.ok(PAGE.includes(`\`${quoted}\``), `the guide does not quote ${quoted}`);
  const pattern = quoted.replace(/[.?*+^$()[\]{}|\\]/g, "\\$&").replace(/\d+(\\\.\d+)?/g, "[\\d.]+");
  await ground.until(
    ([s, words]) => [...document.querySelectorAll(s)].some((each) => new RegExp(words).test(each.textContent)),
    `"${quoted}" in ${selector}`,
    [selector, pattern],
  );
}

/** Do what the guide names next; all of it again when a busy machine was too late. */
async function carriedOut(action) {
  const from = place;
  const answer = await ground.answerTo(async () => {
    place = from;
    await action();
  });
  assert.equal(answer.outcome, "ack", JSON.stringify(answer));
}

const browser = await startBrowser();
const ground = await (await GroundPage.open(browser, address, LAPTOP)).isLive();
try {
  await press("Request control");
  await says("#control-holder", "You have control. All others watch.");
  for (const mode of ["RATE", "FBW"]) {
    await ground.until((m) => !document.querySelector(`[data-mode="${m}"]`).disabled, "the mode", mode);
    assert.ok(PAGE.includes(`**${mode}**, `), mode);
    await carriedOut(async () => {
      await ground.page.click(`[data-mode="${mode}"]`);
      await press(`Fly ${mode}`);
    });
  }
  assert.match(PAGE, /`Flight mode RATE: carried out after 12 ms`/);
  assert.equal(await ground.attribute("#last-answer", "data-code"), "ack");

  await ground.until((s) => document.querySelector(s)?.value, "the gains that fly", ROLL_P);
  const [, wanted] = /write ([\d.]+) over the P of \*Rate\*, \*roll\*/.exec(PAGE);
  await ground.page.fill(ROLL_P, wanted);
  const quoted = /`(rate roll P [^`]+)`/.exec(PAGE)[1];
  await ground.until((words) => document.querySelector("#gains-difference").textContent === words, quoted, quoted);
  await carriedOut(async () => {
    await press("Send gains");
    await press("Send");
  });
  await ground.until(() => !document.querySelector("#gains-undo").disabled, "the offer to undo");
  await carriedOut(async () => {
    await press("Undo");
    await press("Send");
  });
  assert.match(PAGE, /\*History\* has both/);
  await ground.until(() => document.querySelectorAll("#panel-gains details li").length === 2, "both in the history");

  await ground.page.getByLabel("Mark in the flight log").fill(MARK);
  await carriedOut(() => press("Mark"));

  // What the guide's module adds to telemetry is there without another file.
  assert.ok(GUIDE.includes("*All telemetry*, as `bank.steepest`"));
  await ground.page.locator("summary", { hasText: "All telemetry" }).click();
  await ground.until(() => /bank\.steepest/.test(document.querySelector("#telemetry-list").textContent), "the bank");

  const [, fields] = /\*Any Command\*, its name, `([^`]+)` as its fields, \*\*Send\*\*, \*\*Send unchecked\*\*/.exec(GUIDE);
  await ground.page.locator("summary", { hasText: "Any Command" }).click();
  await ground.until(() => document.querySelector("#any-names option") !== null, "the Commands that are known");
  await ground.page.fill("#any-name", "raspilot.remark");
  await ground.page.fill("#any-json", fields);
  await carriedOut(async () => {
    await ground.page.click("#any-send");
    await ground.page.getByRole("button", { name: "Send unchecked", exact: true }).click();
  });

  process.kill(Number(proxy), "SIGSTOP");
  try {
    await says("#silence", "no news for 1.2 s");
    await says("#alarms [role=alert]", "the aircraft is silent");
    // Then nothing that is sent now can be fresh again.
    await ground.until(() => Number(document.querySelector("#silence").dataset.ageS) > 2.5, "2.5 s");
    place = PAGE.indexOf("no news for");
    const late = await ground.firstAnswerTo(() => press("Mark now"));
    assert.equal(late.code, "stale", JSON.stringify(late));
  } finally {
    process.kill(Number(proxy), "SIGCONT");
  }
  await ground.isLive();
  await ground.untilHolder("you");
  await ground.until(() => document.querySelector('#events li[data-code="heard"]') !== null, "the event");
  await press("Release control");
  await ground.until(() => document.querySelector("#control-holder").dataset.holder === "nobody", "nobody");
  ground.assertClean();
} finally {
  await browser.close();
}

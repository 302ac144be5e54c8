// A new capability is one new file, or one cog, and no change anywhere else: the page shows its
// telemetry and offers its Command.
import assert from "node:assert/strict";
import { before, test } from "node:test";

import { ExtendedFlight } from "./support/extended_flight.mjs";
import { seriousFaults } from "./support/accessibility.mjs";
import { GroundPage } from "./support/ground_page.mjs";
import { browser, stopAfter } from "./support/setup.mjs";
import { until } from "./support/wait.mjs";

let flight;
let ground;

before(async () => {
  flight = stopAfter(await ExtendedFlight.start());
  ground = await (await GroundPage.open(browser, flight.address)).isLive();
});

/** Wait until the page shows a value. */
async function shows(key, text) {
  await until(async () => (await ground.value(key)) === text || null, `${key} ${text} on the page`);
}

test("the field of an application's one file and that of a cog appear automatically", async () => {
  assert.equal(await ground.value("hook.opening"), null, "nothing is listed while it is closed");
  await ground.page.click("#telemetry > summary");
  await shows("hook.opening", "5");
  await shows("tow.side", '"left"');
  await shows("tow.lamps", "null");
  assert.equal(await ground.attribute('[data-key="hook.opening"]', "data-freshness"), "live");
});

test("the filter leaves the matching rows", async () => {
  await ground.page.fill("#telemetry-filter", "HOOK open");
  const keys = () => [...document.querySelectorAll("#telemetry-list [data-key]")].map((each) => each.dataset.key);
  await ground.until(() => document.querySelectorAll("#telemetry-list li").length === 1, "one row");
  assert.deepEqual(await ground.page.evaluate(keys), ["hook.opening"]);
  await ground.page.fill("#telemetry-filter", "");
  await shows("tow.length", "0");
});

test("without control nothing is offered, with the reason", async () => {
  await ground.page.click("#any-command > summary");
  await ground.reason("#any-why", "control_free");
  assert.equal(await ground.page.isDisabled("#any-send"), true);
  await ground.takeControl();
  await ground.until(() => document.querySelector("#any-why").hidden, "no reason is left");
});

test("a cog's Command has a form with its bounds, is sent, and is carried out", async () => {
  const offered = await ground.page.evaluate(() =>
    [...document.querySelectorAll("#any-names option")].map((each) => each.value),
  );
  assert.ok(offered.includes("tow.let_out"), String(offered));
  await ground.page.fill("#any-name", "tow.let_out");
  await ground.page.fill("#any-field-0", "41");
  assert.equal(await ground.attribute("#any-field-0", "aria-invalid"), "true");
  await ground.page.click("#any-send");
  assert.equal(await ground.page.isVisible("dialog#confirm"), false);
  await ground.page.fill("#any-field-0", "12.5");
  await ground.page.selectOption("#any-field-1", { label: "right" });
  const answer = await ground.answerTo(() => ground.press("#any-send"));
  assert.equal(answer.outcome, "ack", JSON.stringify(answer));
  assert.equal(await ground.attribute("#any-note", "data-code"), "ack");
  await shows("tow.length", "12.5");
  await shows("tow.side", '"right"');
});

test("an application's own Command, which no ground knows, is sent by its name", async () => {
  await ground.page.fill("#any-name", "extended.hook");
  await ground.page.fill("#any-json", "[1]");
  await ground.page.click("#any-send");
  assert.equal(await ground.attribute("#any-json", "aria-invalid"), "true");
  await ground.page.fill("#any-json", '{"opening": 30}');
  const answer = await ground.answerTo(async () => {
    await ground.page.click("#any-send");
    assert.equal(await ground.attribute("#confirm-yes", "class"), "danger");
    await ground.page.click("#confirm-yes");
  });
  assert.equal(answer.outcome, "ack", JSON.stringify(answer));
  await shows("hook.opening", "30");
});

test("a refusal of the aircraft is shown with its reason", async () => {
  await ground.page.fill("#any-json", '{"opening": 13}');
  const refused = await ground.answerTo(() => ground.press("#any-send"));
  assert.equal(refused.outcome, "nack");
  assert.match(await ground.attribute("#any-note", "data-code"), /^nack /);
  await ground.page.fill("#any-json", '{"opening": 91}');
  const invalid = await ground.answerTo(() => ground.press("#any-send"));
  assert.equal(invalid.code, "invalid");
});

test("arming is not offered past its held button", async () => {
  await ground.page.fill("#any-name", "up.arm");
  // Control and the role of a pilot are there: it is this alone that keeps it back.
  await ground.reason("#any-why", "held_only");
  assert.equal(await ground.page.isDisabled("#any-send"), true);
});

test("a number is drawn in a separate chart, which a reload remembers", async () => {
  await ground.page.click('[aria-label="Chart hook.opening"]');
  await ground.until(() => document.querySelector("#chosen-chart canvas") !== null, "the chart");
  await ground.page.reload();
  await ground.isLive();
  await ground.until(
    () => document.querySelector("#chosen-chart")?.textContent.includes("hook.openingis 30"),
    "the chart after a reload",
  );
  await ground.page.click("#chosen-chart-close");
  assert.equal(await ground.page.isVisible("#chosen-chart"), false);
});

test("both panels, open, are usable by everybody", async () => {
  await ground.page.click("#telemetry > summary");
  await ground.page.click("#any-command > summary");
  await ground.page.fill("#any-name", "tow.let_out");
  await shows("hook.opening", "30");
  assert.deepEqual(await seriousFaults(ground.page), []);
});

test("a daemon that stands still leaves nothing in the list that looks new", async () => {
  await shows("hook.opening", "30");
  process.kill(flight.daemon.pid, "SIGSTOP");
  await ground.until(
    () => document.querySelector('[data-key="hook.opening"]').dataset.freshness === "stale",
    "a stale value",
  );
  process.kill(flight.daemon.pid, "SIGCONT");
  await ground.until(
    () => document.querySelector('[data-key="hook.opening"]').dataset.freshness === "live",
    "a live value",
  );
});

test("closed again, the list is empty and costs nothing", async () => {
  await ground.page.click("#telemetry > summary");
  await ground.until(() => document.querySelector("#telemetry-list li") === null, "an empty list");
});

test("the page has done nothing that it may not", () => ground.assertClean());

// Several aircraft, old readings, alarms, and who may only watch: what a page makes of what it hears.
import assert from "node:assert/strict";
import { afterEach, before, test } from "node:test";

import { FakeFlight } from "./support/fake_flight.mjs";
import { GroundPage } from "./support/ground_page.mjs";
import { browser, stopAfter } from "./support/setup.mjs";

const AGES = { orientation: 12, rx: 20, servo: 20, location: 600, altitude: 30, heading: 40, battery: 20000 };
let flight;

before(async () => {
  const serve = ["--aircraft", "glider-1", "--aircraft", "glider-2"];
  flight = stopAfter(await FakeFlight.start({ hello: "UP1 aircraft=glider-1", serve }));
});

afterEach(() => GroundPage.closeAll());

/** The displayed values of telemetry keys with that prefix. */
async function shown(ground, start) {
  return (await ground.values()).filter(({ key }) => key.startsWith(start));
}

test("a stale reading is greyed out, while the others are live", async () => {
  const ground = await (await GroundPage.open(browser, flight.address)).isLive();
  flight.tell({ data: { age_ms: { ...AGES, orientation: 5000 } } });
  const isStale = (start) =>
    [...document.querySelectorAll(`[data-key^="${start}"]`)].every(
      (each) => each.dataset.freshness === "stale",
    );
  await ground.until(isStale, "the old attitude", "orientation.");
  assert.ok((await shown(ground, "orientation.")).length > 0);
  for (const { key, freshness } of await shown(ground, "altitude")) {
    assert.equal(freshness, "live", key);
  }
  assert.equal(await ground.attribute('[data-key="age_ms.flight"]', "data-freshness"), "none", "its age was never told");
  assert.equal(await ground.attribute("html", "data-aircraft-state"), "live");
  flight.tell({ data: { orientation: null, age_ms: { ...AGES, orientation: null } } });
  await ground.until(
    () => [...document.querySelectorAll('[data-key^="orientation."]')].every((each) => each.textContent === "--"),
    "no attitude",
  );
  flight.tell({ data: {} });
  await ground.until(
    () => document.querySelector('[data-key="orientation.roll"]').dataset.freshness === "live",
    "the attitude again",
  );
  ground.assertClean();
});

test("a silent second aircraft shows nothing of the first", async () => {
  const ground = await (await GroundPage.open(browser, flight.address)).isLive();
  const names = await ground.page.$$eval("#aircraft-select option", (all) => all.map((each) => each.textContent));
  assert.deepEqual(names, ["glider-1", "glider-2"]);
  await ground.page.selectOption("#aircraft-select", "glider-2");
  await ground.until(() => document.documentElement.dataset.aircraftState === "none", "nothing heard");
  const told = (await ground.values()).filter(({ key, freshness }) => freshness !== "none" && !/^(link|fleet)\./.test(key));
  assert.deepEqual(told, []);
  assert.equal(await ground.page.isEnabled('[data-mode="FBW"]'), false);
  await ground.until(charted, "charts without the first one's curves", [0, "no data in the last minute"]);
  await ground.page.selectOption("#aircraft-select", "glider-1");
  await ground.isLive();
  ground.assertClean();
});

/** Whether the chart at a place shows that. */
function charted([place, words]) {
  const label = document.querySelectorAll("#charts .chart-canvas")[place]?.getAttribute("aria-label");
  return label?.includes(words);
}

test("an aircraft that is not at the proxy is reported, and takes no Command", async () => {
  const ground = await (await GroundPage.open(browser, flight.address)).isLive();
  assert.equal(await ground.page.$("#aircraft-away"), null);
  await ground.page.selectOption("#aircraft-select", "glider-2");
  await ground.until(() => document.querySelector("#aircraft-away") !== null, "the banner");
  assert.equal(await ground.attribute("#aircraft-away", "data-code"), "aircraft_offline");
  assert.equal(await ground.page.isVisible("#aircraft-away"), true);
  await ground.takeControl();
  await ground.reason("#commands-why", "aircraft_offline");
  for (const selector of ['[data-mode="FBW"]', "#telemetry-period-send", "#arm-button", "#mark-send"]) {
    assert.equal(await ground.page.isDisabled(selector), true, selector);
  }
  await ground.page.selectOption("#aircraft-select", "glider-1");
  await ground.until(() => document.querySelector("#aircraft-away") === null, "no banner");
  ground.assertClean();
});

test("of two aircraft, each has its charts, track, answers and inputs", async () => {
  const other = await flight.another("UP1 aircraft=glider-2");
  const place = { latitude: 51, longitude: 9, altitude: 900 };
  const orientation = { roll: -77, pitch: 5, yaw: 0 };
  other.write(`${JSON.stringify({ data: { orientation, location: place, altitude: 900, age_ms: AGES } })}\n`);
  const ground = await (await GroundPage.open(browser, flight.address)).isLive();
  await ground.until(charted, "the first one's roll", [0, "now"]);
  await ground.takeControl();
  const answer = await ground.answerTo(() => ground.press('[data-mode="FBW"]'));
  assert.equal(answer.outcome, "ack", JSON.stringify(answer));
  await ground.page.fill("#speak", "meant for the first");
  await ground.page.selectOption("#aircraft-select", "glider-2");
  await ground.until(charted, "the second one's roll alone", [0, "now -77°, between -77° and -77°"]);
  await ground.until(charted, "its altitude alone", [2, "between 900 m and 900 m"]);
  assert.equal(await ground.text("#last-answer"), "");
  assert.equal(await ground.page.inputValue("#speak"), "");
  assert.equal(await ground.attribute("#panel-map", "data-latitude"), "51");
  await ground.page.selectOption("#aircraft-select", "glider-1");
  await ground.until(() => document.querySelector("#panel-map").dataset.latitude !== "51", "the first one's place");
  ground.assertClean();
});

test("a failsafe raises an alarm and an event, until it is over", async () => {
  const ground = await (await GroundPage.open(browser, flight.address)).isLive();
  const arduino = { connected: true, framing: "checked", switch: "high", failsafe: true };
  flight.tell({ data: { arduino } });
  await ground.until(() => document.querySelector('#alarms [role="alert"]'), "the alarm");
  assert.equal(await ground.attribute('#alarms [role="alert"]', "data-kind"), "failsafe");
  assert.equal(await ground.attribute("#bar-alarm", "data-level"), "alarm");
  await ground.until(
    () => document.querySelector('#events li[data-code="failsafe"]') !== null,
    "the event",
  );
  flight.tell({ data: {} });
  await ground.until(() => document.querySelector('#alarms [role="alert"]') === null, "its end");
  ground.assertClean();
});

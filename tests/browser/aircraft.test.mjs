// Several aircraft, old readings, alarms, and who may only watch: what a page makes of what it hears.
import assert from "node:assert/strict";
import { after, afterEach, before, test } from "node:test";

import { startBrowser } from "./support/browser.mjs";
import { FakeFlight } from "./support/fake_flight.mjs";
import { GroundPage } from "./support/ground_page.mjs";
import { startProgram } from "./support/program.mjs";

const AGES = { orientation: 12, rx: 20, servo: 20, location: 600, altitude: 30, heading: 40, battery: 20000 };
let browser;
let flight;

before(async () => {
  browser = await startBrowser();
  const serve = ["--aircraft", "glider-1", "--aircraft", "glider-2"];
  flight = await FakeFlight.start({ hello: "UP1 aircraft=glider-1", serve });
});

after(async () => {
  await browser?.close();
  await flight?.stop();
});

afterEach(() => GroundPage.closeAll());

/** What is shown of keys of the telemetry that begin so. */
async function shown(ground, start) {
  return (await ground.values()).filter(({ key }) => key.startsWith(start));
}

test("a reading that is old on board looks old at once, while the others are of now", async () => {
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

test("another aircraft is chosen, and one that says nothing shows nothing of the first", async () => {
  const ground = await (await GroundPage.open(browser, flight.address)).isLive();
  const names = await ground.page.$$eval("#aircraft-select option", (all) => all.map((each) => each.textContent));
  assert.deepEqual(names, ["glider-1", "glider-2"]);
  await ground.page.selectOption("#aircraft-select", "glider-2");
  await ground.until(() => document.documentElement.dataset.aircraftState === "none", "nothing heard");
  const told = (await ground.values()).filter(({ key, freshness }) => freshness !== "none" && !key.startsWith("link."));
  assert.deepEqual(told, []);
  assert.equal(await ground.page.isEnabled('[data-mode="FBW"]'), false);
  await ground.page.selectOption("#aircraft-select", "glider-1");
  await ground.isLive();
  ground.assertClean();
});

test("a failsafe raises an alarm and tells it among the events, until it is over", async () => {
  const ground = await (await GroundPage.open(browser, flight.address)).isLive();
  const arduino = { connected: true, framing: "checked", switch: "high", failsafe: true };
  flight.tell({ data: { arduino } });
  await ground.until(() => document.querySelector('#alarms [role="alert"]'), "the alarm");
  assert.match(await ground.text('#alarms [role="alert"]'), /failsafe/i);
  assert.equal(await ground.attribute("#bar-alarm", "data-level"), "alarm");
  await ground.until(
    () => [...document.querySelectorAll("#events li")].some((each) => /failsafe/i.test(each.textContent)),
    "the event",
  );
  flight.tell({ data: {} });
  await ground.until(() => document.querySelector('#alarms [role="alert"]') === null, "its end");
  ground.assertClean();
});

test("a server for spectators lets nobody command", async () => {
  const words = ["--port", flight.groundPort, "serve", "--listen", "127.0.0.1:0", "--watch-only"];
  const server = startProgram("up-ground", [...words, "--aircraft", "glider-1"]);
  try {
    const [, address] = await server.line(/(http:\/\/\S+)/);
    const ground = await (await GroundPage.open(browser, address)).isLive();
    await ground.until(() => /may only watch/.test(document.querySelector("#control-holder")?.textContent), "why");
    assert.equal(await ground.page.isVisible("#control-request"), false);
    await ground.until(() => document.querySelector("#arm-button")?.disabled, "no arming");
    ground.assertClean();
    await ground.close();
  } finally {
    await server.stop();
  }
});

// A field without any network: everything comes from the machine itself.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { afterEach, before, test } from "node:test";

import { GroundPage } from "./support/ground_page.mjs";
import { browser, stopAfter } from "./support/setup.mjs";
import { startShowcase } from "./support/showcase.mjs";

let showcase;

before(async () => {
  showcase = stopAfter(await startShowcase());
});

afterEach(() => GroundPage.closeAll());

test("these tests run without a network", { skip: !process.env.UP_ALONE && "needs root" }, () => {
  const [, ...routes] = readFileSync("/proc/self/net/route", "utf8").trim().split("\n");
  assert.deepEqual(routes, []);
});

test("map and charts are drawn, and not one request leaves the server of the page", async () => {
  const ground = await (await GroundPage.open(browser, showcase.address)).isLive();
  await ground.until(() => document.querySelector("#panel-map .leaflet-container, #panel-map.leaflet-container"), "the map");
  await ground.until(() => document.querySelector("#panel-charts canvas"), "the charts");
  await ground.until(() => document.querySelector("#panel-map").dataset.latitude, "the aircraft on the map");
  const map = await ground.page.locator("#panel-map").boundingBox();
  await ground.page.mouse.move(map.x + map.width / 2, map.y + map.height / 2);
  await ground.page.mouse.wheel(0, -400);
  await ground.page.mouse.down();
  await ground.page.mouse.move(map.x + map.width / 3, map.y + map.height / 3, { steps: 5 });
  await ground.page.mouse.up();
  await ground.page.click("#theme-button");
  await ground.page.click("#sound-button");
  const before = (await ground.messages("frame")).length;
  await ground.until(
    (count) => window.testMessages.filter(({ message }) => message.type === "frame").length > count,
    "frames",
    before + 20,
  );
  const { host } = new URL(showcase.address);
  const hosts = ground.seen.requests.filter((url) => !/^(data|blob):/.test(url)).map((url) => new URL(url).host);
  assert.ok(hosts.length > 30, `${hosts.length} requests`);
  assert.deepEqual([...new Set(hosts)], [host]);
  assert.equal(await ground.page.isVisible("#missing"), false);
  ground.assertClean();
});

test("without Leaflet and uPlot the instruments work, and the page reports them", async () => {
  const ground = await GroundPage.open(browser, "about:blank");
  await ground.page.route("**/vendor/**", (route) => route.fulfill({ status: 404 }));
  await ground.page.goto(showcase.address);
  await ground.isLive();
  await ground.until(() => {
    const place = document.querySelector("#missing");
    const missing = [...place.children].map((each) => each.dataset.code);
    return !place.hidden && missing.includes("leaflet") && missing.includes("uplot");
  }, "what is missing");
  const shown = await ground.values();
  for (const key of ["altitude", "flight_mode"]) {
    const found = shown.find((each) => each.key === key);
    assert.equal(found?.freshness, "live", key);
    assert.notEqual(found.text, "--", key);
  }
  assert.ok(Number.isFinite(Number(await ground.attribute("#horizon-ball", "data-roll"))));
  assert.deepEqual(ground.seen.violations, []);
});

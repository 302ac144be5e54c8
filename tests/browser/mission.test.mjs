// A mission and a fence: drawn on the map, changed in the table, undone, opened, saved, uploaded, started.
import assert from "node:assert/strict";
import { afterEach, before, test } from "node:test";

import { seriousFaults } from "./support/accessibility.mjs";
import { PHONE } from "./support/browser.mjs";
import { FakeFlight } from "./support/fake_flight.mjs";
import { GroundPage } from "./support/ground_page.mjs";
import { navigating } from "./support/navigating.mjs";
import { browser, stopAfter } from "./support/setup.mjs";

let flight;

before(async () => {
  flight = stopAfter(await FakeFlight.start({ hello: "UP1 aircraft=glider-1", serve: ["--aircraft", "glider-1"] }));
  flight.tell({ data: navigating({ modes: { ...navigating().flight_control.modes, MISSION: null } }) });
});

afterEach(() => GroundPage.closeAll());

/** A page that draws, and where on it the map is. */
async function drawing(options) {
  const ground = await (await GroundPage.open(browser, flight.address, options)).isLive();
  await ground.show("#panel-map");
  await ground.page.click("#map-draw");
  const { x, y, width, height } = await ground.page.locator(".map-canvas").boundingBox();
  return { ground, at: (right, down) => [x + width * right, y + height * down] };
}

/** The drawn plan, as the page keeps it. */
function kept(ground, name = "mission") {
  return ground.page.evaluate((name) => JSON.parse(sessionStorage.getItem("up.mission")).drawn[name], name);
}

async function drag(page, selector, [x, y]) {
  await page.hover(selector);
  await page.mouse.down();
  await page.mouse.move(x, y, { steps: 4 });
  await page.mouse.up();
}

/** Touch the map until something is drawn. */
async function tap(ground, place) {
  const drawn = () => ground.page.evaluate(() => sessionStorage.getItem("up.mission"));
  const before = await drawn();
  await ground.tapUntil(".map-canvas", place, async () => (await drawn()) !== before);
}

const item = (number) => `.plan-point[data-point="mission ${number - 1}"]`;

test("waypoints are drawn, dragged, inserted, undone, and are there after a reload", async () => {
  const { ground, at } = await drawing();
  const { page } = ground;
  for (const place of [at(0.25, 0.4), at(0.6, 0.3), at(0.7, 0.6)]) {
    await page.mouse.click(...place);
  }
  const drawn = await kept(ground);
  assert.deepEqual(drawn.map(({ kind, altitude }) => [kind, altitude]), [["waypoint", 80], ["waypoint", 80], ["waypoint", 80]]);
  assert.ok(drawn[0].longitude < drawn[1].longitude && drawn[2].latitude < drawn[1].latitude, JSON.stringify(drawn));
  await drag(page, item(2), at(0.5, 0.2));
  const [first, moved, third] = await kept(ground);
  assert.ok(moved.latitude > drawn[1].latitude && moved.longitude < drawn[1].longitude, JSON.stringify(moved));
  assert.deepEqual([first, third], [drawn[0], drawn[2]]);
  await drag(page, '.plan-point[data-point="mission + 2"]', at(0.8, 0.4));
  assert.equal((await kept(ground)).length, 4);
  assert.equal(await page.locator('#plan-table [aria-pressed="true"]').textContent(), "3");
  await page.keyboard.press("Control+z");
  await page.keyboard.press("Control+z");
  assert.deepEqual(await kept(ground), drawn);
  await page.keyboard.press("Control+Shift+z");
  assert.deepEqual((await kept(ground))[1], moved);
  await page.reload();
  await ground.isLive();
  await ground.until(() => document.querySelectorAll(".plan-point").length === 3, "the kept mission");
  ground.assertClean();
});

test("without a mouse a waypoint is added, moved, made another kind, raised and deleted", async () => {
  const { ground } = await drawing();
  const { page } = ground;
  await page.focus(".map-canvas");
  await page.keyboard.press("Enter");
  const [before] = await kept(ground);
  await page.focus(item(1));
  await page.keyboard.press("ArrowUp");
  await page.keyboard.press("ArrowUp");
  const [after] = await kept(ground);
  assert.ok(after.latitude > before.latitude && after.longitude === before.longitude, "it moved north");
  await page.selectOption("#plan-kind", "loiter_time");
  await page.fill("#plan-time", "90");
  await page.fill("#plan-altitude", "");
  await page.press("#plan-altitude", "Tab");
  assert.equal(await ground.attribute("#plan-altitude", "aria-invalid"), "true");
  await page.fill("#plan-height", "120");
  await page.press("#plan-height", "Enter");
  const [{ kind, time, altitude }] = await kept(ground);
  assert.deepEqual([kind, time, altitude], ["loiter_time", 90, 120]);
  await page.focus(item(1));
  await page.keyboard.press("Delete");
  assert.deepEqual(await kept(ground), []);
  ground.assertClean();
});

test("with a finger an area of the fence is drawn, changed and given a hole; nothing is too small", async () => {
  const { ground } = await drawing(PHONE);
  const { page } = ground;
  await page.selectOption("#map-tool", "fence area");
  for (const place of [[0.2, 0.3], [0.8, 0.3], [0.8, 0.7]]) {
    await tap(ground, place);
  }
  await page.selectOption("#map-tool", "fence circle");
  await tap(ground, [0.6, 0.45]);
  await page.locator("#plan-inside").setChecked(false);
  const [area, circle] = await kept(ground, "fence");
  assert.equal(area.corners.length, 3);
  assert.deepEqual([circle.inside, circle.radius], [false, 200]);
  const small = await page.$$eval("#panel-mission button, #panel-mission select, .map-drawing > *, .plan-point", (all) =>
    all.map((each) => [each.id || each.className, each.getBoundingClientRect()])
      .filter(([, { width, height }]) => width > 0 && (width < 44 || height < 44)).map(([name]) => name));
  assert.deepEqual(small, []);
  assert.deepEqual(await seriousFaults(page), []);
  const { scrollWidth, clientWidth } = await page.evaluate(() => document.documentElement);
  assert.ok(!(scrollWidth > clientWidth));
  ground.assertClean();
});

test("a refused mission marks its items; a changed one is checked, used, read back, flown and saved", async () => {
  flight.tell({ plans: [50.0755, 14.4378, 312] });
  const { ground, at } = await drawing();
  const { page } = ground;
  const newest = () => window.testMessages.findLast(({ message }) => message.type === "frame").message.data;
  await ground.until(`(${newest})().mission`, "an aircraft that keeps plans");
  await ground.reason("#mission-why", "control_free");
  assert.equal(await page.isDisabled("#plan-upload"), true);
  await ground.takeControl();
  for (const place of [at(0.25, 0.4), at(0.6, 0.3), at(0.7, 0.6)]) {
    await page.mouse.click(...place);
  }
  await page.click('#plan-table tr[data-item="2"] button');
  await page.fill("#plan-latitude", "51");
  await page.press("#plan-latitude", "Tab");
  await page.click("#plan-upload");
  await page.keyboard.press("Escape");
  assert.equal((await ground.messages("plan.answer")).length, 0, "nothing without a yes");
  const answers = () => window.testMessages.filter(({ message }) => message.type === "plan.answer");
  /** Upload, again where the busy page was late. */
  const upload = async () => {
    for (;;) {
      const before = await page.evaluate(`(${answers})().length`);
      await ground.press("#plan-upload");
      const answer = await ground.until(`(${answers})()[${before}]?.message`, "an answer");
      await ground.reason("#plan-note", answer.code ? `${answer.outcome} ${answer.code}` : answer.outcome);
      if (answer.code !== "stale") {
        return [answer.outcome, answer.code || "", answer.detail || ""];
      }
    }
  };
  assert.deepEqual(await upload(), ["nack", "refused", "plan_invalid"]);
  const marked = () => page.$$eval("#plan-table .plan-problems li", (all) => all.map((each) => [each.dataset.of, each.dataset.code]));
  assert.deepEqual(await marked(), [["2", "too_far"]]);
  assert.match(await ground.attribute(item(2), "class"), /is-bad/);
  await page.click("#map-undo");
  assert.deepEqual(await marked(), []);
  assert.equal(await page.isDisabled("#mission-from"), true, "the aircraft has no such item");
  assert.deepEqual(await upload(), ["ack", "", ""]);
  assert.match(await ground.text("#plan-note"), /mission with 3 items, read back/);
  await ground.until(() => document.querySelector("#mission-state").dataset.code === "same", "the aircraft's mission");
  await ground.until(() => document.querySelector("#plan-table tr[data-flown=true]")?.dataset.item === "1", "the item flown");
  assert.equal(await page.locator(".plan-point.is-flown").textContent(), "1");
  await page.click('#plan-table tr[data-item="3"] button');
  for (const button of ["#mission-from", "#mission-start"]) {
    const answer = await ground.answerTo(() => ground.press(button));
    assert.equal(answer.outcome, "ack", button);
  }
  await ground.until(() => document.querySelector(".plan-point.is-flown")?.textContent === "3", "item 3");
  const drawn = await kept(ground);
  const saved = page.waitForEvent("download");
  await page.click("#plan-save");
  const file = await (await saved).path();
  await page.click("#plan-clear");
  await ground.until(() => document.querySelector("#mission-state").dataset.code === "undrawn", "a mission that is not drawn");
  await page.setInputFiles("#plan-file", { name: "m.plan", mimeType: "text/plain", buffer: Buffer.from("{") });
  await ground.reason("#plan-note", "refused plan_invalid");
  assert.deepEqual(await kept(ground), []);
  await page.setInputFiles("#plan-file", file);
  await ground.until(() => document.querySelector("#mission-state").dataset.code === "same", "the saved mission");
  await page.click("#plan-clear");
  await ground.press("#plan-download");
  await ground.until(() => document.querySelector("#mission-state").dataset.code === "same", "the mission downloaded");
  assert.deepEqual(await kept(ground), drawn);
  ground.assertClean();
});

// Flight modes by the aircraft's lists, navigation in figures and on the map, and what a click on the map sends.
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
});

afterEach(() => GroundPage.closeAll());

/** Wait until the page is live and shows the modes that the aircraft reported. */
async function hasModes(ground) {
  await ground.isLive();
  await ground.until(() => document.querySelector('[data-mode="RETURN"]'), "the modes of the aircraft");
}

/** A page with control that shows such telemetry. */
async function openWith(data, options) {
  flight.tell({ data });
  const ground = await GroundPage.open(browser, flight.address, options);
  await hasModes(ground);
  await ground.takeControl();
  await ground.page.evaluate(() => {
    window.testSent = [];
    const socket = window.testSockets.at(-1);
    const send = socket.send.bind(socket);
    socket.send = (text) => {
      const message = JSON.parse(text);
      if (message.type === "command") {
        window.testSent.push([message.name, message.data]);
      }
      send(text);
    };
  });
  return ground;
}

const sent = (ground) => ground.page.evaluate(() => window.testSent);

/** Wait for the answers of so many Commands; returns their data by their names. */
async function sentAfter(ground, count) {
  await ground.until((count) => window.testSent.length >= count, `${count} Commands`, count);
  return Object.fromEntries(await sent(ground));
}

test("the modes are those of the aircraft; one that is not offered is disabled with its reason", async () => {
  const ground = await openWith(navigating());
  const states = await ground.page.$$eval("#flight-modes [data-mode]", (all) =>
    Object.fromEntries(all.map((each) => [each.dataset.mode, [each.dataset.code, each.disabled]])),
  );
  assert.deepEqual(states, {
    RETURN: ["", false], LOITER: ["", false], AUTO: ["", false], CRUISE: ["", false], CIRCLE: ["", false],
    GUIDED: ["no_target", true], GLIDE: ["altitude", true], FBW: ["", false], RATE: ["", false],
  });
  assert.equal(await ground.attribute('[data-mode="LOITER"]', "aria-pressed"), "true");
  const cut = await ground.page.$$eval("#flight-modes [data-mode]", (all) =>
    all.filter((each) => each.scrollHeight > each.clientHeight || each.scrollWidth > each.clientWidth).map((each) => each.dataset.mode));
  assert.deepEqual(cut, []);
  assert.equal(await ground.text("#bar-mode"), "LOITER");
  assert.match(await ground.text('[data-mode="GLIDE"] small'), /altitude .*too old/);
  const guided = await ground.text('[data-mode="GUIDED"] small');
  assert.match(guided, /target/);
  const answer = await ground.answerTo(() => ground.press('[data-mode="RETURN"]'));
  assert.equal(answer.outcome, "ack", JSON.stringify(answer));
  assert.deepEqual(await sent(ground), [["up.flight_mode.set", { mode: "RETURN" }]]);
  flight.tell({ data: navigating({ flight_control: { modes: { AUTO: "rx", FENCED: null } } }) });
  await ground.until(() => document.querySelector('[data-mode="FENCED"]')?.disabled === false, "a mode of a plug-in");
  assert.deepEqual(
    await ground.page.$$eval("#flight-modes [data-mode][disabled]", (all) => all.map((each) => each.dataset.code)),
    ["mode_unknown", "mode_unknown", "rx"],
  );
  ground.assertClean();
});

test("satellites are shown where the receiver reports them", async () => {
  const ground = await openWith(navigating());
  await ground.until(() => document.querySelector('[data-key="location.satellites"]').textContent === "9", "satellites");
  assert.equal(await ground.page.isVisible('[data-key="location.satellites"]'), true);
  flight.tell({ data: { ...navigating(), location: { latitude: 50.07805, longitude: 14.44205, altitude: 401 } } });
  await ground.until(() => document.querySelector('[data-key="location.satellites"]').closest("[hidden]") !== null, "none");
});

test("a fallback and the cause of a failsafe are shown until they are over", async () => {
  const ground = await openWith(navigating());
  flight.tell({ data: navigating({ mode: "CIRCLE", selected: "LOITER", fallback: "navigation" }) });
  await ground.until(() => document.querySelector("#fallback")?.dataset.code === "navigation", "the banner");
  assert.match(await ground.text("#fallback"), /^CIRCLE replaces LOITER/);
  await ground.until(() => document.querySelector('#events li[data-code="fallback"]') !== null, "the event");
  flight.tell({ data: { ...navigating({ mode: "RETURN", selected: "RETURN" }), failsafe: { active: [], cause: "fence" } } });
  await ground.until(() => document.querySelector("#failsafe")?.dataset.code === "fence", "the failsafe");
  assert.match(await ground.text("#failsafe"), /RETURN/);
  await ground.until(() => document.querySelector("#fallback") === null, "the end of the fallback");
  flight.tell({ data: navigating() });
  await ground.until(() => document.querySelector("#failsafe") === null, "its end");
});

test("a click on the map sends a target above home, then selects GUIDED", async () => {
  const ground = await openWith(navigating());
  await ground.until(() => document.querySelector(".map-target") !== null, "the circle of LOITER");
  for (const name of ["uncertainty", "fix", "target-point"]) {
    assert.equal(await ground.page.locator(`.map-${name}`).count(), 1, name);
  }
  const { x, y, width, height } = await ground.page.locator(".map-canvas").boundingBox();
  await ground.page.mouse.click(x + width / 4, y + height / 2);
  await ground.page.fill("#map-fly", "-1");
  await ground.page.click("#map-fly-send");
  assert.equal(await ground.attribute("#map-fly", "aria-invalid"), "true");
  await ground.page.fill("#map-fly", "75");
  await ground.press("#map-fly-send");
  const { "up.navigation.target": target, "up.flight_mode.set": mode } = await sentAfter(ground, 2);
  const { latitude, longitude } = navigating().navigation;
  assert.ok(target.longitude < longitude && Math.abs(target.latitude - latitude) < 0.002, JSON.stringify(target));
  assert.equal(target.height, 75);
  assert.deepEqual(mode, { mode: "GUIDED" });
  ground.assertClean();
});

test("a refused target does not select GUIDED; without home a height is above sea level", async () => {
  const home = { latitude: null, longitude: null, altitude: null, distance: null, bearing: null, time_s: null };
  const { modes } = navigating().flight_control;
  const ground = await openWith({ ...navigating({ modes: { ...modes, RETURN: "no_home" } }), home });
  const button = '[data-mode="RETURN"]';
  assert.deepEqual([await ground.attribute(button, "data-code"), await ground.page.isDisabled(button)], ["no_home", true]);
  assert.match(await ground.text(`${button} small`), /home is not set/);
  flight.tell({ nack: "too far" });
  await ground.page.focus(".map-canvas");
  await ground.page.keyboard.press("Enter");
  assert.equal(await ground.page.inputValue("#map-fly"), "402");
  const answer = await ground.answerTo(() => ground.press("#map-fly-send"));
  assert.equal(answer.outcome, "nack");
  const [[name, data], ...more] = await sent(ground);
  assert.deepEqual([name, data.altitude, "height" in data, more], ["up.navigation.target", 402, false, []]);
  ground.assertClean();
});

test("home is set where a finger touched the map; nothing without control", async () => {
  const ground = await openWith(navigating(), PHONE);
  await ground.show("#panel-map");
  await ground.tapUntil(".map-canvas", [0.5, 0.75], () => ground.page.isVisible(".map-actions"));
  assert.deepEqual(await seriousFaults(ground.page), []);
  await ground.press("#map-home-set");
  const { "up.home.set": home } = await sentAfter(ground, 1);
  assert.deepEqual(Object.keys(home), ["latitude", "longitude"]);
  assert.ok(home.latitude < navigating().navigation.latitude);
  await ground.leaveControl();
  await ground.reason("#map-why", "control_free");
  assert.equal(await ground.page.isDisabled("#map-home-set"), true);
  await ground.page.click("#map-close");
  assert.equal(await ground.page.isVisible(".map-actions"), false);
  ground.assertClean();
});

test("the flying view has attitude, map, RETURN and every mode on a small screen, without scrolling", async () => {
  const small = { viewport: { width: 800, height: 480 }, hasTouch: true };
  const ground = await openWith(navigating(), small);
  const outside = () =>
    ground.page.evaluate(() => {
      const root = document.scrollingElement;
      const all = ["#horizon", "#panel-map", "#bar-mode", ...["RETURN", "LOITER", "CRUISE", "FBW"].map((mode) => `[data-mode="${mode}"]`)];
      const isInside = ({ top, bottom, left, right, width, height }) =>
        top >= 0 && bottom <= innerHeight + 0.5 && left >= 0 && right <= innerWidth + 0.5 && Math.min(width, height) >= 15;
      const scrolls = root.scrollHeight > innerHeight || root.scrollWidth > innerWidth ? ["scrolls"] : [];
      return [...scrolls, ...all.filter((each) => !isInside(document.querySelector(each).getBoundingClientRect()))];
    });
  assert.deepEqual(await outside(), []);
  const [width, height] = await ground.page.$eval('[data-mode="RETURN"]', (each) => [each.offsetWidth, each.offsetHeight]);
  assert.ok(Math.min(width, height) >= 44, `RETURN: ${width} x ${height}`);
  await ground.press('[data-mode="RETURN"]');
  assert.deepEqual(await sentAfter(ground, 1), { "up.flight_mode.set": { mode: "RETURN" } });
  await ground.page.click("#map-draw");
  const firstItem = '#plan-table tr[data-item="1"]';
  await ground.tapUntil(".map-canvas", [1 / 3, 0.5], () => ground.page.isVisible(firstItem));
  await ground.page.locator(firstItem).hover();
  assert.deepEqual(await outside(), []);
  await ground.page.click("#map-draw");
  assert.equal(await ground.page.isVisible("#panel-mission"), false);
  // The choice lasts; on another screen everything is shown until it is chosen there.
  await ground.press("#view-button");
  await ground.page.reload();
  await hasModes(ground);
  assert.equal(await ground.attribute("html", "data-view"), "all");
  await ground.press("#view-button");
  await ground.page.setViewportSize({ width: 390, height: 844 });
  assert.deepEqual(await outside(), []);
  await ground.page.setViewportSize({ width: 240, height: 400 });
  const wide = await ground.page.$$eval("#bar *, #panels *", (all) =>
    all.filter((each) => each.getBoundingClientRect().right > 240.5).map((each) => each.id || each.textContent),
  );
  assert.deepEqual(wide, []);
  ground.assertClean();
});

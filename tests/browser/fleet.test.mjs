// Several aircraft on one page: the list, the map, alarms of those that are not selected, and whose Command it is.
import assert from "node:assert/strict";
import { afterEach, before, test } from "node:test";

import { seriousFaults } from "./support/accessibility.mjs";
import { PHONE } from "./support/browser.mjs";
import { FakeFlight } from "./support/fake_flight.mjs";
import { GroundPage } from "./support/ground_page.mjs";
import { browser, stopAfter } from "./support/setup.mjs";

const NAMES = ["glider-1", "glider-2", "glider-3"];
const AGES = { orientation: 12, flight: 20, location: 600, heading: 40, navigation: 50 };
const SECOND = {
  armed: true,
  flight_mode: "RATE",
  location: { latitude: 50.0765, longitude: 14.4388, altitude: 330 },
  navigation: { latitude: 50.0765, longitude: 14.4388, height: 82.4, speed: 14.6, heading: 40 },
  age_ms: AGES,
};
let flight;
let second;

before(async () => {
  const serve = NAMES.flatMap((name) => ["--aircraft", name]);
  flight = stopAfter(await FakeFlight.start({ hello: "UP1 aircraft=glider-1", serve }));
  second = await flight.another("UP1 aircraft=glider-2");
  tellSecond({});
});

afterEach(() => GroundPage.closeAll());

function tellSecond(data) {
  second.write(`${JSON.stringify({ data: { ...SECOND, ...data } })}\n`);
}

/** Open the page and wait for the second aircraft's values in the list. */
async function opened(options) {
  const ground = await (await GroundPage.open(browser, flight.address, options)).isLive();
  await rowHas(ground, "glider-2", { link: "live", level: "none" });
  return ground;
}

function rowHas(ground, name, wanted) {
  const has = ([name, wanted]) => {
    const row = document.querySelector(`#fleet-list [data-aircraft="${name}"]`);
    return row !== null && Object.entries(wanted).every(([key, value]) => row.dataset[key] === value);
  };
  return ground.until(has, `${name} with ${JSON.stringify(wanted)}`, [name, wanted]);
}

/** Wait until the list marks that aircraft, and no other one. */
function isSelected(ground, name) {
  const isMarked = (name) => {
    const marked = [...document.querySelectorAll("#fleet-list [aria-current='true']")];
    return marked.map((each) => each.dataset.aircraft).join() === name;
  };
  return ground.until(isMarked, `${name} selected`, name);
}

function valuesOf(ground, name) {
  const values = `#fleet-list [data-aircraft="${name}"] [data-key]`;
  return ground.page.$$eval(values, (all) =>
    Object.fromEntries(all.map(({ dataset, textContent }) => [dataset.key, [textContent, dataset.freshness]])),
  );
}

test("each aircraft has its row and its place on the map", async () => {
  const ground = await opened();
  await rowHas(ground, "glider-3", { link: "offline" });
  await ground.until(() => document.querySelector('[data-aircraft="glider-2"] [data-key="fleet.age"]')?.dataset.freshness === "live", "a fresh row");
  const { "fleet.age": _age, ...values } = await valuesOf(ground, "glider-2");
  assert.deepEqual(values, {
    "fleet.flight_mode": ["RATE", "live"],
    "fleet.armed": ["ARMED", "live"],
    "fleet.navigation.height": ["82 m", "live"],
    "fleet.navigation.speed": ["15 m/s", "live"],
    "fleet.arduino.flight_battery_v": ["--", "none"],
  });
  const unknown = Object.values(await valuesOf(ground, "glider-3"));
  assert.deepEqual([...new Set(unknown.map(([, freshness]) => freshness))], ["none"]);
  await ground.until(() => document.querySelector(".fleet-marker"), "a marker");
  const markers = await ground.page.$$eval(".fleet-marker", (all) => all.map((each) => each.dataset.aircraft));
  assert.deepEqual(markers, ["glider-2"]);
  tellSecond({ age_ms: { ...AGES, navigation: 9000 } });
  const isStale = () => document.querySelector('[data-aircraft="glider-2"] [data-key="fleet.navigation.height"]').dataset.freshness === "stale";
  await ground.until(isStale, "an old height");
  assert.equal((await valuesOf(ground, "glider-2"))["fleet.armed"][1], "live");
  tellSecond({});
  const frames = await ground.messages("frame");
  assert.deepEqual([...new Set(frames.map(({ message }) => message.aircraft))], ["glider-1"]);
  ground.assertClean();
});

test("a click, Enter and a marker select, and control stays with its aircraft", async () => {
  const ground = await opened();
  await ground.takeControl();
  await ground.page.click('#fleet-list [data-aircraft="glider-2"] .fleet-height');
  await isSelected(ground, "glider-2");
  await ground.until(() => document.querySelector("#panel-map").dataset.latitude === "50.0765", "its own place");
  await ground.reason("#commands-why", "control_free");
  await rowHas(ground, "glider-1", { holder: "you" });
  await rowHas(ground, "glider-2", { holder: "nobody" });
  await ground.page.focus('#fleet-list [data-aircraft="glider-1"] button');
  await ground.page.keyboard.press("Enter");
  await isSelected(ground, "glider-1");
  await ground.isLive();
  assert.equal((await ground.answerTo(() => ground.press('[data-mode="FBW"]'))).outcome, "ack");
  await ground.until(() => document.querySelector('.fleet-marker[data-aircraft="glider-2"]'), "the marker");
  await ground.press("#panel-map .map-tools button[aria-label^='All']");
  await ground.page.click('.fleet-marker[data-aircraft="glider-2"]');
  await isSelected(ground, "glider-2");
  assert.equal(await ground.page.isVisible(".map-actions"), false);
  await ground.page.click('#fleet-list [data-aircraft="glider-1"]');
  await ground.untilHolder("you");
  ground.assertClean();
});

/** Keep what the page sends, and select an aircraft just before an answer arrives. */
function selectBeforeAnswer(name) {
  const socket = window.testSockets.at(-1);
  const { onmessage, send } = socket;
  window.testSent = [];
  socket.send = (text) => {
    const { type, name, aircraft } = JSON.parse(text);
    if (type === "command") {
      window.testSent.push([name, aircraft]);
    }
    send.call(socket, text);
  };
  socket.onmessage = (event) => {
    if (JSON.parse(event.data).type === "answer") {
      document.querySelector(`#fleet-list [data-aircraft="${name}"] button`).click();
    }
    onmessage(event);
  };
}

test("a Command that was begun for one aircraft is never sent to the next one", async () => {
  const ground = await opened();
  const select = (name) => ground.page.evaluate((name) => document.querySelector(`#fleet-list [data-aircraft="${name}"] button`).click(), name);
  await ground.takeControl();
  await select("glider-2");
  await ground.isLive();
  await ground.takeControl();
  tellSecond({ armed: false });
  await select("glider-1");
  await ground.isLive();
  const isOffered = () => !document.querySelector("#arm-button").disabled;
  await ground.until(isOffered, "arming");
  const mouse = ground.mouse("#arm-button");
  await mouse.down();
  // As a second finger does.
  await select("glider-2");
  await ground.until(() => document.querySelector("#arm-button").dataset.press !== "pressed", "the end of the press");
  await mouse.up();
  assert.equal(await ground.attribute("#arming-note", "data-code"), "other_aircraft");
  await select("glider-1");
  await ground.isLive();
  await ground.page.focus(".map-canvas");
  await ground.page.keyboard.press("Enter");
  await ground.until(() => !document.querySelector(".map-actions").hidden, "the offers of a place");
  await select("glider-2");
  await ground.until(() => document.querySelector(".map-actions").hidden, "no offer for another aircraft");
  assert.deepEqual(await ground.messages("answer"), []);
  await select("glider-1");
  await ground.isLive();
  await ground.page.focus(".map-canvas");
  await ground.page.keyboard.press("Enter");
  await ground.page.fill("#map-fly", "75");
  await ground.page.evaluate(selectBeforeAnswer, "glider-2");
  // A second one would follow an ack alone, which a busy machine may turn into a stale beacon.
  await ground.firstAnswerTo(() => ground.press("#map-fly-send"));
  await isSelected(ground, "glider-2");
  const sent = await ground.page.evaluate(() => window.testSent);
  assert.deepEqual(sent, [["up.navigation.target", "glider-1"]]);
  await ground.leaveControl();
  await select("glider-1");
  await ground.untilHolder("you");
  ground.assertClean();
});

test("an alarm of another aircraft sounds and is announced with its name until it is acknowledged", async () => {
  const ground = await opened();
  await ground.page.evaluate(() => {
    window.testRung = [];
    navigator.vibrate = (pattern) => window.testRung.push(pattern.join());
  });
  await ground.press("#sound-button");
  tellSecond({ arduino: { connected: true, failsafe: true } });
  await ground.until(() => document.querySelector('#other-alarm[role="alert"]'), "the bar");
  for (const [name, value] of Object.entries({ aircraft: "glider-2", code: "failsafe", level: "alarm" })) {
    assert.equal(await ground.attribute("#other-alarm", `data-${name}`), value);
  }
  assert.match(await ground.text("#other-alarm strong"), /^glider-2: /);
  await rowHas(ground, "glider-2", { level: "alarm" });
  await ground.until(() => window.testRung.includes("300,100,300"), "the sound of an alarm");
  assert.equal(await ground.attribute("#bar-alarm", "data-level"), "none");
  await ground.press("#other-alarm .acknowledge");
  await ground.until(() => document.querySelector("#other-alarm") === null, "silence");
  await ground.page.click('#fleet-list [data-aircraft="glider-2"]');
  await ground.until(() => document.querySelector('#alarms [data-code="failsafe"][data-acknowledged="true"]'), "its own bar, acknowledged");
  tellSecond({});
  await ground.until(() => document.querySelector("#alarms [data-code='failsafe']") === null, "its end");
  ground.assertClean();
});

/** Let the page receive a message as if the server had sent it. */
function receive(message) {
  const socket = window.testSockets.at(-1);
  socket.dispatchEvent(new MessageEvent("message", { data: JSON.stringify(message) }));
}

test("fifty aircraft with hostile names fit on a phone", async () => {
  const ground = await opened(PHONE);
  const bad = `<img src=x onerror="window.testBroken=1">`;
  const names = [...NAMES, bad, ...Array.from({ length: 46 }, (_, index) => `aircraft-with-a-long-name-${index}`)];
  const alarm = { kind: "imu", code: bad, level: "alarm", text: bad };
  const data = { ...SECOND, flight_mode: bad, armed: bad, navigation: { ...SECOND.navigation, height: bad } };
  const rows = names.map((name) => ({ name, alarms: [alarm, null, 7], age_ms: 30, data }));
  const [{ message: welcome }] = await ground.messages("welcome");
  await ground.page.evaluate(receive, { ...welcome, aircraft: names });
  await ground.page.evaluate(receive, { type: "fleet", age_ms: 0, aircraft: [...rows, null, { name: 7 }] });
  await ground.until(() => document.querySelectorAll("#fleet-list li").length === 50, "fifty rows");
  await ground.until(() => document.querySelector("#other-alarm")?.textContent.includes("<img"), "the text of an alarm");
  const found = await ground.page.evaluate(() => ({
    images: document.querySelectorAll("#fleet-list img, .fleet-marker img, #alarms img").length,
    isBroken: "testBroken" in window,
    overflow_px: document.documentElement.scrollWidth - document.documentElement.clientWidth,
  }));
  assert.deepEqual(found, { images: 0, isBroken: false, overflow_px: 0 });
  assert.equal(await ground.page.$eval(`#fleet-list [data-aircraft^="<img"] button`, (each) => each.textContent), bad);
  assert.deepEqual(await seriousFaults(ground.page), []);
  ground.assertClean();
});

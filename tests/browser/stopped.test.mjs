// A part of the page that fails, and a button that may not be pressed.
import assert from "node:assert/strict";
import { afterEach, before, beforeEach, test } from "node:test";

import { FakeFlight } from "./support/fake_flight.mjs";
import { GroundPage } from "./support/ground_page.mjs";
import { browser, stopAfter } from "./support/setup.mjs";

let flight;
let ground;

before(async () => {
  flight = stopAfter(await FakeFlight.start());
});

beforeEach(async () => {
  flight.tell({ data: {} });
  ground = await (await GroundPage.open(browser, flight.address)).isLive();
  await ground.page.evaluate(addClock);
});

afterEach(() => GroundPage.closeAll());

/** Give the page a clock that a test stops: however busy the machine is, a press lasts until the test is done. */
function addClock() {
  const real_ms = performance.now.bind(performance);
  let behind_ms = 0;
  let stopped_ms = null;
  performance.now = () => stopped_ms ?? real_ms() - behind_ms;
  window.testClock = {
    stop: () => (stopped_ms = performance.now()),
    go: () => {
      behind_ms = real_ms() - stopped_ms;
      stopped_ms = null;
    },
  };
}

/** Let everything fail that writes into an element, until `window.isFailing` is false. */
function failAt(id) {
  const real = Element.prototype.setAttribute;
  window.isFailing = true;
  Element.prototype.setAttribute = function (name, value) {
    if (window.isFailing && this.id === id) {
      throw new Error("a fault of the test");
    }
    return real.call(this, name, value);
  };
}

/** Count from now on which Commands the page sends. */
async function countCommands() {
  await ground.page.evaluate(() => {
    const socket = window.testSockets.at(-1);
    const real = socket.send;
    window.testCommands = [];
    socket.send = function (text) {
      const message = JSON.parse(text);
      if (message.type === "command") {
        window.testCommands.push(message.name);
      }
      return real.call(this, text);
    };
  });
  return () => ground.page.evaluate(() => window.testCommands);
}

const press = (selector) => document.querySelector(selector).dataset.press;

test("a part that fails does not look live, is named, and comes back", async () => {
  await ground.page.evaluate(failAt, "horizon-ball");
  flight.tell({ data: { orientation: { roll: -40, pitch: 5, yaw: 1 }, altitude: 77 } });
  await ground.until(() => document.querySelector("#missing").textContent !== "", "what is missing");
  assert.equal(await ground.attribute("#missing > *", "data-code"), "horizon");
  const shown = await ground.page.evaluate(() => {
    const horizon = document.querySelector("#horizon");
    return [horizon.dataset.freshness, horizon.inert, horizon.className];
  });
  assert.deepEqual(shown, ["none", true, "is-broken"]);
  await ground.until(
    () => document.querySelector('[data-key="altitude"]').textContent === "77.0",
    "the other parts go on",
  );
  await ground.page.evaluate(() => (window.isFailing = false));
  await ground.until(
    () => document.querySelector("#horizon").dataset.freshness === "live",
    "the part again",
  );
  assert.equal(await ground.attribute("#horizon-ball", "data-roll"), "-40.00");
  assert.equal(await ground.page.evaluate(() => document.querySelector("#horizon").inert), false);
  assert.equal(await ground.page.isVisible("#missing"), false);
});

test("a bar that fails calls nothing live", async () => {
  await ground.page.evaluate(failAt, "bar-alarm");
  await ground.page.evaluate(() => {
    // What the bar says of the alarm must change for it to fail.
    document.querySelector("#bar-alarm").shownAttributes["data-level"] = "other";
  });
  await ground.until(() => document.querySelector('#missing > [data-code="bar"]') !== null, "the fault");
  assert.equal(await ground.attribute("#bar-link", "data-freshness"), "none");
  assert.notEqual(await ground.attribute("html", "data-aircraft-state"), "live");
  await ground.page.evaluate(() => (window.isFailing = false));
  await ground.isLive();
  await ground.until(() => document.querySelector("#bar-link").dataset.freshness === "live", "the bar");
});

test("a button that is disabled sends nothing, however long it is held", async () => {
  flight.tell({ data: { armed: true } });
  await ground.takeControl();
  await ground.until(
    () =>
      document.querySelector("#arm-button").disabled &&
      !document.querySelector("#disarm-button").disabled,
    "armed on the page",
  );
  const commands = await countCommands();
  const hand = ground.mouse("#arm-button");
  await hand.down();
  await ground.page.waitForTimeout(2000);
  assert.notEqual(await ground.page.evaluate(press, "#arm-button"), "done");
  await hand.up();
  assert.deepEqual(await commands(), []);
  assert.equal(await ground.attribute("#arming-note", "data-code"), "armed");
});

test("a press is void when the motor becomes armed, and the next one counts", async () => {
  await ground.takeControl();
  await ground.until(() => !document.querySelector("#arm-button").disabled, "disarmed on the page");
  const commands = await countCommands();
  const hand = ground.mouse("#arm-button");
  await ground.page.evaluate(() => window.testClock.stop());
  await hand.down();
  assert.equal(await ground.page.evaluate(press, "#arm-button"), "pressed");
  flight.tell({ data: { armed: true } });
  await ground.until(() => document.querySelector("#arm-button").dataset.press !== "pressed", "its end");
  assert.notEqual(await ground.page.evaluate(press, "#arm-button"), "done");
  assert.equal(await ground.attribute("#arming-note", "data-code"), "armed");
  await hand.up();
  flight.tell({ data: { armed: false } });
  await ground.until(() => !document.querySelector("#arm-button").disabled, "disarmed again");
  assert.deepEqual(await commands(), []);
  await ground.page.evaluate(() => window.testClock.go());
  await ground.answerTo(() => ground.hold("#arm-button"));
  assert.deepEqual(await commands(), ["up.arm"]);
  ground.assertClean();
});

test("a key released after its button was disabled counts again the next time", async () => {
  await ground.takeControl();
  await ground.until(() => !document.querySelector("#arm-button").disabled, "disarmed on the page");
  const { keyboard } = ground.page;
  await ground.page.evaluate(() => window.testClock.stop());
  await ground.page.focus("#arm-button");
  await keyboard.down("Space");
  assert.equal(await ground.page.evaluate(press, "#arm-button"), "pressed");
  flight.tell({ data: { armed: true } });
  await ground.until(() => document.querySelector("#arm-button").disabled, "disabled");
  await keyboard.up("Space");
  flight.tell({ data: { armed: false } });
  await ground.until(() => !document.querySelector("#arm-button").disabled, "disarmed again");
  await ground.page.focus("#arm-button");
  await keyboard.down("Space");
  assert.equal(await ground.page.evaluate(press, "#arm-button"), "pressed");
  await keyboard.up("Space");
  ground.assertClean();
});

// The aircraft executes each request of the page, or refuses it with its reason.
import assert from "node:assert/strict";
import { afterEach, before, describe, test } from "node:test";

import { seriousFaults } from "./support/accessibility.mjs";
import { LAPTOP, PHONE } from "./support/browser.mjs";
import { GroundPage } from "./support/ground_page.mjs";
import { Pilot } from "./support/pilot.mjs";
import { record } from "./support/recorder.mjs";
import { browser, stopAfter } from "./support/setup.mjs";
import { startShowcase } from "./support/showcase.mjs";
import { until } from "./support/wait.mjs";

/** How long a press must last, less what a frame of the screen takes. */
const HELD_MS = 1450;
let showcase;
let ground;

before(async () => {
  showcase = stopAfter(await startShowcase());
  ground = await (await GroundPage.open(browser, showcase.address)).isLive();
  await ground.takeControl();
});

/** Wait until telemetry says something. */
async function flies(condition, what) {
  await until(async () => condition(await ground.frame()) || null, what);
}

/** How many Commands the page has sent and heard of. */
async function answers() {
  return (await ground.messages("answer")).length;
}

test("a flight mode is flown after a question, and its ack is shown", async () => {
  for (const mode of ["RATE", "RETURN", "LOITER", "FBW"]) {
    const answer = await ground.fly(mode);
    assert.equal(answer.outcome, "ack", JSON.stringify(answer));
    assert.equal(answer.code_shown, "ack");
    const acts = ({ flight_mode, flight_control }) => (flight_mode === "SETPOINT" ? flight_control.mode : flight_mode);
    await flies((frame) => acts(frame) === mode, `${mode} in telemetry`);
    await ground.until(
      (mode) => document.querySelector('[data-key="flight_mode"]').textContent === mode,
      `${mode} on the page`,
      mode,
    );
  }
});

test("a declined confirmation sends nothing", async () => {
  const before = await answers();
  await ground.page.click('[data-mode="RATE"]');
  await ground.page.click("#confirm-no");
  assert.equal(await answers(), before);
  assert.equal((await ground.frame()).flight_mode, "FBW");
  assert.equal(await ground.page.isVisible("dialog#confirm"), false);
});

test("an invalid Command is not sent", async () => {
  const before = await answers();
  await ground.page.fill("#telemetry-period", "19");
  await ground.page.click("#telemetry-period-send");
  assert.equal(await ground.attribute("#telemetry-period", "aria-invalid"), "true");
  assert.equal(await ground.page.isVisible("dialog#confirm"), false);
  assert.equal(await answers(), before);
});

test("a disarm in flight is refused by the aircraft, and the page says why", async () => {
  const recorded = await record(ground.page, {
    press: { selector: "#disarm-button", attribute: "data-press" },
  });
  const answer = await ground.answerTo(() => ground.hold("#disarm-button"));
  const presses = await recorded.read();
  const done = presses.findIndex(({ value }) => value === "done");
  assert.equal(presses[done - 1].value, "pressed");
  assert.ok(presses[done].unix_ms - presses[done - 1].unix_ms > HELD_MS);
  assert.equal(answer.outcome, "nack");
  assert.equal(answer.code, "refused");
  assert.equal(answer.code_shown, "nack refused");
  assert.ok(answer.shown.endsWith(answer.reason), answer.shown);
  assert.equal((await ground.frame()).armed, true);
});

test("a press that does not last does nothing", async () => {
  const before = await answers();
  const hand = ground.mouse("#disarm-button");
  const ended = async () => {
    await ground.isLive();
    await hand.down();
    await ground.until(() => document.querySelector("#disarm-button").dataset.press !== "idle", "a press");
    await hand.up();
    return ground.attribute("#arming-note", "data-code");
  };
  // Of an aircraft that a busy machine silenced a press is void from its beginning.
  await until(async () => (await ended()) === "too_early" || null, "a press that was released too early");
  assert.equal(await answers(), before);
});

test("with the throttle low the page disarms the motor and arms it again", async () => {
  const pilot = await new Pilot(showcase).ready();
  const glide = { aux1: 2000, aux2: 2000, throttle: 1000, ailerons: 1500, elevator: 1500 };
  pilot.move(glide);
  await flies((frame) => frame.rx.throttle < 1050, "the low throttle in telemetry");
  const disarmed = await until(async () => {
    const answer = await ground.answerTo(() => ground.hold("#disarm-button"));
    // It was not low for 2 s yet.
    return answer.outcome === "ack" ? answer : null;
  }, "the disarming");
  assert.equal(disarmed.code_shown, "ack");
  await ground.until(() => document.querySelector("#bar-armed").textContent === "disarmed", "disarmed");
  const armed = await ground.answerTo(() => ground.hold("#arm-button"));
  assert.equal(armed.outcome, "ack", JSON.stringify(armed));
  await ground.until(() => document.querySelector("#bar-armed").textContent === "ARMED", "armed");
  await pilot.leave();
});

test("the page has done nothing that it may not", () => ground.assertClean());

describe("a phone in the field, fingers, a keyboard, and who does not see well", () => {
  const FINGER_PX = 44;
  const KEY_CONTROLS = [
    "#aircraft-select",
    "#theme-button",
    "#sound-button",
    "#control-request",
    "#control-release",
    "[data-mode]",
    "#arm-button",
    "#disarm-button",
    "#confirm-yes",
    "#confirm-no",
    "#gains-send",
    "#gains-undo",
    "#jump a",
  ];
  let pilot;

  before(async () => {
    await GroundPage.closeAll();
    pilot = await new Pilot(showcase).ready();
    stopAfter({ stop: () => pilot.leave() });
  });

  afterEach(() => GroundPage.closeAll());

  /** Glide until the aircraft lets itself be disarmed, and do it in some way. */
  async function disarm(ground, hold) {
    pilot.move({ aux1: 2000, aux2: 2000, throttle: 1000, ailerons: 1500, elevator: 1500 });
    await until(async () => {
      const answer = await ground.answerTo(hold);
      return answer.outcome === "ack" || null;
    }, "the disarming");
    await ground.until(() => document.querySelector("#bar-armed").textContent === "disarmed", "disarmed");
  }

  /** The elements wider than the screen. */
  async function tooWide(ground) {
    return ground.page.evaluate(() => {
      const root = document.scrollingElement;
      if (root.scrollWidth <= root.clientWidth) {
        return [];
      }
      const wide = [...document.body.querySelectorAll("*")].filter(
        (each) => each.getBoundingClientRect().right > root.clientWidth + 0.5,
      );
      return [`${root.scrollWidth} px`, ...wide.slice(0, 5).map((each) => each.id || each.outerHTML.slice(0, 80))];
    });
  }

  /** Key controls that are shown and too small for a finger. */
  async function tooSmall(ground) {
    return ground.page.evaluate(
      ([selectors, least]) =>
        selectors
          .flatMap((selector) => [...document.querySelectorAll(selector)])
          .filter((each) => each.checkVisibility())
          .map((each) => [each.id || each.outerHTML.slice(0, 60), each.getBoundingClientRect()])
          .filter(([, { width, height }]) => Math.min(width, height) < least - 0.01)
          .map(([name, { width, height }]) => `${name}: ${width.toFixed(0)} x ${height.toFixed(0)}`),
      [KEY_CONTROLS, FINGER_PX],
    );
  }

  test("a phone shows all of it without scrolling sideways, large enough for fingers", async () => {
    const ground = await (await GroundPage.open(browser, showcase.address, PHONE)).isLive();
    assert.deepEqual(await tooWide(ground), []);
    assert.deepEqual(await tooSmall(ground), []);
    await ground.page.tap("#control-request");
    await ground.untilHolder("you");
    await ground.page.tap('[data-mode="FBW"]');
    assert.deepEqual(await tooSmall(ground), []);
    assert.deepEqual(await tooWide(ground), []);
    await ground.page.tap("#confirm-no");
    await ground.page.setViewportSize({ width: 320, height: 568 });
    assert.deepEqual(await tooWide(ground), []);
    ground.assertClean();
  });

  test("a held finger disarms and arms; a touch that ends early does neither", async () => {
    const ground = await (await GroundPage.open(browser, showcase.address, PHONE)).isLive();
    await ground.takeControl();
    const off = await ground.finger("#disarm-button");
    await disarm(ground, () => ground.hold("#disarm-button", off));
    const before = (await ground.messages("answer")).length;
    const on = await ground.finger("#arm-button");
    await on.down();
    await ground.until(() => document.querySelector("#arm-button").dataset.press === "pressed", "touch");
    await on.up();
    await ground.until(() => document.querySelector("#arm-button").dataset.press === "idle", "its end");
    assert.equal((await ground.messages("answer")).length, before);
    const answer = await ground.answerTo(() => ground.hold("#arm-button", on));
    assert.equal(answer.outcome, "ack", JSON.stringify(answer));
    await ground.until(() => document.querySelector("#bar-armed").textContent === "ARMED", "armed");
    ground.assertClean();
  });

  test("a keyboard is enough: control, theme, a mode, disarm and arm", async () => {
    const ground = await (await GroundPage.open(browser, showcase.address)).isLive();
    const { keyboard } = ground.page;
    const goTo = async (selector) => {
      await ground.until((s) => !document.querySelector(s).disabled, `${selector} offered`, selector);
      for (let count = 0; count < 300; count += 1) {
        await keyboard.press("Tab");
        const found = await ground.page.evaluate((s) => {
          const here = document.activeElement;
          const style = getComputedStyle(here);
          const isSeen = here === document.body || style.outlineStyle !== "none" || style.boxShadow !== "none";
          return { isThere: here.matches(s), isSeen, name: here.id || here.outerHTML.slice(0, 80) };
        }, selector);
        assert.ok(found.isSeen, found.name);
        if (found.isThere) {
          return;
        }
      }
      assert.fail(selector);
    };
    /** A key on a button; a button that was disabled for a moment has lost the focus. */
    const held = (key, selector) => {
      const down = async () => {
        if (!(await ground.page.evaluate((s) => document.activeElement.matches(s), selector))) {
          await goTo(selector);
        }
        await keyboard.down(key);
      };
      return { down, up: () => keyboard.up(key) };
    };
    const theme = await ground.attribute("html", "data-theme");
    await goTo("#theme-button");
    await keyboard.press("Enter");
    assert.notEqual(await ground.attribute("html", "data-theme"), theme);
    await goTo("#control-request");
    await keyboard.press("Space");
    await ground.untilHolder("you");
    await goTo('[data-mode="FBW"]');
    const answer = await ground.answerTo(async () => {
      await keyboard.press("Enter");
      await keyboard.press("Tab");
      assert.equal(await ground.page.evaluate(() => document.activeElement.id), "confirm-yes");
      await keyboard.press("Enter");
    });
    assert.equal(answer.outcome, "ack", JSON.stringify(answer));
    await disarm(ground, () => ground.hold("#disarm-button", held("Space", "#disarm-button")));
    const armed = await ground.answerTo(() => ground.hold("#arm-button", held("Enter", "#arm-button")));
    assert.equal(armed.outcome, "ack", JSON.stringify(armed));
    ground.assertClean();
  });

  for (const [name, size] of [["laptop", LAPTOP], ["phone", PHONE]]) {
    test(`nothing keeps anybody from using it: ${name}, light and dark`, async () => {
      const ground = await (await GroundPage.open(browser, showcase.address, size)).isLive();
      await ground.takeControl();
      for (const [colorScheme, theme] of [["light", "daylight"], ["dark", "dark"]]) {
        await ground.page.emulateMedia({ colorScheme });
        await ground.until((name) => document.documentElement.dataset.theme === name, theme, theme);
        assert.deepEqual(await seriousFaults(ground.page), []);
      }
    });
  }
});

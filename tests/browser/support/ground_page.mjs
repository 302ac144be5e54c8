// The ground station's page as a user operates it.
import assert from "node:assert/strict";

import { LAPTOP, openPage, outsideRequests } from "./browser.mjs";
import { until } from "./wait.mjs";

/** Keeps what the server says, with the time of the page at which it came. */
function listen() {
  window.testMessages = [];
  window.testSockets = [];
  const Real = window.WebSocket;
  window.WebSocket = class extends Real {
    constructor(...words) {
      super(...words);
      window.testSockets.push(this);
      this.addEventListener("message", (event) => {
        const message = JSON.parse(event.data);
        window.testMessages.push({ at_ms: performance.now(), message });
        if (window.testMessages.length > 5000) {
          window.testMessages.splice(0, 1000);
        }
      });
    }
  };
}

/** How long and how often a tap is tried. */
const TAP_S = 3;
const TAPS = 5;
/** One element of each of the parts that draw themselves; one that comes later moves what is below it. */
const PARTS = [
  "#turn > *",
  "#compass > *",
  ...["navigation", "sticks", "servos", "battery", "board", "link", "readings"].map((id) => `#${id} > h3 + *`),
  "#horizon-ball",
  '[data-key="altitude"]',
  '[data-key="flight_mode"]',
  "#panel-map[data-latitude]",
  "#control-holder",
  "#arm-button",
  "#gains",
  "#events",
];
const open = new Set();

/** A user in front of the page. */
export class GroundPage {
  constructor(page) {
    this.page = page;
    this.seen = page.seen;
    open.add(this);
  }

  /** Close what a test has left open; control is given back, as a page that vanishes keeps it. */
  static async closeAll() {
    for (const each of [...open]) {
      const holder = await each.attribute("#control-holder", "data-holder").catch(() => null);
      if (holder === "you" && !(await each.page.isVisible("dialog[open]"))) {
        await each.leaveControl();
      }
      await each.close();
    }
  }

  /** Open the page at an address. */
  static async open(browser, address, options = LAPTOP) {
    const page = await openPage(browser, address, { ...options, first: listen });
    return new GroundPage(page);
  }

  /** Wait until all parts of the page are there and show an aircraft. */
  async isLive() {
    const isThere = (selectors) => selectors.every((each) => document.querySelector(each));
    await this.until(isThere, "the parts of the page", PARTS);
    await this.until(() => document.documentElement.dataset.aircraftState === "live", "live");
    return this;
  }

  /** Wait for a condition in the page. */
  async until(condition, what, argument) {
    return until(
      async () => (await this.page.evaluate(condition, argument)) || null,
      () => `${what}; the page complains of ${JSON.stringify(this.seen.errors.slice(-5))}`,
    );
  }

  /** Touch a part of an element, such as [0.5, 0.5], until a condition holds: a busy page moves what is below a part that comes late. */
  async tapUntil(selector, [right, down], condition) {
    for (let tries = 1; ; tries += 1) {
      await this.show(selector);
      const { x, y, width, height } = await this.page.locator(selector).boundingBox();
      await this.page.touchscreen.tap(x + width * right, y + height * down);
      try {
        return await until(condition, "the effect of a tap", TAP_S);
      } catch (late) {
        if (tries === TAPS) {
          throw late;
        }
      }
    }
  }

  /** The text of the first element of a selector, or null. */
  async text(selector) {
    return this.page.evaluate((s) => document.querySelector(s)?.textContent ?? null, selector);
  }

  /** An attribute of the first element of a selector. */
  async attribute(selector, name) {
    const words = [selector, name];
    return this.page.evaluate(([s, n]) => document.querySelector(s)?.getAttribute(n) ?? null, words);
  }

  /** Wait until an element shows the reason with a code. */
  async reason(selector, code) {
    const shows = ([s, c]) => document.querySelector(s).dataset.code === c;
    await this.until(shows, `${code} at ${selector}`, [selector, code]);
  }

  /** The displayed value of a telemetry key. */
  async value(key) {
    return this.text(`[data-key="${key}"]`);
  }

  /** Every shown value: {key, freshness, text}. */
  async values() {
    return this.page.evaluate(() =>
      [...document.querySelectorAll("[data-key]")].map((element) => ({
        key: element.dataset.key,
        freshness: element.dataset.freshness,
        text: element.textContent,
      })),
    );
  }

  /** The messages of a type that have come so far: {at_ms, message}. */
  async messages(type) {
    return this.page.evaluate(
      (type) => window.testMessages.filter(({ message }) => message.type === type),
      type,
    );
  }

  /** Telemetry as it came last. */
  async frame() {
    const frames = await this.messages("frame");
    return frames[frames.length - 1]?.message.data;
  }

  /** Press something, and say yes where the page asks. */
  async press(selector) {
    await this.page.click(selector);
    await this.page.evaluate(() => new Promise(requestAnimationFrame));
    if (await this.page.$("dialog#confirm[open]")) {
      await this.page.click("#confirm-yes");
    }
  }

  /** Do something and return the first answer, and what the page shows of it. */
  async firstAnswerTo(action) {
    const before = (await this.messages("answer")).length;
    await action();
    const count = () => window.testMessages.filter(({ message }) => message.type === "answer").length;
    await until(async () => (await this.page.evaluate(count)) > before || null, "an answer");
    await this.page.evaluate(() => new Promise(requestAnimationFrame));
    const answers = await this.messages("answer");
    return {
      ...answers[answers.length - 1].message,
      shown: await this.text("#last-answer"),
      code_shown: await this.attribute("#last-answer", "data-code"),
    };
  }

  /** As firstAnswerTo, again while only a busy machine made a reading or the beacon too old. */
  async answerTo(action) {
    for (;;) {
      const answer = await this.firstAnswerTo(action);
      if (answer.detail !== "reading_stale" && answer.code !== "stale") {
        return answer;
      }
      await this.isLive();
    }
  }

  /** Select a flight mode by its button. */
  async fly(mode) {
    return this.answerTo(async () => {
      const isOffered = (mode) => document.querySelector(`[data-mode="${mode}"]`)?.disabled === false;
      await this.until(isOffered, `${mode} offered`, mode);
      await this.press(`[data-mode="${mode}"]`);
    });
  }

  /**
   * Hold a button until it does what it says.
   * @param {string} selector
   * @param {{down: () => Promise<void>, up: () => Promise<void>}} hand by the mouse where none is named
   */
  async hold(selector, hand = this.mouse(selector)) {
    for (;;) {
      await this.page.evaluate(watchPress, selector);
      await hand.down();
      const [how, code] = await this.until(() => window.testPressEnd, `${selector} held to its end`);
      await hand.up();
      if (how === "done") {
        return;
      }
      // A machine that is busy elsewhere holds the page or the telemetry up, or moves the button late
      // from under the pointer: each makes a press void on purpose.
      assert.match(code, /^(page_delayed|pointer_left|silent)$/);
      await this.isLive();
    }
  }

  /** Scroll until something is in the middle of the screen, away from the bars at its edges. */
  async show(selector) {
    await this.page.evaluate(
      (s) => document.querySelector(s).scrollIntoView({ block: "center", behavior: "instant" }),
      selector,
    );
  }

  /** A hand with a mouse over a button. */
  mouse(selector) {
    const down = async () => {
      await this.show(selector);
      await this.page.hover(selector);
      await this.page.mouse.down();
    };
    return { down, up: () => this.page.mouse.up() };
  }

  /** A finger on a button, of a page with a touch screen. */
  async finger(selector) {
    const devtools = await this.page.context().newCDPSession(this.page);
    const touch = (type, touchPoints) =>
      devtools.send("Input.dispatchTouchEvent", { type, touchPoints });
    const down = async () => {
      await this.show(selector);
      const { x, y, width, height } = await this.page.locator(selector).boundingBox();
      await touch("touchStart", [{ x: x + width / 2, y: y + height / 2 }]);
    };
    return { down, up: () => touch("touchEnd", []) };
  }

  /** Ask for control, once a page that was closed has lost it, and wait until this one has it. */
  async takeControl() {
    const isFree = () => {
      const place = document.querySelector("#control-holder");
      return place !== null && place.dataset.holder !== "page";
    };
    await this.until(isFree, "control to be free");
    await this.press("#control-request");
    await this.untilHolder("you");
  }

  /** Give control back to the next requester. */
  async leaveControl() {
    await this.press("#control-release");
    await this.until(() => document.querySelector("#control-holder").dataset.holder !== "you", "no control");
  }

  /** Wait until control has that owner: you, page, ground, nobody. */
  async untilHolder(holder) {
    const held = (holder) => {
      const all = window.testMessages.filter(({ message }) => message.type === "status");
      return all[all.length - 1]?.message.control.holder === holder;
    };
    await this.until(held, `control held by ${holder}`, holder);
  }

  /** Fail where the page failed, was stopped by its policy, or asked anybody outside. */
  assertClean() {
    assert.deepEqual(this.seen.errors, [], "errors of the page");
    assert.deepEqual(this.seen.violations, [], "what the policy stopped");
    assert.deepEqual(outsideRequests(this.page), [], "requests that leave the machine");
  }

  /** Close the page and its context, as a user closes the browser. */
  async close() {
    open.delete(this);
    await this.page.context().close();
  }
}

/** Keep how the next press of a button ends: by the time that a test looks, the button may be idle again. */
function watchPress(selector) {
  const button = document.querySelector(selector);
  window.testPressEnd = null;
  new MutationObserver((_, observer) => {
    const { press } = button.dataset;
    if (!["idle", "pressed"].includes(press)) {
      window.testPressEnd = [press, document.querySelector("#arming-note").dataset.code];
      observer.disconnect();
    }
  }).observe(button, { attributeFilter: ["data-press"] });
}

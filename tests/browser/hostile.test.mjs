// An aircraft that lies, whose texts are shown as text and never run; a part of the page that fails.
import assert from "node:assert/strict";
import { afterEach, before, beforeEach, describe, test } from "node:test";

import { FakeFlight } from "./support/fake_flight.mjs";
import { GroundPage } from "./support/ground_page.mjs";
import { run } from "./support/program.mjs";
import { browser, stopAfter } from "./support/setup.mjs";

const RUN = "window.wasHurt = true";
const HOSTILE = [
  `<img src=x onerror="${RUN}">`,
  `"><script>${RUN}</script>`,
  `</script><svg onload="${RUN}">`,
  `javascript:${RUN}`,
  `'-${RUN}-'`,
  `{{constructor.constructor("${RUN}")()}}`,
  "\u202Egnp.elif\u0000\u0007\u2028end",
  "__proto__",
  `long ${"A".repeat(400)}`,
];
/** Keys whose values are texts, and those under which the aircraft chooses the keys. */
const TEXTS = ["mode", "flight_mode", "flight_controller"];
let flight;
let ground;

before(async () => {
  flight = stopAfter(await FakeFlight.start());
});

beforeEach(async () => {
  flight.tell({ data: {} });
  ground = await (await GroundPage.open(browser, flight.address)).isLive();
});

afterEach(() => GroundPage.closeAll());

/** What has run that should not, or was made of text that should not. */
async function harm() {
  return ground.page.evaluate(() => ({
    wasHurt: "wasHurt" in window,
    scripts: [...document.scripts].filter((each) => !each.src).length,
    images: document.querySelectorAll("img[src=x]").length,
    handlers: document.querySelectorAll("[onerror], [onload]").length,
    isPolluted: "hurt" in {},
  }));
}
const NO_HARM = { wasHurt: false, scripts: 0, images: 0, handlers: 0, isPolluted: false };

function telemetry(text) {
  return {
    ...Object.fromEntries(TEXTS.map((key) => [key, text])),
    vetoes: [text, text],
    source: { orientation: text, [text]: text },
    arduino: { connected: true, framing: text, switch: text, reset_cause: text, failsafe: false },
    flight_control: { mode: text, offered: [text], missing: [text] },
    counters: { [text]: { [text]: 1 }, bus: { unhandled: text } },
    system: { providers: [text], uptime_s: text },
    ground: { role: text, tune_in_flight: text },
    black_box: { recording: true, file: text, problem: text, megabytes: text },
    [text]: { [text]: text },
  };
}

test("texts of telemetry are shown as they are", async () => {
  for (const text of HOSTILE) {
    const { length } = await ground.messages("frame");
    flight.tell({ data: telemetry(text) });
    await ground.until(
      ([text, length]) =>
        window.testMessages
          .filter(({ message }) => message.type === "frame")
          .slice(length)
          .some(({ message }) => message.data.flight_mode === text),
      `frames with ${text.slice(0, 40)}`,
      [text, Math.max(0, length - 1000)],
    );
    await ground.page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
    assert.deepEqual(await harm(), NO_HARM, text.slice(0, 40));
    assert.equal(await ground.attribute("html", "data-aircraft-state"), "live");
  }
  flight.tell({ data: telemetry(HOSTILE[0]) });
  await ground.until(
    (text) => document.querySelector("#bar-mode").textContent === text,
    "the text itself",
    HOSTILE[0],
  );
  const width = await ground.page.evaluate(() => document.scrollingElement.scrollWidth - innerWidth);
  assert.ok(width <= 0, `${width} px`);
  ground.assertClean();
});

test("keys and values stay text in the list of all telemetry, and in a chart of one's own", async () => {
  await ground.page.click("#telemetry > summary");
  for (const text of HOSTILE) {
    flight.tell({ data: { ...telemetry(text), [`${text} n`]: { [text]: 7 } } });
    const isListed = (text) =>
      [...document.querySelectorAll("#telemetry-list .leaf-path")].some((each) => each.textContent.includes(text));
    // Characters that reverse or end a line are escaped, and long texts are cut.
    const part = text.startsWith("long") ? "long AAAA" : text.startsWith("\u202E") ? "gnp.elif" : text;
    await ground.until(isListed, `a row of ${text.slice(0, 40)}`, part);
    assert.deepEqual(await harm(), NO_HARM, text.slice(0, 40));
  }
  flight.tell({ data: { [HOSTILE[0]]: 7 } });
  const chart = (text) => [...document.querySelectorAll("#telemetry-list button")].find((each) => each.getAttribute("aria-label").includes(text));
  await ground.until((text) => [...document.querySelectorAll("#telemetry-list button")].some((each) => each.getAttribute("aria-label").includes(text)), "its button", HOSTILE[0]);
  await (await ground.page.evaluateHandle(chart, HOSTILE[0])).click();
  await ground.until((text) => document.querySelector("#chosen-chart")?.textContent.includes(text.slice(0, 30)), "its chart", HOSTILE[0]);
  assert.deepEqual(await harm(), NO_HARM);
  const width = await ground.page.evaluate(() => document.scrollingElement.scrollWidth - innerWidth);
  assert.ok(width <= 0, `${width} px`);
  await ground.page.click("#chosen-chart-close");
  ground.assertClean();
});

test("no form sends what takes a held press, nor gains that the aircraft's rule forbids in flight", async () => {
  await ground.takeControl();
  flight.tell({ data: { armed: true, ground: { role: "pilot", tune_in_flight: false } } });
  await ground.until(() => document.querySelector("#bar-armed").textContent === "ARMED", "armed");
  const rule = () =>
    window.testMessages.findLast(({ message }) => message.type === "status")?.message.tune_in_flight === false;
  await ground.until(rule, "the rule for gains in the status");
  await ground.page.evaluate(() => {
    window.testSent = [];
    const real = WebSocket.prototype.send;
    WebSocket.prototype.send = function send(text) {
      window.testSent.push(JSON.parse(text));
      return real.call(this, text);
    };
  });
  const sent = () => ground.page.evaluate(() => window.testSent.filter(({ type }) => type === "command").map(({ name }) => name));
  await ground.page.click("#any-command > summary");
  for (const name of ["up.arm", "up.disarm", " up.arm "]) {
    await ground.page.fill("#any-name", name);
    await ground.reason("#any-why", "held_only");
    assert.equal(await ground.page.isDisabled("#any-send"), true, name);
    await ground.page.evaluate(() => document.querySelector("#any-name").form.requestSubmit());
    await ground.page.press("#any-name", "Enter");
    assert.equal(await ground.page.isVisible("dialog#confirm"), false, name);
  }
  await ground.page.fill("#any-name", "arduino.pids.tunings");
  await ground.until(() => document.querySelector("#any-why").hidden, "nothing against its name");
  const field = await ground.page.evaluate(
    () => [...document.querySelectorAll(".any-fields label")].find((each) => each.textContent.startsWith("pids")).htmlFor,
  );
  await ground.page.fill(`#${field}`, "{}");
  await ground.page.click("#any-send");
  await ground.reason("#any-note", "tune_armed");
  assert.equal(await ground.page.isVisible("dialog#confirm"), false);
  assert.deepEqual(await sent(), []);
  ground.assertClean();
});

test("a refusal's reason is shown as text", async () => {
  await ground.takeControl();
  for (const text of HOSTILE.slice(0, 3)) {
    flight.tell({ nack: text });
    flight.tell({ data: { flight_mode: text } });
    await ground.until((t) => document.querySelector("#bar-mode").textContent === t, "it", text);
    const answer = await ground.answerTo(() => ground.press('[data-mode="FBW"]'));
    assert.equal(answer.outcome, "nack", JSON.stringify(answer));
    assert.ok(answer.shown.includes(text), answer.shown);
    assert.deepEqual(await harm(), NO_HARM);
  }
  ground.assertClean();
});

test("an invalid name is rejected, and a page shows one as text", async () => {
  const wrong = await run("up-ground", ["serve", "--aircraft", HOSTILE[0]]);
  assert.equal(wrong.status, 2);
  const page = await GroundPage.open(browser, "about:blank");
  await page.page.routeWebSocket(/\/link$/, (socket) => {
    const server = socket.connectToServer();
    // A server that was deceived: every name in what it says is a hostile one.
    server.onMessage((text) => {
      const message = JSON.parse(text);
      const words = { aircraft: HOSTILE[0], name: HOSTILE[1], holder_name: HOSTILE[2] };
      if (message.type === "welcome") {
        Object.assign(message, { aircraft: [HOSTILE[0], HOSTILE[1]], name: HOSTILE[1], version: HOSTILE[2] });
      } else if (message.aircraft === "default") {
        message.aircraft = words.aircraft;
      }
      if (message.control) {
        Object.assign(message.control, { holder: "page", holder_name: HOSTILE[2], asked_by: { page: 9, name: HOSTILE[1] } });
        message.control.pages = [{ page: 9, name: HOSTILE[0] }, { page: 10, name: HOSTILE[1] }];
        message.link.reason = HOSTILE[0];
      }
      socket.send(JSON.stringify(message));
    });
    socket.onMessage((text) => {
      const message = JSON.parse(text);
      message.aircraft &&= "default";
      server.send(JSON.stringify(message));
    });
  });
  await page.page.goto(flight.address);
  await page.isLive();
  await page.until(
    (text) => document.querySelector("#aircraft-select").selectedOptions[0]?.textContent === text,
    "the name as text",
    HOSTILE[0],
  );
  await page.until((text) => document.querySelector("#control-holder").textContent.includes(text), "the holder", HOSTILE[2]);
  const hurt = await page.page.evaluate(() => "wasHurt" in window || document.querySelector("img[src=x]") !== null);
  assert.equal(hurt, false);
  page.assertClean();
});

test("a script that got into the page all the same is stopped by its policy", async () => {
  await ground.page.evaluate((run) => {
    const script = document.createElement("script");
    script.textContent = run;
    document.body.append(script);
    const image = document.createElement("div");
    image.innerHTML = `<img src="data:x" onerror="${run}">`;
    document.body.append(image);
    const far = new Image();
    far.src = "http://192.0.2.1/told";
    document.body.append(far);
  }, RUN);
  await ground.until(() => document.querySelector("img[src='data:x']")?.complete, "the image");
  await ground.page.evaluate(() => new Promise((done) => setTimeout(done, 0)));
  const stopped = ground.seen.violations.map((text) => text.split(" ")[0]);
  assert.ok(stopped.includes("script-src-elem"), ground.seen.violations.join("; "));
  assert.ok(stopped.includes("script-src-attr"), ground.seen.violations.join("; "));
  assert.ok(stopped.includes("img-src"), ground.seen.violations.join("; "));
  assert.equal(await ground.page.evaluate(() => "wasHurt" in window), false);
});

describe("a part of the page that fails, and a button that may not be pressed", () => {
  beforeEach(() => ground.page.evaluate(addClock));

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
});

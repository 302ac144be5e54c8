// What shares a flight: a field without any network, gains, and two browsers with one control.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { afterEach, before, describe, test } from "node:test";

import { CarefulFlight } from "./support/careful_flight.mjs";
import { GroundPage } from "./support/ground_page.mjs";
import { run } from "./support/program.mjs";
import { browser, stopAfter } from "./support/setup.mjs";
import { startShowcase } from "./support/showcase.mjs";
import { until } from "./support/wait.mjs";

let showcase;

before(async () => {
  showcase = stopAfter(await startShowcase());
});

describe("without any network everything comes from the machine itself", () => {
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

  test("a file that a broken link does not bring is requested again, with those that need it", async () => {
    const ground = await GroundPage.open(browser, "about:blank");
    const lost = ["tapes.js", "disabled_reason.js"];
    for (const name of lost) {
      await ground.page.route(`**/${name}`, (route) => route.abort("connectionreset"), { times: 1 });
    }
    await ground.page.goto(showcase.address);
    await ground.isLive();
    assert.equal(await ground.page.isVisible("#missing"), false);
    for (const name of lost) {
      assert.equal(ground.seen.requests.filter((url) => url.endsWith(name)).length, 2);
    }
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
});

describe("gains go from the page into the firmware and back, and not where the aircraft forbids it", () => {
  const FIELD = '#gains input[name="ratePIDs.ailerons.p"]';
  const FAR = 0.0001;
  let careful;

  before(async () => {
    careful = stopAfter(await CarefulFlight.start());
  });

  afterEach(() => GroundPage.closeAll());

  /** The board's own report of its active gains, to another ground station. */
  async function gainsOfBoard() {
    const port = String(showcase.groundPort);
    const environment = { UP_GROUND_STATE: showcase.state };
    const words = ["send", "--port", port, "arduino.pids.tunings", "request=true"];
    return until(async () => {
      const { said } = await run("up-ground", words, { environment });
      const found = /arduino\.pids\.values (.*)/.exec(said);
      return found && JSON.parse(found[1]);
    }, "the board's gains");
  }

  function isSame(one, other) {
    return Math.abs(one - other) < FAR;
  }

  test("a change reaches the firmware, its ack the page, and undo takes it back", async () => {
    const ground = await (await GroundPage.open(browser, showcase.address)).isLive();
    await ground.takeControl();
    await ground.until((s) => document.querySelector(s)?.value, "the gains that fly", FIELD);
    const old = Number(await ground.page.inputValue(FIELD));
    const wanted = Number((old * 0.9).toFixed(3));

    await ground.page.fill(FIELD, String(wanted));
    await ground.until(() => !document.querySelector("#gains-difference").hidden, "the difference");
    const difference = await ground.text("#gains-difference");
    assert.ok(difference.includes(String(wanted)), difference);
    const answer = await ground.answerTo(() => ground.press("#gains-send"));
    assert.equal(answer.outcome, "ack", JSON.stringify(answer));
    assert.equal(answer.code_shown, "ack");
    await ground.until(() => document.querySelector("#gains-difference").hidden, "no difference left");

    await ground.leaveControl();
    const flown = await gainsOfBoard();
    assert.ok(isSame(flown.ratePIDs.ailerons.p, wanted), JSON.stringify(flown.ratePIDs));

    await ground.takeControl();
    await ground.until(() => !document.querySelector("#gains-undo").disabled, "the offer to undo");
    const undone = await ground.answerTo(() => ground.press("#gains-undo"));
    assert.equal(undone.outcome, "ack", JSON.stringify(undone));
    await ground.leaveControl();
    const again = await gainsOfBoard();
    assert.ok(isSame(again.ratePIDs.ailerons.p, old), JSON.stringify(again.ratePIDs));
    const others = (gains) => JSON.stringify([gains.ratePIDs.elevator, gains.stabPIDs, gains.navPIDs]);
    assert.equal(others(again), others(flown));
    ground.assertClean();
  });

  test("an invalid gain is not sent", async () => {
    const ground = await (await GroundPage.open(browser, showcase.address)).isLive();
    await ground.takeControl();
    await ground.until((s) => document.querySelector(s)?.value, "the gains that fly", FIELD);
    await ground.page.fill(FIELD, "99");
    await ground.until(() => document.querySelector("#gains-send").disabled, "no way to send it");
    assert.equal(await ground.attribute("#gains-difference", "data-problems"), "1");
    ground.assertClean();
  });

  test("in flight an aircraft that forbids it refuses, and the page says why", async () => {
    const ground = await (await GroundPage.open(browser, careful.address)).isLive();
    await ground.takeControl();
    await ground.until(() => document.querySelector("#bar-armed").textContent === "ARMED", "armed");
    await ground.until((s) => document.querySelector(s)?.value, "the gains that fly", FIELD);
    await ground.until(() => document.querySelector("#gains-send").disabled, "nothing offered");
    await ground.reason("#gains-why", "tune_armed");
    // Past everything that the page forbids: the aircraft has the last word.
    const { flying } = (await ground.messages("gains")).pop().message;
    const answer = await ground.answerTo(() =>
      ground.page.evaluate((pids) => {
        const { aircraft } = window.testMessages.find(({ message }) => message.type === "status").message;
        const { beacon } = window.testMessages.findLast(({ message }) => message.type === "frame").message;
        const data = { pids };
        const message = { type: "command", ask: 900, aircraft, name: "arduino.pids.tunings", data, beacon };
        window.testSockets[window.testSockets.length - 1].send(JSON.stringify(message));
      }, flying),
    );
    assert.equal(answer.outcome, "nack", JSON.stringify(answer));
    assert.equal(answer.code, "forbidden");
    ground.assertClean();
  });
});

describe("of two browsers one has control, the other watches, and it is handed over", () => {
  let first;
  let second;

  before(async () => {
    first = await (await GroundPage.open(browser, showcase.address)).isLive();
    second = await (await GroundPage.open(browser, showcase.address)).isLive();
  });

  /** Whether a page offers to command. */
  async function offers(page) {
    return page.page.isEnabled('[data-mode="FBW"]');
  }

  test("one has control, the other watches and shows the owner", async () => {
    await first.takeControl();
    await second.untilHolder("page");
    await first.until(() => !document.querySelector('[data-mode="FBW"]').disabled, "modes offered");
    await second.until(() => document.querySelector('[data-mode="FBW"]').disabled, "modes not offered");
    assert.equal(await second.page.isEnabled("#arm-button"), false);
    await second.reason("#commands-why", "control_page");
    const answer = await first.answerTo(() => first.press('[data-mode="FBW"]'));
    assert.equal(answer.outcome, "ack", JSON.stringify(answer));
  });

  test("the owner may keep control, wherever the page is scrolled to", async () => {
    await first.show("#mark");
    await second.page.click("#control-request");
    await first.until(() => !document.querySelector("#control-notice").hidden, "the question");
    assert.equal(await first.page.isVisible("#control-asked"), true);
    const { y, height } = await first.page.locator("#control-notice-deny").boundingBox();
    assert.ok(y > 0 && y + height < 900, "in sight");
    await second.until(() => document.querySelector("#control-request").dataset.waiting === "true", "waiting");
    assert.equal(await second.page.isVisible("#control-asked"), false);
    assert.equal(await second.attribute("#control-note", "data-code"), "requested");
    await first.page.click("#control-notice-deny");
    await second.reason("#control-note", "denied");
    await second.until(() => document.querySelector("#control-request").dataset.waiting === "false", "the offer to request it");
    await first.until(() => document.querySelector("#control-deny").hidden, "the question gone");
    await second.untilHolder("page");
    assert.equal(await offers(first), true);
    assert.equal(await offers(second), false);
  });

  test("a request may be withdrawn", async () => {
    await second.page.click("#control-request");
    await first.until(() => !document.querySelector("#control-notice").hidden, "the question");
    await second.until(() => document.querySelector("#control-request").dataset.waiting === "true", "waiting");
    await second.page.click("#control-request");
    await first.until(() => document.querySelector("#control-notice").hidden, "the question gone");
    await second.until(() => document.querySelector("#control-request").dataset.waiting === "false", "not waiting");
    assert.equal(await offers(first), true);
  });

  test("the owner may give control, and the roles change over", async () => {
    await second.page.click("#control-request");
    await first.until(() => !document.querySelector("#control-give").hidden, "the question");
    await first.page.click("#control-give");
    await second.untilHolder("you");
    await first.untilHolder("page");
    await second.until(() => !document.querySelector('[data-mode="FBW"]').disabled, "modes offered");
    await first.until(() => document.querySelector('[data-mode="FBW"]').disabled, "modes not offered");
    const answer = await second.answerTo(() => second.press('[data-mode="FBW"]'));
    assert.equal(answer.outcome, "ack", JSON.stringify(answer));
  });

  test("a page that is loaded again has control again", async () => {
    await second.page.reload();
    await second.isLive();
    await second.untilHolder("you");
  });

  test("a page that is closed leaves control to the others", async () => {
    second.assertClean();
    await second.close();
    await first.untilHolder("nobody");
    await first.takeControl();
    first.assertClean();
  });
});

// Values that are no longer current stop looking current, and recover automatically.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { afterEach, before, test } from "node:test";

import { GroundPage } from "./support/ground_page.mjs";
import { startProgram } from "./support/program.mjs";
import { record } from "./support/recorder.mjs";
import { browser, stopAfter } from "./support/setup.mjs";
import { startShowcase } from "./support/showcase.mjs";
import { between, distance_m, truthOf } from "./support/truth.mjs";

const GPS_M = 9;
const WITHIN_S = 1.0;
/** A live location is at most so old: on board and on the way. */
const LIVE_LOCATION_S = 1.9 + 0.2;
/** The page's and its server's own values, current even when the aircraft is silent. */
const OF_THE_PAGE = ["link.age", "link.rate", "link.lost", "link.page"];
/** The proxy reports that the aircraft is gone: all these values are current then. */
const OF_THE_PROXY = ["link.proxy", "link.tls", "link.latency", "link.aircraft"];
let showcase;

before(async () => {
  showcase = stopAfter(await startShowcase());
});

afterEach(() => GroundPage.closeAll());

/**
 * Let the page record, by its own clock, how old the newest frame is whenever the state of the
 * aircraft changes, what is shown as live while it is silent, and how long it was held up itself.
 */
function watchSilence([ofThePage, ofTheProxy]) {
  const root = document.documentElement;
  const found = { changes: [], liveWhileSilent: [], longestStall_ms: 0 };
  window.testSilence = found;
  const age_ms = () => {
    const frames = window.testMessages.filter(({ message }) => message.type === "frame");
    const { at_ms, message } = frames[frames.length - 1];
    return performance.now() - at_ms + message.age_ms;
  };
  let state = root.dataset.aircraftState;
  new MutationObserver(() => {
    if (root.dataset.aircraftState !== state) {
      state = root.dataset.aircraftState;
      found.changes.push({ state, age_ms: age_ms() });
    }
  }).observe(root, { attributes: true });
  let last_ms = performance.now();
  const look = () => {
    const now_ms = performance.now();
    found.longestStall_ms = Math.max(found.longestStall_ms, now_ms - last_ms);
    last_ms = now_ms;
    if (root.dataset.aircraftState !== "live") {
      const state = (key) => document.querySelector(`[data-key="link.${key}"]`).dataset.state;
      const ofNow = [...ofThePage];
      if (state("aircraft") === "offline") {
        ofNow.push(...ofTheProxy);
      } else if (state("proxy") !== "connected") {
        ofNow.push("link.proxy"); // the server's own: it looks for the proxy
      }
      for (const element of document.querySelectorAll('[data-freshness="live"]')) {
        if (!ofNow.includes(element.dataset.key)) {
          found.liveWhileSilent.push(element.dataset.key);
        }
      }
    }
    requestAnimationFrame(look);
  };
  requestAnimationFrame(look);
}

test("a cut link is greyed out within a second, and only fresh data return", async (t) => {
  const ground = await (await GroundPage.open(browser, showcase.address)).isLive();
  await ground.page.evaluate(watchSilence, [OF_THE_PAGE, OF_THE_PROXY]);
  const recorded = await record(ground.page, {
    state: { selector: "html", attribute: "data-aircraft-state" },
    latitude: { selector: "#panel-map", attribute: "data-latitude" },
    longitude: { selector: "#panel-map", attribute: "data-longitude" },
  });
  const proxy = showcase.pidOf("up_proxy.main");
  process.kill(proxy, "SIGSTOP");
  try {
    await ground.until(() => document.documentElement.dataset.aircraftState === "silent", "silence");
    await ground.until(
      () => Number(document.querySelector("#silence").dataset.ageS) > 6,
      "no news for 6 s",
    );
    // The age is in the text; answers to Commands have theirs behind it.
    const behind = () => getComputedStyle(document.querySelector("#silence"), "::after").content;
    assert.equal(await ground.page.evaluate(behind), "none");
    const shown = (await ground.values()).filter(({ text }) => text !== "--");
    assert.ok(shown.length > 20);
    const wrong = shown.filter(({ key, freshness }) => freshness === "live" && !OF_THE_PAGE.includes(key));
    assert.deepEqual(wrong, []);
  } finally {
    process.kill(proxy, "SIGCONT");
  }
  await ground.isLive();
  await ground.until(() => window.testSilence.changes.length >= 2, "the change back");
  const silence = await ground.page.evaluate(() => window.testSilence);
  const [gone] = silence.changes;
  assert.equal(gone.state, "silent");
  const late_s = (gone.age_ms - silence.longestStall_ms) / 1000;
  assert.ok(late_s <= WITHIN_S, JSON.stringify(silence));
  assert.deepEqual([...new Set(silence.liveWhileSilent)], []);
  t.diagnostic(`silent when the newest frame was ${Math.round(gone.age_ms)} ms old`);

  const seen = async () => (await recorded.read()).filter(({ name }) => name === "latitude").length;
  const before = await seen();
  await ground.until(
    ([count]) => window.testRecords[0].filter(({ name }) => name === "latitude").length > count,
    "the aircraft moves on",
    [before + 2],
  );
  const truth = await truthOf(showcase);
  for (const place of livePlaces(await recorded.read())) {
    const near = between(truth, place.unix_s - LIVE_LOCATION_S - WITHIN_S, place.unix_s + 0.1).map((row) =>
      distance_m(place, { latitude: row.latitude_deg, longitude: row.longitude_deg }),
    );
    assert.ok(Math.min(...near) < GPS_M, `${Math.min(...near)} m off: ${JSON.stringify(place)}`);
  }
  ground.assertClean();
});

test("a server that dies is reported, and the page reconnects", async () => {
  const words = ["serve", "--port", String(showcase.groundPort), "--listen"];
  const environment = { UP_GROUND_STATE: showcase.state };
  const first = startProgram("up-ground", [...words, "127.0.0.1:0"], { environment });
  const address = (await first.line(/(http:\/\/\S+)/))[1];
  const ground = await (await GroundPage.open(browser, address)).isLive();
  await ground.page.evaluate(watchSilence, [OF_THE_PAGE, OF_THE_PROXY]);
  await first.kill();
  await ground.until(() => document.documentElement.dataset.link === "closed", "the loss of the server");
  assert.equal(await ground.attribute("#link-banner", "data-code"), "lost");
  assert.ok(await ground.page.isVisible("#link-banner"));
  await ground.until(() => document.documentElement.dataset.aircraftState === "silent", "silence");
  await ground.until(() => document.querySelector("#link-banner-next").textContent !== "", "the next attempt");
  const second = startProgram("up-ground", [...words, new URL(address).host], { environment });
  try {
    await second.line(/(http:\/\/\S+)/);
    await ground.until(() => document.documentElement.dataset.link === "open", "the server again");
    await ground.isLive();
    assert.ok(!(await ground.page.isVisible("#link-banner")));
    const silence = await ground.page.evaluate(() => window.testSilence);
    assert.deepEqual([...new Set(silence.liveWhileSilent)], []);
  } finally {
      await second.stop();
  }
});

test("a page signs in with the key, pairs, and signs out", async () => {
  const key = "a-good-key";
  const environment = { UP_GROUND_STATE: join(showcase.folder, "other"), UP_GROUND_KEY: key };
  const words = ["serve", "--port", String(showcase.groundPort), "--listen", "127.0.0.1:0"];
  const server = startProgram("up-ground", words, { environment });
  try {
    const address = (await server.line(/(http:\/\/\S+)/))[1];
    const ground = await GroundPage.open(browser, `${address}#key=${key}`);
    const asksForKey = () => document.querySelector("#page-key")?.checkVisibility() && !document.querySelector("#page-key").disabled;
    await ground.until(asksForKey, "the field for the key");
    assert.equal(await ground.page.evaluate(() => location.href), address);
    const enter = async (field, text) => {
      await ground.page.fill(field, text);
      await ground.page.press(field, "Enter");
    };
    const isSignedIn = () => document.querySelector("#sign-out")?.checkVisibility();
    await enter("#page-key", "a-wrong-key");
    await ground.until(() => document.querySelector("#page-key").ariaInvalid === "true", "the refusal");
    await enter("#page-key", key);
    await ground.until(isSignedIn, "the session");
    assert.equal(await ground.page.evaluate(() => document.cookie), "");
    await ground.page.reload();
    await ground.until(isSignedIn, "the session after a reload");
    await ground.page.click("#panel-control summary");
    const [pairing] = readFileSync(join(showcase.state, "keys.txt"), "ascii").split("\n");
    await enter("#pairing", pairing);
    await ground.isLive();
    const isProtected = () => document.querySelector('[data-key="link.security"]').textContent === "end to end: ground (pilot)";
    await ground.until(isProtected, "the key and its role");
    await ground.page.click("#sign-out");
    await ground.until(asksForKey, "the field for the key again");
    assert.ok(!server.said.includes(key));
    // The browser reports the wrong key itself.
    assert.deepEqual(ground.seen.errors.filter((text) => !text.includes("403")), []);
    assert.deepEqual(ground.seen.violations, []);
  } finally {
    await server.stop();
  }
});

/** Where the map drew the aircraft while the page called it live. */
function livePlaces(records) {
  const now = {};
  const found = [];
  for (const { name, unix_ms, value } of records) {
    now[name] = value;
    if (name === "longitude" && value !== "" && now.state === "live") {
      const [latitude, longitude] = [Number(now.latitude), Number(value)];
      found.push({ latitude, longitude, unix_s: unix_ms / 1000 });
    }
  }
  return found;
}

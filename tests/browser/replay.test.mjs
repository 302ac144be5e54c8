// A flight that the page has shown is played again from its log.
import assert from "node:assert/strict";
import { before, test } from "node:test";

import { GroundPage } from "./support/ground_page.mjs";
import { Pilot } from "./support/pilot.mjs";
import { startProgram } from "./support/program.mjs";
import { browser, stopAfter } from "./support/setup.mjs";
import { startShowcase } from "./support/showcase.mjs";

let showcase;
let replay;
let seen;

before(async () => {
  showcase = stopAfter(await startShowcase());
});

/** The frames that a page has got, by their beacons. */
async function framesOf(ground) {
  const frames = await ground.messages("frame");
  return new Map(frames.map(({ message }) => [message.beacon, message.data]));
}

/** The link rounds to the sensors' resolution (docs/ground.md), the log does not. */
const RESOLUTION = { latitude: 1e-6, longitude: 1e-6, ailerons: 2, elevator: 2, throttle: 2, rudder: 2 };

/** A recorded value, with those of its numbers replaced that are as they were sent. */
function beside(recorded, sent) {
  if (recorded === null || typeof recorded !== "object") {
    return recorded;
  }
  return Object.fromEntries(Object.entries(recorded).map(([key, value]) => {
    const isNear = typeof value === "number" && Math.abs(value - sent[key]) <= (RESOLUTION[key] ?? 0.051);
    return [key, isNear ? sent[key] : value];
  }));
}

test("a flight is watched", async () => {
  const ground = await (await GroundPage.open(browser, showcase.address)).isLive();
  const pilot = await new Pilot(showcase).ready();
  pilot.move({ aux1: 2000, aux2: 2000, throttle: 1600, ailerons: 1850 });
  await ground.until(() => Number(document.querySelector("#horizon-ball").dataset.roll) > 25, "a bank");
  await pilot.leave();
  await ground.until(
    () => window.testMessages.filter(({ message }) => message.type === "frame").length > 40,
    "forty frames",
  );
  seen = await framesOf(ground);
  await ground.close();
  await showcase.land();
});

test("the log of that flight shows the same on the page, and takes no Commands", async (t) => {
  const words = ["replay", "last", "--folder", showcase.flights, "--listen", "127.0.0.1:0"];
  replay = stopAfter(startProgram("up-ground", words));
  const ground = await GroundPage.open(browser, (await replay.line(/(http:\/\/\S+)/))[1]);
  await ground.until(() => {
    const place = document.querySelector("#panel-replay");
    return place !== null && !place.hidden;
  }, "the bar of the replay");
  const length_s = (await ground.messages("replay")).pop().message.length_s;
  assert.ok(length_s > 3, `${length_s} s long`);
  const seek = async (value) => {
    await ground.page.fill("#replay-time", String(value));
    await ground.page.locator("#replay-time").blur();
  };
  await seek(0);
  await ground.page.selectOption("#replay-speed", "5");
  await ground.until(() => {
    const all = window.testMessages.filter(({ message }) => message.type === "replay");
    return all[all.length - 1].message.speed === 5;
  }, "the speed");
  if ((await ground.attribute("#replay-play", "data-playing")) === "false") {
    await ground.page.click("#replay-play");
  }
  await ground.until(() => Number(document.querySelector("#horizon-ball").dataset.roll) > 25, "the bank again");
  await ground.until(() => {
    const all = window.testMessages.filter(({ message }) => message.type === "replay");
    const { time_s, length_s, is_playing } = all[all.length - 1].message;
    return time_s > length_s - 0.5 || !is_playing;
  }, "the end");
  const played = await framesOf(ground);
  const common = [...played.keys()].filter((beacon) => seen.has(beacon));
  assert.ok(common.length >= 5, String(common.length));
  for (const beacon of common) {
    const [now, then] = [played.get(beacon), seen.get(beacon)];
    for (const key of ["orientation", "location", "servo", "flight_mode", "armed"]) {
      assert.deepEqual(beside(now[key], then[key]), then[key], `${key} of frame ${beacon}`);
    }
  }
  t.diagnostic(`${common.length} of ${seen.size} frames that were seen live were seen again`);
  assert.equal(await ground.page.isEnabled('[data-mode="FBW"]'), false);
  assert.equal(await ground.page.isEnabled("#arm-button"), false);
  ground.assertClean();
});

test("a replay stands still, and goes to any moment", async () => {
  const ground = await GroundPage.open(browser, (await replay.line(/(http:\/\/\S+)/))[1]);
  await ground.until(() => document.querySelector("#replay-play")?.textContent, "the bar");
  if ((await ground.attribute("#replay-play", "data-playing")) === "true") {
    await ground.page.click("#replay-play");
    await ground.until(() => document.querySelector("#replay-play").dataset.playing === "false", "standstill");
  }
  await ground.page.fill("#replay-time", "2");
  await ground.page.locator("#replay-time").blur();
  await ground.until(() => {
    const all = window.testMessages.filter(({ message }) => message.type === "replay");
    const { time_s, is_playing } = all[all.length - 1].message;
    return Math.abs(time_s - 2) < 0.3 && !is_playing;
  }, "2 s after the start");
  ground.assertClean();
});

// Pictures of a real flight on the page, for the documentation:
//   node pictures.mjs FOLDER         all
//   node pictures.mjs FOLDER fleet   several aircraft, which need no flight
import { join } from "node:path";

import { LAPTOP, PHONE, startBrowser } from "./support/browser.mjs";
import { FakeFlight } from "./support/fake_flight.mjs";
import { GroundPage } from "./support/ground_page.mjs";
import { Pilot } from "./support/pilot.mjs";
import { startShowcase } from "./support/showcase.mjs";

const [folder, only] = process.argv.slice(2);
const TRACK_M = 450;

/** Wait until the aircraft has flown some way while the page looked on. */
async function hasFlown(ground, metres) {
  await ground.until(
    (metres) => {
      const all = window.testMessages.filter(({ message }) => message.type === "frame");
      let flown_m = 0;
      for (let index = 1; index < all.length; index += 1) {
        const [one, other] = [all[index - 1].message.data.location, all[index].message.data.location];
        const north_m = (other.latitude - one.latitude) * 111320;
        flown_m += Math.hypot(north_m, (other.longitude - one.longitude) * 71550);
      }
      return flown_m > metres;
    },
    `${metres} m of flight`,
    metres,
  );
}

/** Draw a mission, upload it, and wait until some of it is flown. */
async function flyMission(ground) {
  const { page } = ground;
  await ground.untilHolder("you");
  await ground.fly("LOITER");
  await page.click("#map-draw");
  const { x, y, width, height } = await page.locator(".map-canvas").boundingBox();
  for (const [right, down] of [[0.3, 0.35], [0.7, 0.3], [0.75, 0.6], [0.3, 0.65]]) {
    await page.mouse.click(x + width * right, y + height * down);
  }
  await ground.press("#plan-upload");
  await ground.reason("#plan-note", "ack");
  await ground.answerTo(() => ground.press("#mission-start"));
  await ground.until(() => document.querySelector(".plan-point.is-flown")?.textContent === "2", "item 2");
  await page.click('#plan-table tr[data-item="2"] button');
  await ground.show("#panel-map");
}

async function take(ground, name) {
  await ground.page.evaluate(() => document.activeElement?.blur());
  await ground.page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  await ground.page.screenshot({ path: join(folder, `ground-${name}.png`) });
}

/** An aircraft for the picture of several. */
function other(latitude, longitude, heading, more) {
  const place = { latitude, longitude, altitude: 290 };
  const navigation = { ...place, height: 80, speed: 14, heading };
  const age_ms = { orientation: 12, flight: 20, location: 600, navigation: 50, heading: 40 };
  return { data: { armed: true, location: place, navigation, age_ms, ...more } };
}

async function takeFleet(browser) {
  const names = ["glider-1", "glider-2", "wing-7"];
  const hello = (name) => `UP1 aircraft=${name}`;
  const serve = names.flatMap((name) => ["--aircraft", name]);
  const flight = await FakeFlight.start({ hello: hello(names[0]), serve });
  try {
    const home = { latitude: 50.0752, longitude: 14.4362, altitude: 210 };
    flight.tell(other(50.0755, 14.4378, 88, { home }));
    (await flight.another(hello(names[1]))).write(`${JSON.stringify(other(50.0764, 14.4398, 200, {}))}\n`);
    const arduino = { connected: true, failsafe: true, flight_battery_v: 10.9 };
    (await flight.another(hello(names[2]))).write(`${JSON.stringify(other(50.0748, 14.4405, 300, { arduino }))}\n`);
    const ground = await (await GroundPage.open(browser, flight.address, { ...LAPTOP, colorScheme: "dark" })).isLive();
    await ground.takeControl();
    await ground.until(() => document.querySelectorAll(".fleet-marker").length === 2, "the others");
    await ground.until(() => document.querySelector("#other-alarm"), "the alarm");
    await ground.press("#panel-map .map-tools button[aria-label^='All']");
    await take(ground, "fleet");
  } finally {
    await flight.stop();
  }
}

const browser = await startBrowser();
if (only === "fleet") {
  await takeFleet(browser);
  await browser.close();
  process.exit();
}
const showcase = await startShowcase(["--turbulence", "light"], { isCalm: true });
try {
  await takeFleet(browser);
  const dark = { ...LAPTOP, colorScheme: "dark" };
  const ground = await (await GroundPage.open(browser, showcase.address, dark)).isLive();
  await ground.takeControl();
  await ground.answerTo(() => ground.press('[data-mode="FBW"]'));
  await hasFlown(ground, TRACK_M);
  await take(ground, "laptop");
  const phone = await (await GroundPage.open(browser, showcase.address, { ...PHONE, colorScheme: "dark" })).isLive();
  await hasFlown(phone, 40);
  await take(phone, "phone");
  await phone.close();
  const daylight = { ...LAPTOP, colorScheme: "light" };
  const bright = await (await GroundPage.open(browser, showcase.address, daylight)).isLive();
  const pilot = await new Pilot(showcase).ready();
  pilot.move({ aux1: 2000, aux2: 2000, throttle: 1600, ailerons: 1250 });
  await bright.until(() => Number(document.querySelector("#horizon-ball").dataset.roll) < -20, "a bank");
  await hasFlown(bright, 40);
  await take(bright, "daylight");
  await pilot.leave();
  await bright.close();
  const proxy = showcase.pidOf("up_proxy.main");
  process.kill(proxy, "SIGSTOP");
  try {
    await ground.until(() => /[3-9]\.\d s/.test(document.querySelector("#silence").textContent), "silence");
    await take(ground, "silent");
  } finally {
    process.kill(proxy, "SIGCONT");
  }
  await ground.isLive();
  await flyMission(ground);
  await take(ground, "mission");
} finally {
  await browser.close();
  await showcase.stop();
}

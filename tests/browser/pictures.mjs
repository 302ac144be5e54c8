// Pictures of a real flight on the page, and of its report, for the documentation:
//   node pictures.mjs FOLDER         all
//   node pictures.mjs FOLDER fleet   several aircraft, which need no flight
//   node pictures.mjs FOLDER log     a flight of the simulator in the page of up log view
import { execFileSync } from "node:child_process";
import { readdirSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

import { LAPTOP, PHONE, startBrowser } from "./support/browser.mjs";
import { FakeFlight } from "./support/fake_flight.mjs";
import { GroundPage } from "./support/ground_page.mjs";
import { Pilot } from "./support/pilot.mjs";
import { PYTHON, shortFolder, startProgram } from "./support/program.mjs";
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
  await ground.page.evaluate(() => {
    document.activeElement?.blur();
    // A press of a button scrolls to it; the picture begins with the control panel.
    document.querySelector("#panels").scrollTo(0, 0);
  });
  await ground.page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  await ground.page.screenshot({ path: join(folder, `ground-${name}.png`) });
}

/** An aircraft for the picture of several. */
function other(latitude, longitude, heading, more) {
  const place = { latitude, longitude, altitude: 290 };
  const navigation = { ...place, height: 80, speed: 14, heading };
  const age_ms = { orientation: 12, flight: 20, location: 600, navigation: 50, heading: 40 };
  return { data: { armed: true, altitude: place.altitude, location: place, navigation, age_ms, ...more } };
}

async function takeFleet(browser) {
  const names = ["glider-1", "glider-2", "wing-7"];
  const hello = (name) => `UP1 aircraft=${name}`;
  const serve = names.flatMap((name) => ["--aircraft", name]);
  const flight = await FakeFlight.start({ hello: hello(names[0]), serve });
  try {
    const home = { latitude: 50.0752, longitude: 14.4362, altitude: 210, distance: 119, bearing: 254, time_s: 9 };
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

/** The head of the report of the flight. */
async function takeReport(browser, showcase) {
  const [name] = readdirSync(showcase.flights).filter((each) => each.endsWith(".mcap"));
  const report = join(showcase.folder, "report");
  execFileSync(PYTHON, ["-m", "up.cli", "log", "report", join(showcase.flights, name), "-o", report]);
  const page = await browser.newPage({ viewport: { width: 1120, height: 1380 }, colorScheme: "light" });
  await page.goto(pathToFileURL(join(report, "report.html")).href);
  await page.screenshot({ path: join(folder, "flight-report.png") });
  await page.close();
}

/** A flight in the page of up log view, with the cursor in it. */
async function takeLogView(browser) {
  const flown = shortFolder();
  execFileSync(PYTHON, ["-m", "up_simulator", "fly", "loiter-on-arduino", "--no-picture", "--output", flown.path]);
  const flight = join(flown.path, "loiter-on-arduino", "flight.mcap");
  const server = startProgram("up", ["log", "view", flight], { environment: { XDG_CACHE_HOME: flown.path } });
  try {
    const [address] = await server.line(/http:\/\/\S+/);
    const page = await browser.newPage({ viewport: { width: 1440, height: 1000 }, colorScheme: "dark" });
    await page.goto(address);
    await page.waitForFunction(() => document.documentElement.dataset.opened);
    const { x, y, width, height } = await page.locator(".log-panel .u-over").first().boundingBox();
    await page.mouse.move(x + width * 0.6, y + height * 0.6);
    await page.waitForFunction(() => document.querySelector("[data-signal] b")?.textContent);
    await page.screenshot({ path: join(folder, "log-view.png") });
    await page.close();
  } finally {
    await server.stop();
    flown.remove();
  }
}

const browser = await startBrowser();
const alone = { fleet: takeFleet, log: takeLogView };
if (only) {
  await alone[only](browser);
  await browser.close();
  process.exit();
}
const showcase = await startShowcase(["--turbulence", "light"], { isCalm: true });
try {
  await takeFleet(browser);
  await takeLogView(browser);
  const dark = { ...LAPTOP, colorScheme: "dark" };
  const ground = await (await GroundPage.open(browser, showcase.address, dark)).isLive();
  await ground.takeControl();
  await ground.answerTo(() => ground.press('[data-mode="FBW"]'));
  const daylight = { ...LAPTOP, colorScheme: "light" };
  const bright = await (await GroundPage.open(browser, showcase.address, daylight)).isLive();
  await hasFlown(ground, TRACK_M);
  await take(ground, "laptop");
  const phone = await (await GroundPage.open(browser, showcase.address, { ...PHONE, colorScheme: "dark" })).isLive();
  await hasFlown(phone, 40);
  await take(phone, "phone");
  await phone.close();
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
  await showcase.land();
  await takeReport(browser, showcase);
} finally {
  await browser.close();
  await showcase.stop();
}

// Recorded flights on their page: curves, zoom, spectrum, map, a second flight.
import assert from "node:assert/strict";
import { before, test } from "node:test";

import { seriousFaults } from "./support/accessibility.mjs";
import { LAPTOP, openPage, outsideRequests } from "./support/browser.mjs";
import { Program, PYTHON, shortFolder, startProgram } from "./support/program.mjs";
import { browser, stopAfter } from "./support/setup.mjs";
import { until } from "./support/wait.mjs";

/** Two flights of 40 s; in the second half the roll rate is a sine of 10 deg/s and 3 Hz. */
const FLIGHTS = `
import math, sys
from pathlib import Path
from tests.flightlog.flights import BOARD, OrientationCommand
from tests.flightlog.logbook import eventful, write_flight
for number in (1, 2):
    def fill(maker):
        eventful(maker)
        rate = lambda t: 10 * math.sin(2 * math.pi * 3 * t)
        maker.every(20.0, 40.0, 0.02, lambda t: OrientationCommand(number, 2, 3, rate(t), 5, 6), BOARD)
    write_flight(Path(sys.argv[1]), number, fill)
`;
let address;

before(async () => {
  const folder = shortFolder();
  stopAfter({ stop: folder.remove });
  assert.equal(await new Program(PYTHON, ["-c", FLIGHTS, folder.path]).ended(), 0);
  const environment = { XDG_CACHE_HOME: folder.path };
  const words = ["log", "view", "1", "2", "--folder", folder.path];
  const server = stopAfter(startProgram("up", words, { environment }));
  address = (await server.line(/(http:\/\/\S+)/))[1];
});

test("two flights are drawn, zoomed, analysed and placed on the map", async () => {
  const page = await openPage(browser, address, LAPTOP);
  const shows = (condition, what, argument) =>
    until(async () => (await page.evaluate(condition, argument)) || null, () => `${what}: ${page.seen.errors}`);
  await shows(() => document.documentElement.dataset.opened, "the page");
  const curves = await page.locator(".log-panel").first().locator("[data-signal]").count();
  // The measured and the true roll of both flights.
  assert.equal(curves, 4);
  assert.equal(await page.textContent("#log-modes span"), "FBW");

  // The last 20 s alone: 3 Hz is all there is.
  const plot = await page.locator(".log-panel .u-over").first().boundingBox();
  await page.mouse.move(plot.x + plot.width * 0.55, plot.y + 20);
  await page.mouse.down();
  await page.mouse.move(plot.x + plot.width * 0.95, plot.y + 30, { steps: 4 });
  await page.mouse.up();
  const sine = () => {
    const { peakHz, amplitude } = document.querySelector("#log-spectrum .log-plot").dataset;
    return Math.abs(peakHz - 3) < 0.1 && amplitude > 8 && amplitude < 10.5;
  };
  await shows(sine, "10 deg/s at 3 Hz");
  await page.mouse.move(plot.x + plot.width * 0.5, plot.y + 20);
  const values = () => page.locator(".log-panel").first().locator("[data-signal='up.orientation.update.roll'] b").allTextContents();
  await until(async () => ((await values()).join() === "1 deg,2 deg" ? true : null), "the values under the cursor");

  await page.keyboard.press("0");
  await shows(() => document.querySelector("#log-cursor").textContent !== "", "the whole flight");
  const points = await page.$eval(".log-panel", (panel) => Number(panel.dataset.points));
  assert.ok(points <= 4 * 2 * LAPTOP.viewport.width, `${points} points`);
  const coloured = await page.$eval("#log-map canvas", (canvas) => {
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    return new Set(Array.from({ length: data.length / 4 }, (_, at) => data.slice(4 * at, 4 * at + 3).join())).size;
  });
  assert.ok(coloured > 10, `${coloured}`);

  // Texts of a log are texts.
  assert.equal(await page.locator("#log-event-list img").count(), 0);
  const mark = page.locator("#log-event-list [data-code='mark']", { hasText: "<img" });
  assert.equal(await mark.count(), 1);
  assert.deepEqual(await seriousFaults(page), []);
  assert.deepEqual([page.seen.errors, page.seen.violations, outsideRequests(page)], [[], [], []]);
});

// What every file of tests has: one browser, and flights that end with the file's last test.
import { after, before } from "node:test";

import { startBrowser } from "./browser.mjs";

/** @type {import("playwright-core").Browser} set before the file's own `before` */
export let browser;
const flights = [];

before(async () => {
  browser = await startBrowser();
});

after(async () => {
  await browser?.close();
  for (const each of flights) {
    await each.stop();
  }
});

/** Stop this once the tests are done, the newest first; returns it. */
export function stopAfter(flight) {
  flights.unshift(flight);
  return flight;
}

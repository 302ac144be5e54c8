// Debian's Chromium for machines without a screen, and pages that keep what they were asked and complained of.
import { chromium } from "playwright-core";

/** Flags against connections that the browser opens automatically. */
const FLAGS = [
  "--disable-gpu",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
];

export const LAPTOP = { viewport: { width: 1440, height: 900 } };
export const PHONE = {
  viewport: { width: 390, height: 844 },
  deviceScaleFactor: 2,
  hasTouch: true,
  isMobile: true,
};

/**
 * Start a browser with an empty profile; `close()` ends it.
 * @param {string[]} flags more of them
 */
export async function startBrowser(flags = []) {
  return chromium.launch({
    executablePath: process.env.UP_CHROMIUM ?? "/usr/bin/chromium-headless-shell",
    headless: true,
    args: [...FLAGS, ...flags],
  });
}

/**
 * Open a page in its own context: another user's browser. `page.seen` keeps its requests (URLs),
 * its errors and what the Content-Security-Policy stopped.
 * @param {import("playwright-core").Browser} browser
 * @param {string} address
 * @param {object} options of the context, such as LAPTOP and PHONE; `first`: runs before the page's
 *     own scripts
 */
export async function openPage(browser, address, { first, ...options } = LAPTOP) {
  const context = await browser.newContext({ reducedMotion: "reduce", ...options });
  const seen = { requests: [], errors: [], violations: [] };
  // Of the whole context: a page that it opened, or a worker, would be seen as well.
  context.on("request", (request) => seen.requests.push(request.url()));
  const page = await context.newPage();
  page.seen = seen;
  page.on("websocket", (socket) => seen.requests.push(socket.url()));
  page.on("pageerror", (error) => seen.errors.push(String(error.stack ?? error)));
  page.on("console", (message) => {
    if (message.type() === "error") {
      seen.errors.push(`${message.text()} (${message.location().url})`);
    }
  });
  await page.exposeFunction("tellViolation", (text) => seen.violations.push(text));
  await page.addInitScript(() => {
    document.addEventListener("securitypolicyviolation", (event) => {
      window.tellViolation(`${event.effectiveDirective} ${event.blockedURI} ${event.sample}`);
    });
  });
  if (first) {
    await page.addInitScript(first);
  }
  await page.goto(address);
  return page;
}

/** What a page asked of anybody but this machine. */
export function outsideRequests(page) {
  return page.seen.requests.filter((url) => {
    const { protocol, hostname } = new URL(url);
    const isHere = ["127.0.0.1", "localhost", "[::1]"].includes(hostname);
    return !isHere && !["data:", "blob:", "about:"].includes(protocol);
  });
}

// The eyes of the other tests: each can see what it is there to see.
import assert from "node:assert/strict";
import { createServer } from "node:http";
import { after, before, test } from "node:test";

import { seriousFaults } from "./support/accessibility.mjs";
import { openPage, outsideRequests, startBrowser } from "./support/browser.mjs";
import { until } from "./support/wait.mjs";

const PAGE = `<!doctype html><html lang="en"><head><title>Trivial</title></head>
<body><h1>Trivial</h1><img alt="a picture" src="http://192.0.2.1/picture.png"><input type="text">
<script>window.wasRun = true;</script></body></html>`;
let browser;
let server;
let address;

before(async () => {
  server = createServer((request, response) => {
    response.setHeader("Content-Type", "text/html");
    response.setHeader("Content-Security-Policy", "default-src 'none'; img-src *");
    response.statusCode = request.url === "/" ? 200 : 404;
    response.end(request.url === "/" ? PAGE : "");
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  address = `http://127.0.0.1:${server.address().port}/`;
  browser = await startBrowser();
});

after(async () => {
  await browser?.close();
  server.closeAllConnections?.();
  server.close();
});

test("a request that would leave the machine is seen", async () => {
  const page = await openPage(browser, address);
  assert.equal(await page.textContent("h1"), "Trivial");
  await until(() => outsideRequests(page).length > 0, "the request");
  assert.deepEqual(outsideRequests(page), ["http://192.0.2.1/picture.png"]);
});

test("a script that the policy stops is not run, and is reported", async () => {
  const page = await openPage(browser, address);
  await until(() => page.seen.violations.length > 0, "the violation");
  assert.match(page.seen.violations[0], /^script-src-elem inline/);
  assert.equal(await page.evaluate(() => window.wasRun), undefined);
});

test("a field without a name is a serious fault of accessibility", async () => {
  const page = await openPage(browser, address);
  assert.deepEqual((await seriousFaults(page)).map((fault) => fault.rule), ["label"]);
});

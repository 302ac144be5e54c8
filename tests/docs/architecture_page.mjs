// Which functions of the page run: node architecture_page.mjs ADDRESS prints {page: [...], click: [...]},
// each [file below static/, function].
import { LAPTOP, startBrowser } from "../browser/support/browser.mjs";
import { GroundPage } from "../browser/support/ground_page.mjs";

const browser = await startBrowser();
const ground = await (await GroundPage.open(browser, process.argv[2], LAPTOP)).isLive();
const devtools = await ground.page.context().newCDPSession(ground.page);
await devtools.send("Profiler.enable");

/** What ran while something was done. */
async function called(action) {
  await devtools.send("Profiler.startPreciseCoverage", { callCount: true, detailed: false });
  await action();
  const { result } = await devtools.send("Profiler.takePreciseCoverage");
  await devtools.send("Profiler.stopPreciseCoverage");
  const found = [];
  for (const { url, functions } of result) {
    for (const { functionName, ranges } of functions) {
      if (functionName && ranges[0].count > 0) {
        found.push([new URL(url, "file:///").pathname.slice(1), functionName]);
      }
    }
  }
  return found;
}

try {
  await ground.takeControl();
  await ground.until(() => !document.querySelector('[data-mode="FBW"]').disabled, "the mode");
  const page = await called(async () => {
    const before = await ground.page.evaluate(() => window.testMessages.length);
    await ground.until(
      (n) => window.testMessages.slice(n).filter(({ message }) => message.type === "frame").length > 2,
      "frames",
      before,
    );
    await ground.page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  });
  const click = await called(async () => {
    const { outcome } = await ground.answerTo(() => ground.press('[data-mode="FBW"]'));
    if (outcome !== "ack") {
      throw new Error(outcome);
    }
  });
  console.log(JSON.stringify({ page, click }));
} finally {
  await browser.close();
}

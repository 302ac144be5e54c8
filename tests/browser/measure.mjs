// How long a frame of telemetry takes to the screen: for the benchmark, and prints JSON for it.
//   node measure.mjs FOLDER SECONDS PERIOD_MS [option of the showcase ...]
// The flight's log stays in FOLDER; it tells when each frame was sent.
import { startBrowser } from "./support/browser.mjs";
import { GroundPage } from "./support/ground_page.mjs";
import { startShowcase } from "./support/showcase.mjs";

const [folder, seconds, period_ms, ...options] = process.argv.slice(2);

/** Note for each frame that changed the horizon when the screen had it, and how smooth it went. */
function watchPaints(length_ms) {
  const found = { painted: [], longTasks_ms: [], animationFrames: 0 };
  const ball = document.querySelector("#horizon-ball");
  const newest = () => {
    for (let index = window.testMessages.length - 1; index >= 0; index -= 1) {
      if (window.testMessages[index].message.type === "frame") {
        return window.testMessages[index];
      }
    }
    return null;
  };
  let last = newest()?.message.beacon;
  const changes = new MutationObserver(() => {
    const { at_ms, message } = newest();
    if (message.beacon === last) {
      return;
    }
    last = message.beacon;
    // The frame after the one that changed the page: by then it was on the screen.
    requestAnimationFrame(() => {
      const now_ms = performance.now();
      const unix_ms = performance.timeOrigin + now_ms;
      found.painted.push({ beacon: message.beacon, unix_ms, inPage_ms: now_ms - at_ms });
    });
  });
  changes.observe(ball, { attributes: true, subtree: true });
  new PerformanceObserver((list) => {
    found.longTasks_ms.push(...list.getEntries().map((entry) => entry.duration));
  }).observe({ type: "longtask" });
  const began_ms = performance.now();
  return new Promise((resolve) => {
    const tick = () => {
      found.animationFrames += 1;
      const passed_ms = performance.now() - began_ms;
      if (passed_ms < length_ms) {
        requestAnimationFrame(tick);
      } else {
        changes.disconnect();
        resolve({ ...found, seconds: passed_ms / 1000 });
      }
    };
    requestAnimationFrame(tick);
  });
}

const browser = await startBrowser();
try {
  const showcase = await startShowcase(options, { place: folder, isCalm: true });
  try {
    const ground = await (await GroundPage.open(browser, showcase.address)).isLive();
    await ground.takeControl();
    await ground.page.fill("#telemetry-period", period_ms);
    const answer = await ground.answerTo(() => ground.press("#telemetry-period-send"));
    if (answer.outcome !== "ack") {
      throw new Error(`the period of telemetry was not set: ${answer.shown}`);
    }
    process.stdout.write(JSON.stringify(await ground.page.evaluate(watchPaints, seconds * 1000)));
  } finally {
    await showcase.land();
  }
} finally {
  await browser.close();
}

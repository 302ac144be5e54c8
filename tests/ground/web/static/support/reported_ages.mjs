/**
 * The page's link and state without a browser: `node reported_ages.mjs ws://.../link`.
 *
 * Prints a line of JSON for each frame: how long it was on its way from the server as the page
 * believes and in truth, the same for its whole age, what the page draws, and how long the quickest
 * question took. The truth is the clock of this machine, which all programs on it share.
 */
import { Connection } from "../../../../../ground/up_ground/web/static/js/link/connection.js";
import { Store } from "../../../../../ground/up_ground/web/static/js/state/store.js";
import { Socket } from "./socket.mjs";

const now_s = () => Number(process.hrtime.bigint()) / 1e9;
const asked_s = new Map();
let quickest_s = Infinity;

class Page extends Socket {
  send(text) {
    const message = JSON.parse(text);
    if (message.type === "hello" || message.type === "ping") {
      asked_s.set(message.ping ?? "hello", now_s());
    }
    super.send(text);
  }
}

const connection = new Connection(process.argv[2], {
  memory: { get: () => null, set: () => {} },
  makeSocket: (url) => new Page(url),
  now_s,
});
const store = new Store(connection, { now_s, requestFrame: (call) => setImmediate(call) });
connection.on("message", (message) => {
  if (message.type === "welcome" || message.type === "pong") {
    const since_s = asked_s.get(message.ping ?? "hello");
    quickest_s = Math.min(quickest_s, message.sent_ms / 1000 - since_s);
  } else if (message.type === "frame") {
    const came_s = now_s();
    const told = {
      way_s: connection.way_s,
      trueWay_s: came_s - message.sent_ms / 1000,
      age_s: store.age_s(null),
      trueAge_s: came_s - message.data.sent_s,
      freshness: store.freshness(null),
      quickest_s,
    };
    process.stdout.write(`${JSON.stringify(told)}\n`);
  }
});
connection.start();

import { Backoff, now_s, TIMERS } from "./clock.js";
import { OneWayDelayEstimator } from "./one_way_delay.js";
import { storageOf } from "./storage.js";

const PING_S = 1;
const SILENT_LIMIT_S = 4;
const CONNECT_S = 5;
const PINGS_KEPT = 64;
/** The closing code of a server with too many pages, and how long to wait then. */
const FULL = 4013;
const FULL_S = 5;
/** Limit for the answer to a Command, seconds. */
const ANSWER_S = 15;
const LOST = { code: "connection_lost", reason: "the connection to the ground server was lost" };

/** The address of the WebSocket beside the page. */
export function linkAddress() {
  const address = new URL("link", location.href);
  address.protocol = address.protocol === "https:" ? "wss:" : "ws:";
  address.hash = address.search = "";
  return address.href;
}

/**
 * The page's connection to the ground server: opens, reconnects, sends requests and gets answers.
 *
 * `on(type, call)` subscribes to the server's messages of a type, and also to `open` ({welcome}),
 * `closed` ({reason, retry_s}) and `message` (each one, before all others). An exception in one
 * listener does not stop the others.
 */
export class Connection {
  #url;
  #socket = null;
  #backoff = new Backoff();
  #asks;
  #calls = new Map();
  #memory;
  #makeSocket;
  #now_s;
  #timers;
  #lastRx_s = 0;
  #began_s = 0;
  #retryAt_s = null;
  #timer = null;
  #pinger = null;
  #pings = new Map();
  #ping = 0;
  #hello_s = null;
  #way = new OneWayDelayEstimator();

  welcome = null;
  /** Whether the server refuses the connection because it has the maximum number of pages. */
  isFull = false;
  /** The page's own round trip in seconds, null until measured. */
  roundTrip_s = null;
  /** Transit time of the message being processed, in seconds. */
  way_s = 0;
  /** Which frame the page has shown: set by the page, echoed in Commands. */
  shownBeacon = () => null;

  constructor(url, parts = {}) {
    this.#url = url;
    this.#memory = parts.memory ?? storageOf("sessionStorage");
    this.#makeSocket = parts.makeSocket ?? ((address) => new WebSocket(address));
    this.#now_s = parts.now_s ?? now_s;
    this.#timers = parts.timers ?? TIMERS;
    this.#asks = new PendingCommands(this.#timers);
  }

  get isOpen() {
    return this.welcome !== null;
  }

  /** Seconds until the next attempt; null: open or trying now. */
  get retry_s() {
    return this.#retryAt_s === null ? null : Math.max(0, this.#retryAt_s - this.#now_s());
  }

  /** type: of message, or open, closed, message. Returns takes the call away. */
  on(type, call) {
    const calls = this.#calls.get(type) ?? new Set();
    this.#calls.set(type, calls.add(call));
    return () => calls.delete(call);
  }

  start() {
    this.#pinger ??= this.#timers.each(() => this.#tick(), PING_S);
    this.#attempt();
  }

  stop() {
    this.#timers.cancel(this.#pinger);
    this.#timers.cancel(this.#timer);
    this.#pinger = null;
    const socket = this.#socket;
    this.#socket = null;
    this.welcome = null;
    this.#retryAt_s = null;
    socket?.close();
    this.#asks.giveUp(LOST);
  }

  send(message) {
    if (!this.isOpen || this.#socket?.readyState !== 1) {
      return false;
    }
    this.#socket.send(JSON.stringify(message));
    return true;
  }

  /** Send a Command; the promise never fails. isForced: sent although the server does not know the name. */
  command(name, data, { aircraft = this.aircraft, isForced = false } = {}) {
    const force = isForced ? { force: true } : {};
    return this.request({ type: "command", aircraft, name, data, beacon: this.shownBeacon(), ...force });
  }

  /** Send a message that is answered by its number within limit_s; the promise never fails. */
  request(message, limit_s = ANSWER_S) {
    const { ask, answer } = this.#asks.add(limit_s);
    if (!this.send({ ask, ...message })) {
      this.#asks.take({
        ask,
        outcome: "unsent",
        code: "no_server",
        reason: "not connected to the ground server",
      });
    }
    return answer;
  }

  /** The aircraft that Commands go to: the one watched. */
  aircraft = null;

  #attempt() {
    this.#retryAt_s = null;
    this.#began_s = this.#lastRx_s = this.#now_s();
    let socket;
    try {
      socket = this.#makeSocket(this.#url);
    } catch (error) {
      this.#lost(`the address does not work: ${error.message}`);
      return;
    }
    this.#socket = socket;
    socket.onopen = () => this.#hello(socket);
    socket.onmessage = (event) => socket === this.#socket && this.#onText(event.data);
    socket.onclose = (event) => socket === this.#socket && this.#lost(event.reason, event.code);
  }

  #hello(socket) {
    const token = this.#memory.get("token");
    // Without a name the server chooses one.
    const name = this.#memory.get("name") ?? storageOf("localStorage").get("name") ?? "";
    this.#hello_s = this.#now_s();
    socket.send(JSON.stringify({ type: "hello", name, token }));
  }

  #onText(text) {
    this.#lastRx_s = this.#now_s();
    let message;
    try {
      message = JSON.parse(text);
    } catch {
      return;
    }
    if (message === null || typeof message !== "object" || typeof message.type !== "string") {
      return;
    }
    this.#timeWay(message);
    if (message.type === "welcome") {
      this.#welcomed(message);
    } else if (message.type === "pong") {
      this.#ponged(message);
    } else if (["answer", "plan.answer", "pair.answer"].includes(message.type)) {
      this.#asks.take(message);
    }
    this.#tell("message", message);
    this.#tell(message.type, message);
  }

  #welcomed(message) {
    this.welcome = message;
    this.isFull = false;
    this.#backoff.reset();
    if (typeof message.token === "string") {
      this.#memory.set("token", message.token);
    }
    this.#sendPing();
    this.#tell("open", { welcome: message });
  }

  /** Without a clock from the server, half of the round trip. */
  #timeWay(message) {
    const asked_s = message.type === "welcome" ? this.#hello_s : this.#pings.get(message.ping);
    const way_s = this.#way.take(message.sent_ms, this.#lastRx_s, asked_s ?? null);
    this.way_s = way_s ?? (this.roundTrip_s ?? 0) / 2;
  }

  #ponged(message) {
    const sent_s = this.#pings.get(message.ping);
    if (sent_s !== undefined) {
      this.roundTrip_s = this.#now_s() - sent_s;
      this.#forgetPings((ping) => ping <= message.ping);
    }
  }

  #forgetPings(isOver) {
    for (const ping of [...this.#pings.keys()].filter(isOver)) {
      this.#pings.delete(ping);
    }
  }

  #sendPing() {
    this.#ping += 1;
    this.#forgetPings((ping) => ping <= this.#ping - PINGS_KEPT);
    this.#pings.set(this.#ping, this.#now_s());
    this.send({ type: "ping", ping: this.#ping });
  }

  #tick() {
    if (this.isOpen) {
      this.#sendPing();
    }
    const now = this.#now_s();
    const isDeaf = this.isOpen && now - this.#lastRx_s > SILENT_LIMIT_S;
    const isStuck = !this.isOpen && this.#retryAt_s === null && now - this.#began_s > CONNECT_S;
    if (this.#socket !== null && (isDeaf || isStuck)) {
      this.#lost("the ground server is silent");
    }
  }

  #lost(reason, code = 0) {
    const socket = this.#socket;
    this.#socket = null;
    socket?.close();
    this.welcome = null;
    this.roundTrip_s = null;
    this.#pings.clear();
    this.#asks.giveUp(LOST);
    // A place becomes free when a page leaves: fast retries only keep the server busy.
    this.isFull = code === FULL;
    const retry_s = this.isFull ? FULL_S : this.#backoff.next_s();
    this.#retryAt_s = this.#now_s() + retry_s;
    this.#timers.cancel(this.#timer);
    this.#timer = this.#timers.once(() => this.#attempt(), retry_s);
    this.#tell("closed", { reason: String(reason ?? ""), retry_s });
  }

  #tell(type, message) {
    for (const call of this.#calls.get(type) ?? []) {
      try {
        call(message);
      } catch (error) {
        console.error(error);
      }
    }
  }
}

/** Requests that wait for their answers, each by its number. */
class PendingCommands {
  #last = 0;
  #waiting = new Map();
  #timers;

  constructor(timers) {
    this.#timers = timers;
  }

  add(limit_s) {
    this.#last += 1;
    const ask = this.#last;
    const answer = new Promise((resolve) => {
      const timer = this.#timers.once(
        () => this.take({ ask, outcome: "timeout", code: "no_answer", reason: "the ground server did not answer" }),
        limit_s,
      );
      this.#waiting.set(ask, { resolve, timer });
    });
    return { ask, answer };
  }

  take(message) {
    const waiting = this.#waiting.get(message.ask);
    if (waiting === undefined) {
      return;
    }
    this.#waiting.delete(message.ask);
    this.#timers.cancel(waiting.timer);
    waiting.resolve({ code: null, reason: "", round_trip_ms: null, data: null, ...message });
  }

  /** cause: code and reason why no answer can arrive now: the outcome of the requests is unknown. */
  giveUp(cause) {
    for (const ask of [...this.#waiting.keys()]) {
      this.take({ ask, outcome: "timeout", ...cause });
    }
  }
}

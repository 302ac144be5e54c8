// Takes the sticks of a showcase: node has no datagram sockets in the file system, Python has.
import { fileURLToPath } from "node:url";

import { Program, PYTHON } from "./program.mjs";
import { until } from "./wait.mjs";

const SCRIPT = fileURLToPath(new URL("pilot.py", import.meta.url));

/** A pilot; `seen` are the aircraft's answers so far, the newest last. */
export class Pilot {
  constructor(showcase) {
    this.seen = [];
    this._program = new Program(PYTHON, [SCRIPT, showcase.radio]);
    this._program.onLine((line) => {
      if (line.startsWith("{")) {
        this.seen.push(JSON.parse(line));
      }
    });
  }

  /** What the aircraft answered last. */
  get now() {
    return this.seen[this.seen.length - 1];
  }

  /** Wait for its first answer. */
  async ready() {
    await until(
      () => this.seen.length > 0,
      () => `the aircraft's answer to a radio:\n${this._program.said}`,
    );
    return this;
  }

  /**
   * Move sticks, for example `{ailerons: 1700}` (us); null gives them back.
   */
  move(sticks) {
    this._program.write(`${JSON.stringify(sticks)}\n`);
  }

  /** Wait until the aircraft does something. */
  async until(condition, what) {
    return until(
      () => condition(this.now) || null,
      () => `${what}: ${JSON.stringify(this.now)}`,
    );
  }

  /** Give the sticks back and go. */
  async leave() {
    this._program.endInput();
    return this._program.ended();
  }
}

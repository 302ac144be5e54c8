// The real proxy, the real server of the page, and an aircraft that sends what a test defines.
import { fileURLToPath } from "node:url";

import { Flight } from "./flight.mjs";
import { Program, PYTHON } from "./program.mjs";

const AIRCRAFT = fileURLToPath(new URL("aircraft.py", import.meta.url));

/** An aircraft in words alone; it starts with a `hello` and with options of the server. */
export class FakeFlight extends Flight {
  /** Let the aircraft say this from now on: `{data}`, `{data, whole: true}`, `{nack}`. */
  tell(what) {
    this.aircraft.write(`${JSON.stringify(what)}\n`);
  }

  /** Start one more aircraft behind the same proxy; a program that `tell`s as this one's. */
  async another(hello) {
    const aircraft = this._runs(new Program(PYTHON, [AIRCRAFT, this.airbornePort, hello]));
    await aircraft.line(/speaks/);
    return aircraft;
  }

  async _start({ hello = "UP1 aircraft=default", serve = [] }) {
    await this._startProxy();
    this.aircraft = await this.another(hello);
    await this._startServer(serve);
  }
}

// The real proxy, the real server of the page, and an aircraft that sends what a test defines.
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

import { Program, PYTHON, shortFolder, startProgram } from "./program.mjs";

const AIRCRAFT = fileURLToPath(new URL("aircraft.py", import.meta.url));

/** An aircraft in words alone, behind a real proxy, on a page; `address` is the page's. */
export class FakeFlight {
  _others = [];

  /** Start all of it: `names` are the aircraft that the server watches. */
  static async start({ hello = "UP1 aircraft=default", serve = [] } = {}) {
    const flight = new FakeFlight();
    try {
      await flight._start(hello, serve);
    } catch (error) {
      await flight.stop();
      throw error;
    }
    return flight;
  }

  /** Let the aircraft say this from now on: `{data}`, `{data, whole: true}`, `{nack}`. */
  tell(what) {
    this.aircraft.write(`${JSON.stringify(what)}\n`);
  }

  /** Start one more aircraft behind the same proxy; a program that `tell`s as this one's. */
  async another(hello) {
    const aircraft = new Program(PYTHON, [AIRCRAFT, this.airbornePort, hello]);
    this._others.push(aircraft);
    await aircraft.line(/speaks/);
    return aircraft;
  }

  /** End all of it. */
  async stop() {
    const programs = [this.server, this.aircraft, ...this._others, this.proxy].filter(Boolean);
    for (const each of programs) {
      await each.stop();
    }
    this._folder.remove();
    const wrong = programs.find((each) => each.said.includes("Traceback"));
    if (wrong) {
      throw new Error(wrong.said);
    }
  }

  async _start(hello, serve) {
    this._folder = shortFolder();
    const config = join(this._folder.path, "config");
    mkdirSync(config);
    writeFileSync(join(config, "proxy.yml"), "metrics: false\n");
    const anywhere = ["--airborne-port", "0", "--ground-port", "0"];
    this.proxy = startProgram("up-proxy", ["--config", config, ...anywhere]);
    this.airbornePort = (await this.proxy.line(/airborne side listens on port (\d+)/))[1];
    this.groundPort = (await this.proxy.line(/ground side listens on port (\d+)/))[1];
    this.aircraft = new Program(PYTHON, [AIRCRAFT, this.airbornePort, hello]);
    await this.aircraft.line(/speaks/);
    const words = ["--port", this.groundPort, "serve", "--listen", "127.0.0.1:0", ...serve];
    this.server = startProgram("up-ground", words, {
      environment: { XDG_STATE_HOME: this._folder.path },
    });
    this.address = (await this.server.line(/(http:\/\/\S+)/))[1];
  }
}

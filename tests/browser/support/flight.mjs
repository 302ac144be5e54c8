// The real proxy and the real server of the page, with an aircraft that a subclass starts.
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { shortFolder, startProgram } from "./program.mjs";

/** Programs started each by hand as in a guide; `address` is the page's. */
export class Flight {
  _folder = shortFolder();
  _programs = [];

  /** Start all of it, or nothing. */
  static async start(options = {}) {
    const flight = new this();
    try {
      await flight._start(options);
    } catch (error) {
      await flight.stop();
      throw error;
    }
    return flight;
  }

  /** End all of it, the newest first. */
  async stop() {
    for (const each of this._programs) {
      await each.stop();
    }
    this._folder.remove();
    const wrong = this._programs.find((each) => each.said.includes("Traceback"));
    if (wrong) {
      throw new Error(wrong.said);
    }
  }

  _runs(program) {
    this._programs.unshift(program);
    return program;
  }

  /** Write one of the configuration's files. */
  _configure(name, ...lines) {
    this._config = join(this._folder.path, "config");
    mkdirSync(this._config, { recursive: true });
    writeFileSync(join(this._config, name), `${lines.join("\n")}\n`);
  }

  async _startProxy() {
    this._configure("proxy.yml", "metrics: false");
    const words = ["--config", this._config, "--airborne-port", "0", "--ground-port", "0"];
    const proxy = this._runs(startProgram("up-proxy", words));
    this.airbornePort = (await proxy.line(/airborne side listens on port (\d+)/))[1];
    this.groundPort = (await proxy.line(/ground side listens on port (\d+)/))[1];
  }

  async _startServer(options = [], more = {}) {
    const words = ["--port", this.groundPort, "serve", "--listen", "127.0.0.1:0", ...options];
    const environment = { XDG_STATE_HOME: this._folder.path, ...more };
    const server = this._runs(startProgram("up-ground", words, { environment }));
    this.address = (await server.line(/(http:\/\/\S+)/))[1];
  }
}

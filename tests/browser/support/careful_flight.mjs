// An aircraft as configured for real flights: gains cannot be set in flight.
import { join } from "node:path";

import { Flight } from "./flight.mjs";
import { Program, PYTHON, startProgram } from "./program.mjs";

/** Simulator and daemon, without a phone. */
export class CarefulFlight extends Flight {
  async _start() {
    await this._startProxy();
    const board = join(this._folder.path, "board");
    const options = ["--board", "host", "--no-phone", "--pty-link", board];
    await this._runs(startProgram("up-sim", ["start", ...options])).line(/aboard/, 300);
    this._configure("config.yml", "flight controller: arduino");
    this._configure("arduino.yml", `port: ${board}`);
    this._configure("android.yml", "general port: 0", "orientation port: 0");
    this._configure("discovery.yml", "port: 0");
    this._configure("black_box.yml", "enabled: false");
    const server = ["remote_server:", "  url: 127.0.0.1", `  port: ${this.airbornePort}`];
    this._configure("mission_control.yml", ...server, "role: pilot", "tune_in_flight: false");
    this._runs(new Program(PYTHON, ["main.py", "--config", this._config]));
    await this._startServer();
  }
}

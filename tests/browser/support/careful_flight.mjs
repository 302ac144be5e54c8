// An aircraft as configured for real flights: gains cannot be set in flight.
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { Program, PYTHON, shortFolder, startProgram } from "./program.mjs";

/**
 * Start proxy, aircraft, daemon and the page's server, each by hand as in a guide.
 * @returns {Promise<{address: string, stop: () => Promise<void>}>}
 */
export async function startCarefulFlight() {
  const folder = shortFolder();
  const config = join(folder.path, "config");
  const board = join(folder.path, "board");
  const programs = [];
  const started = (program) => {
    programs.unshift(program);
    return program;
  };
  const write = (name, lines) => writeFileSync(join(config, name), `${lines.join("\n")}\n`);
  const stop = async () => {
    for (const each of programs) {
      await each.stop();
    }
    folder.remove();
  };
  try {
    mkdirSync(config);
    write("proxy.yml", ["metrics: false"]);
    const anywhere = ["--airborne-port", "0", "--ground-port", "0"];
    const proxy = started(startProgram("up-proxy", ["--config", config, ...anywhere]));
    const [, airborne] = await proxy.line(/airborne side listens on port (\d+)/);
    const [, ground] = await proxy.line(/ground side listens on port (\d+)/);
    const options = ["--board", "host", "--no-phone", "--pty-link", board];
    const aircraft = started(startProgram("up-sim", ["start", ...options]));
    await aircraft.line(/aboard/, 300);
    write("config.yml", ["flight controller: arduino"]);
    write("arduino.yml", [`port: ${board}`]);
    write("android.yml", ["general port: 0", "orientation port: 0"]);
    write("discovery.yml", ["port: 0"]);
    write("black_box.yml", ["enabled: false"]);
    const server = ["remote_server:", "  url: 127.0.0.1", `  port: ${airborne}`];
    write("mission_control.yml", [...server, "role: pilot", "tune_in_flight: false"]);
    started(new Program(PYTHON, ["main.py", "--config", config]));
    const words = ["--port", ground, "serve", "--listen", "127.0.0.1:0"];
    const environment = { XDG_STATE_HOME: folder.path };
    const page = started(startProgram("up-ground", words, { environment }));
    return { address: (await page.line(/(http:\/\/\S+)/))[1], stop };
  } catch (error) {
    await stop();
    throw error;
  }
}

// The real daemon with an application and a cog of the tests' own, behind the real proxy, on a page.
import { cpSync, mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { ROOT, run, shortFolder, startProgram } from "./program.mjs";

const FIXTURE = join(ROOT, "tests", "fixtures", "extend");

/** `address` is the page's; `daemon`, `proxy`, `server` are the programs. */
export class ExtendedFlight {
  static async start() {
    const flight = new ExtendedFlight();
    try {
      await flight._start();
    } catch (error) {
      await flight.stop();
      throw error;
    }
    return flight;
  }

  /** End all of it. */
  async stop() {
    const programs = [this.server, this.daemon, this.proxy].filter(Boolean);
    for (const each of programs) {
      await each.stop();
    }
    this._folder.remove();
    const wrong = programs.find((each) => each.said.includes("Traceback"));
    if (wrong) {
      throw new Error(wrong.said);
    }
  }

  async _start() {
    this._folder = shortFolder();
    const folder = this._folder.path;
    const environment = {
      PYTHONPATH: join(FIXTURE, "cog"),
      PYTHONDONTWRITEBYTECODE: "yes",
      XDG_STATE_HOME: folder,
    };
    mkdirSync(join(folder, "proxy"));
    writeFileSync(join(folder, "proxy", "proxy.yml"), "metrics: false\n");
    const anywhere = ["--airborne-port", "0", "--ground-port", "0"];
    this.proxy = startProgram("up-proxy", ["--config", join(folder, "proxy"), ...anywhere]);
    const airborne = (await this.proxy.line(/airborne side listens on port (\d+)/))[1];
    const ground = (await this.proxy.line(/ground side listens on port (\d+)/))[1];
    const application = join(folder, "application");
    cpSync(join(FIXTURE, "application"), application, { recursive: true });
    mkdirSync(join(application, "config"));
    const link = `remote_server:\n  url: 127.0.0.1\n  port: ${airborne}\nrole: pilot\n`;
    writeFileSync(join(application, "config", "mission_control.yml"), link);
    for (const cog of ["mission_control_cog", "tow_cog"]) {
      const { status, said } = await run("up", ["-f", application, "register", "-n", cog], { environment });
      if (status !== 0) {
        throw new Error(said);
      }
    }
    this.daemon = startProgram("up", ["-f", application, "start"], { environment });
    const words = ["--port", ground, "serve", "--listen", "127.0.0.1:0"];
    this.server = startProgram("up-ground", words, { environment });
    this.address = (await this.server.line(/(http:\/\/\S+)/))[1];
  }
}

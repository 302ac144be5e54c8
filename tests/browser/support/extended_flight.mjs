// The real daemon with an application and a cog of the tests' own, behind the real proxy, on a page.
import { cpSync, mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { Flight } from "./flight.mjs";
import { ROOT, run, startProgram } from "./program.mjs";

const FIXTURE = join(ROOT, "tests", "fixtures", "extend");

/** `daemon` is the program. */
export class ExtendedFlight extends Flight {
  async _start() {
    await this._startProxy();
    const folder = this._folder.path;
    const environment = {
      PYTHONPATH: join(FIXTURE, "cog"),
      PYTHONDONTWRITEBYTECODE: "yes",
      XDG_STATE_HOME: folder,
    };
    const application = join(folder, "application");
    cpSync(join(FIXTURE, "application"), application, { recursive: true });
    mkdirSync(join(application, "config"));
    const link = `remote_server:\n  url: 127.0.0.1\n  port: ${this.airbornePort}\nrole: pilot\n`;
    writeFileSync(join(application, "config", "mission_control.yml"), link);
    for (const cog of ["mission_control_cog", "tow_cog"]) {
      const { status, said } = await run("up", ["-f", application, "register", "-n", cog], { environment });
      if (status !== 0) {
        throw new Error(said);
      }
    }
    this.daemon = this._runs(startProgram("up", ["-f", application, "start"], { environment }));
    await this._startServer([], environment);
  }
}

// `make run` for a test: the showcase with its own ports, in its own folder.
import { existsSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { childrenOf, Program, PYTHON, shortFolder } from "./program.mjs";

const CALM = "panic threshold: 100\ncalm down threshold: 99\n";
const ADDRESS = /(http:\/\/[^\s/]+\/?\S*)/;

/** A flight under way. */
export class Showcase {
  constructor(folder, program) {
    this._folder = folder;
    this.program = program;
  }

  /** The folder of its configuration, its logs and the radio's socket. */
  get folder() {
    return this._folder.path;
  }

  /** The folder with its ground station's key. */
  get state() {
    return join(this.folder, "ground");
  }

  /** Where the radio's sticks are taken over. */
  get radio() {
    return join(this.folder, "radio");
  }

  /** The processes it has started: `{pid, words}`. */
  get children() {
    return childrenOf(this.program.pid);
  }

  /** The number of the process that was started with such a word. */
  pidOf(word) {
    const found = this.children.find(({ words }) => words.includes(word));
    if (!found) {
      throw new Error(`no ${word} among ${JSON.stringify(this.children)}`);
    }
    return found.pid;
  }

  /** What one of its parts has said so far. */
  log(name) {
    const path = join(this.folder, `${name}.log`);
    return existsSync(path) ? readFileSync(path, "utf8") : "";
  }

  /** The true state as written so far: one object a line, numbers by the column's name. */
  truth() {
    const [head, ...lines] = readFileSync(join(this.folder, "truth.csv"), "ascii").split("\n");
    const names = head.split(",");
    // The last line may be half written.
    return lines.slice(0, -1).map((line) => {
      const values = line.split(",").map(Number);
      return Object.fromEntries(names.map((name, index) => [name, values[index]]));
    });
  }

  /** Where the flights are that its black box has recorded. */
  get flights() {
    return join(this.folder, "flights");
  }

  /** End the flight; what it has written stays. */
  async land() {
    const status = await this.program.stop();
    if (status !== 0) {
      throw new Error(`the showcase ended with ${status}:\n${this.program.said}`);
    }
  }

  /** End it, and take away what it has written. */
  async stop() {
    try {
      await this.land();
    } catch (error) {
      this._folder.remove();
      throw error;
    }
    const logs = readdirSync(this.folder).filter((name) => name.endsWith(".log"));
    const wrong = logs.filter((name) => this.log(name.slice(0, -4)).includes("Traceback"));
    const text = wrong.map((name) => this.log(name.slice(0, -4)).slice(-3000)).join("\n");
    this._folder.remove();
    if (text) {
      throw new Error(`a traceback in ${wrong}:\n${text}`);
    }
  }
}

/**
 * Start everything that `make run` starts and wait until it flies.
 * @param {string[]} options more of the showcase's options
 * @param {{place?: string, isCalm?: boolean}} more place: for its configuration and logs, which
 *   stay, else in a folder that `stop` removes; isCalm: a busy machine makes no panic, as browser
 *   and aircraft share it here and not in the field
 * @returns {Promise<Showcase>} with `address` of the page, and `groundPort`, `airbornePort`
 */
export async function startShowcase(options = [], { place = "", isCalm = false } = {}) {
  const folder = place ? { path: place, remove: () => {} } : shortFolder();
  if (isCalm) {
    mkdirSync(join(folder.path, "config"));
    writeFileSync(join(folder.path, "config", "load_guard.yml"), CALM);
  }
  const words = ["-m", "up_simulator.demo", "--no-watch", "--any-ports"];
  words.push("--folder", folder.path, "--board", "host");
  words.push("--state-log", join(folder.path, "truth.csv"), ...options);
  const program = new Program(PYTHON, words);
  const showcase = new Showcase(folder, program);
  try {
    const [, airborne, ground] = await program.line(/aircraft on port (\d+), ground on port (\d+)/);
    showcase.airbornePort = Number(airborne);
    showcase.groundPort = Number(ground);
    await program.line(/Ctrl-C stops everything/, 300);
    showcase.address = (await program.line(ADDRESS))[1];
  } catch (error) {
    await program.kill();
    folder.remove();
    throw error;
  }
  return showcase;
}

// The project's programs, started as a user starts them, with what they say kept.
import { spawn } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

import { until } from "./wait.mjs";

export const ROOT = fileURLToPath(new URL("../../../", import.meta.url));
/** The interpreter of the virtual environment, whose folder has the project's programs. */
export const PYTHON = process.env.UP_PYTHON ?? join(ROOT, ".venv", "bin", "python");
const STOP_LIMIT_S = 20;
const running = new Set();

process.on("exit", () => {
  for (const each of running) {
    each.kill("SIGTERM");
  }
});

/** A running program; `lines` grows while it speaks. */
export class Program {
  /**
   * @param {string} command
   * @param {string[]} words
   * @param {{environment?: Record<string, string>}} more
   */
  constructor(command, words, { environment = {} } = {}) {
    this.lines = [];
    this.status = null;
    this._listeners = new Set();
    this._process = spawn(command, words, {
      cwd: ROOT,
      env: { ...userEnvironment(), PYTHONUNBUFFERED: "1", ...environment },
      stdio: ["pipe", "pipe", "pipe"],
    });
    running.add(this._process);
    this._process.on("error", (error) => this.lines.push(String(error)));
    this._ended = new Promise((resolve) => {
      this._process.on("close", (status, signal) => {
        running.delete(this._process);
        this.status = status ?? signal;
        resolve(this.status);
      });
    });
    this._process.stdin.on("error", () => {});
    for (const stream of [this._process.stdout, this._process.stderr]) {
      this._read(stream);
    }
  }

  get pid() {
    return this._process.pid;
  }

  /** Everything it has said, as one text. */
  get said() {
    return this.lines.join("\n");
  }

  /** Call for each whole line from now on. */
  onLine(call) {
    this._listeners.add(call);
  }

  write(text) {
    this._process.stdin.write(text);
  }

  /** End its standard input. */
  endInput() {
    this._process.stdin.end();
  }

  /**
   * Wait until a line matches, and return the match.
   * @param {RegExp} pattern
   */
  async line(pattern, limit_s) {
    const find = () => {
      for (const line of this.lines) {
        const found = pattern.exec(line);
        if (found) {
          return found;
        }
      }
      if (this.status !== null) {
        throw new Error(`it ended with ${this.status} and said:\n${this.said}`);
      }
      return null;
    };
    return until(find, () => `${pattern} in:\n${this.said}`, limit_s);
  }

  /** Wait for its end and return the status. */
  async ended() {
    return this._ended;
  }

  /** Ask it to end, force it after a time, and return the status. */
  async stop() {
    if (this.status === null) {
      this._process.kill("SIGTERM");
      const forced = setTimeout(() => this._process.kill("SIGKILL"), STOP_LIMIT_S * 1000);
      await this._ended;
      clearTimeout(forced);
    }
    return this.status;
  }

  /** Kill it as a power cut does. */
  async kill() {
    this._process.kill("SIGKILL");
    return this._ended;
  }

  _read(stream) {
    let begun = "";
    stream.setEncoding("utf8");
    stream.on("data", (text) => {
      const lines = (begun + text).split("\n");
      begun = lines.pop();
      for (const line of lines) {
        this.lines.push(line);
        for (const call of this._listeners) {
          call(line);
        }
      }
    });
    stream.on("end", () => {
      if (begun) {
        this.lines.push(begun);
      }
    });
  }
}

/**
 * Start one of the project's console programs, for example `up-ground`.
 * @param {string} name
 * @param {string[]} words
 */
export function startProgram(name, words, more) {
  return new Program(join(dirname(PYTHON), name), words, more);
}

/** Run a program to its end; returns its status and what it said. */
export async function run(name, words, more) {
  const program = startProgram(name, words, more);
  const status = await program.ended();
  return { status, said: program.said };
}

/** A folder with a path short enough for sockets in it; `remove()` takes it away. */
export function shortFolder() {
  const path = mkdtempSync(join(tmpdir(), "upb-"));
  return { path, remove: () => rmSync(path, { recursive: true, force: true }) };
}

/** The processes that a process has started, as `{pid, words}`. */
export function childrenOf(pid) {
  const found = [];
  for (const name of readdirSync("/proc")) {
    if (!/^\d+$/.test(name)) {
      continue;
    }
    try {
      const fields = readFileSync(`/proc/${name}/stat`, "latin1").split(") ").pop().split(" ");
      if (Number(fields[1]) === pid) {
        const words = readFileSync(`/proc/${name}/cmdline`, "utf8").split("\0");
        found.push({ pid: Number(name), words: words.slice(0, -1) });
      }
    } catch {
      // It has ended already.
    }
  }
  return found;
}

function userEnvironment() {
  const kept = Object.entries(process.env).filter(
    ([name]) => !name.startsWith("UP_GROUND_") && name !== "NODE_TEST_CONTEXT",
  );
  return Object.fromEntries(kept);
}

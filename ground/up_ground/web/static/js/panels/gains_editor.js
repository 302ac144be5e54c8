/** The greatest gain; the least is 0 (docs/protocols.md 5). */
export const MAX_GAIN = 50;

/** The loops of a set that a controller uses, in the order of the wire. */
export const LOOPS = [
  { key: "ratePIDs", word: "rate", unit: "1.25 us of servo per deg/s" },
  { key: "stabPIDs", word: "stabilize", unit: "deg/s per deg" },
];

export const AXES = [
  { key: "ailerons", word: "roll" },
  { key: "elevator", word: "pitch" },
  { key: "rudder", word: "yaw" },
];

/** Whether a controller uses its gains; the others are sent as received. */
export function isUsed(loop, axis) {
  return loop.key !== "stabPIDs" || axis.key !== "rudder";
}

export const TERMS = ["p", "i", "d"];

/** Each gain of a set by its path, as `ratePIDs.ailerons.p`. */
export function cellsOf(set) {
  const cells = new Map();
  for (const loop of LOOPS) {
    for (const axis of AXES) {
      for (const term of TERMS) {
        const value = set?.[loop.key]?.[axis.key]?.[term];
        if (typeof value === "number" && Number.isFinite(value)) {
          cells.set(`${loop.key}.${axis.key}.${term}`, value);
        }
      }
    }
  }
  return cells;
}

export function setOf(cells) {
  const set = {};
  for (const [path, value] of cells) {
    const [loop, axis, term] = path.split(".");
    set[loop] ??= {};
    set[loop][axis] ??= {};
    set[loop][axis][term] = value;
  }
  return set;
}

/** As `rate roll P`. */
export function cellText(path) {
  const [loop, axis, term] = path.split(".");
  const word = (list, key) => list.find((each) => each.key === key)?.word ?? key;
  return `${word(LOOPS, loop)} ${word(AXES, axis)} ${term.toUpperCase()}`;
}

/** Six figures at most, one decimal at least: single precision has digits beyond those entered. */
export function gainText(value) {
  const short = String(Number(value.toPrecision(6)));
  return /^-?\d+$/.test(short) ? `${short}.0` : short;
}

/** Problem: why it is not a gain, empty when it is one. */
export function readGain(written) {
  const text = written.trim();
  if (text === "") {
    return { value: NaN, problem: "is empty" };
  }
  if (!/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(text)) {
    const hint = text.includes(",") ? "; write a point, as in 2.4" : "";
    return { value: NaN, problem: `is not a number${hint}` };
  }
  const value = Number(text);
  if (value < 0 || value > MAX_GAIN) {
    return { value: NaN, problem: `must be 0 to ${MAX_GAIN}` };
  }
  return { value, problem: "" };
}

export function difference(before, after) {
  const found = [];
  for (const [path, value] of after) {
    const old = before.get(path);
    if (old !== undefined && gainText(old) !== gainText(value)) {
      found.push({ path, before: old, after: value, words: changeText(path, old, value) });
    }
  }
  return found;
}

function changeText(path, before, after) {
  const change = `${cellText(path)} ${gainText(before)} → ${gainText(after)}`;
  if (before === 0) {
    return `${change}, was off`;
  }
  if (after === 0) {
    return `${change}, off`;
  }
  const percent = (after / before - 1) * 100;
  const figures = Math.abs(percent) < 9.95 && !Number.isInteger(Number(percent.toFixed(1))) ? 1 : 0;
  return `${change}, ${percent > 0 ? "+" : "−"}${Math.abs(percent).toFixed(figures)} %`;
}

/**
 * The edited gains beside the active ones.
 *
 * An edited cell remembers the active value at the time of the edit. When the active value changes
 * after that, the cell keeps the input and the two are a conflict.
 */
export class GainsEditor {
  #flying = new Map();
  #edits = new Map();

  get flying() {
    return this.#flying;
  }

  /** Whether anything was written that is not flying. */
  get isEdited() {
    return this.#edits.size > 0;
  }

  /** set: the active gains; an input equal to the active value is not an edit. */
  takeFlying(set) {
    this.#flying = cellsOf(set);
    for (const [path, edit] of this.#edits) {
      const flying = this.#flying.get(path);
      const { value, problem } = readGain(edit.written);
      if (flying === undefined || (!problem && gainText(value) === gainText(flying))) {
        this.#edits.delete(path);
      }
    }
  }

  write(path, written) {
    const flying = this.#flying.get(path);
    const seen = this.#edits.get(path)?.seen ?? flying;
    const { value, problem } = readGain(written);
    if (flying === undefined || (!problem && gainText(value) === gainText(flying))) {
      this.#edits.delete(path);
    } else {
      this.#edits.set(path, { written, seen });
    }
  }

  discard() {
    this.#edits.clear();
  }

  /** Accept the conflicts as seen: the present active values become the base of the edits. */
  accept() {
    for (const [path, edit] of this.#edits) {
      edit.seen = this.#flying.get(path);
    }
  }

  textOf(path) {
    const flying = this.#flying.get(path);
    return this.#edits.get(path)?.written ?? (flying === undefined ? "" : gainText(flying));
  }

  isCellEdited(path) {
    return this.#edits.has(path);
  }

  get problems() {
    return [...this.#edits]
      .map(([path, { written }]) => ({ path, problem: readGain(written).problem }))
      .filter(({ problem }) => problem)
      .map(({ path, problem }) => ({ path, words: `${cellText(path)} ${problem}` }));
  }

  /** Edited cells whose active value has changed. */
  get conflicts() {
    const found = [];
    for (const [path, { written, seen }] of this.#edits) {
      const flying = this.#flying.get(path);
      if (flying !== undefined && gainText(flying) !== gainText(seen)) {
        const words = `${cellText(path)}: ${gainText(flying)} flies now, it was ${gainText(seen)} when you wrote ${written.trim()}`;
        found.push({ path, words });
      }
    }
    return found;
  }

  /** The changes to send; cells without a gain left out. */
  get difference() {
    return difference(this.#flying, this.#wanted());
  }

  get wanted() {
    return this.isEdited && this.problems.length === 0 ? setOf(this.#wanted()) : null;
  }

  // Untouched values go back exactly as received, with every digit.
  #wanted() {
    const cells = new Map(this.#flying);
    for (const [path, { written }] of this.#edits) {
      const { value, problem } = readGain(written);
      if (!problem) {
        cells.set(path, value);
      }
    }
    return cells;
  }
}

/** The set that flew before the one that flies now. history: oldest first. Returns null: not known. */
export function setBefore(history, flying) {
  for (const entry of [...history].reverse()) {
    if (entry.outcome !== "ack" || !entry.before || !entry.after) {
      continue;
    }
    const after = cellsOf(entry.after);
    return after.size === flying.size && difference(after, flying).length === 0 ? entry.before : null;
  }
  return null;
}

import { cellsOf, cellText, difference, gainText, readGain, setOf } from "./gain_set.js";

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

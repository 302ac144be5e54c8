import { cellsOf, cellWords, difference, gainText, readGain, setOf } from "./gain_set.js";

/**
 * What is being edited, beside what is flying.
 *
 * An edited cell remembers the flying value that its writer saw. When another value flies from
 * then on, the cell keeps what was written and the two are a conflict.
 */
export class GainsEditor {
  #flying = new Map();
  #edits = new Map();

  /** @returns {Map<string, number>} the flying gains by their paths */
  get flying() {
    return this.#flying;
  }

  /** @returns {boolean} whether anything was written that is not flying */
  get isEdited() {
    return this.#edits.size > 0;
  }

  /** @param {object|null} set what flies now; a value that was written and flies now is no edit */
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

  /**
   * @param {string} path
   * @param {string} written
   */
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

  /** Take everything back that was written. */
  discard() {
    this.#edits.clear();
  }

  /** Say that the conflicts have been seen: what flies now is what the writer starts from. */
  accept() {
    for (const [path, edit] of this.#edits) {
      edit.seen = this.#flying.get(path);
    }
  }

  /** @returns {string} what stands in a cell */
  textOf(path) {
    const flying = this.#flying.get(path);
    return this.#edits.get(path)?.written ?? (flying === undefined ? "" : gainText(flying));
  }

  /** @returns {boolean} whether a cell holds something else than what flies */
  isCellEdited(path) {
    return this.#edits.has(path);
  }

  /** @returns {{path: string, words: string}[]} cells that hold no gain */
  get problems() {
    return [...this.#edits]
      .map(([path, { written }]) => ({ path, problem: readGain(written).problem }))
      .filter(({ problem }) => problem)
      .map(({ path, problem }) => ({ path, words: `${cellWords(path)} ${problem}` }));
  }

  /** @returns {{path: string, words: string}[]} cells whose flying value changed meanwhile */
  get conflicts() {
    const found = [];
    for (const [path, { written, seen }] of this.#edits) {
      const flying = this.#flying.get(path);
      if (flying !== undefined && gainText(flying) !== gainText(seen)) {
        const words = `${cellWords(path)}: ${gainText(flying)} flies now, it was ${gainText(seen)} when you wrote ${written.trim()}`;
        found.push({ path, words });
      }
    }
    return found;
  }

  /** @returns {ReturnType<typeof difference>} what sending would change; cells without a gain left out */
  get difference() {
    return difference(this.#flying, this.#wanted());
  }

  /** @returns {object|null} the whole set to send; null: nothing to send, or a cell holds no gain */
  get wanted() {
    return this.isEdited && this.problems.length === 0 ? setOf(this.#wanted()) : null;
  }

  // What was not touched goes back exactly as it came, with every figure.
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

/**
 * The set that flew before the one that flies now.
 * @param {{before: ?object, after: ?object, outcome: string}[]} history oldest first
 * @param {Map<string, number>} flying
 * @returns {object|null} null: not known
 */
export function setBefore(history, flying) {
  for (const entry of [...history].reverse()) {
    if (entry.outcome !== "ack" || !entry.before || !entry.after) {
      continue;
    }
    return isSame(cellsOf(entry.after), flying) ? entry.before : null;
  }
  return null;
}

function isSame(one, other) {
  return one.size === other.size && difference(one, other).length === 0;
}

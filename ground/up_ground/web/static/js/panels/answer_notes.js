import { setAttribute, setText } from "../readout.js";
import { agoWords } from "./words.js";

/** From then on an answer shows its age. */
const AGED_S = 5;
/** From then on it is grey. */
const OLD_S = 15;
/** Then it is removed: the request is listed among the events. */
const GONE_S = 120;

/**
 * The answers of Commands on the page: each with its age, grey after a while, then removed. They
 * are removed immediately when their subject goes: the connection, control, the aircraft.
 */
export class AnswerNotes {
  #store;
  #notes = new Map();
  #aircraft;
  #wasHolder = false;

  constructor(store, connection) {
    this.#store = store;
    this.#aircraft = store.aircraft;
    // Requests in flight get a note afterwards: their outcome is unknown.
    connection.on("closed", () => this.clear());
    store.subscribe(() => this.look());
  }

  tell(note, text, look) {
    tell(note, text, look);
    this.#notes.set(note, { text, at_s: this.#store.now_s });
    showAge(note, "", false);
  }

  /** Grey out stale answers, and remove those that are over. */
  look() {
    const { aircraft, now_s } = this.#store;
    const isHolder = this.#store.status?.control?.holder === "you";
    if (aircraft !== this.#aircraft || (this.#wasHolder && !isHolder)) {
      this.clear();
    }
    this.#aircraft = aircraft;
    this.#wasHolder = isHolder;
    for (const [note, { text, at_s }] of this.#notes) {
      const age_s = now_s - at_s;
      if (note.textContent !== text) {
        // The note has another text now, for instance an error of the input.
        this.#forget(note);
      } else if (age_s >= GONE_S) {
        this.#empty(note);
      } else {
        showAge(note, age_s >= AGED_S ? agoWords(age_s) : "", age_s >= OLD_S);
      }
    }
  }

  /** Take all of them away. */
  clear() {
    for (const [note, { text }] of [...this.#notes]) {
      if (note.textContent === text) {
        this.#empty(note);
      } else {
        this.#forget(note);
      }
    }
  }

  #empty(note) {
    tell(note, "", "plain");
    this.#forget(note);
  }

  #forget(note) {
    showAge(note, "", false);
    this.#notes.delete(note);
  }
}

const ofStores = new WeakMap();

/** The page's. */
export function notesOf(store, connection) {
  if (!ofStores.has(store)) {
    ofStores.set(store, new AnswerNotes(store, connection));
  }
  return ofStores.get(store);
}

export function tell(note, text, look) {
  setText(note, text);
  setAttribute(note, "data-look", look);
}

// The style sheet writes the age: a text would be read out each second.
function showAge(note, words, isOld) {
  setAttribute(note, "data-age", words);
  setAttribute(note, "data-old", String(isOld));
}

import { confirm } from "../dialog.js";
import { setAttribute, setText } from "../dom.js";
import { disabledReason } from "./disabled_reason.js";
import { agoText, answerCode, answerLook, answerText, commandText } from "./messages.js";

/** From then on an answer shows its age. */
const AGED_S = 5;
/** From then on it is grey. */
const OLD_S = 15;
/** Then it is removed: the request is listed among the events. */
const GONE_S = 120;
const CANCELLED = { code: "cancelled", text: "you cancelled" };
export const OTHER_AIRCRAFT = { code: "other_aircraft", text: "another aircraft was selected" };
const WAITING = "sent, waiting for the answer";

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
    store.subscribe(() => this.update());
  }

  show(note, text, look, code = "") {
    showNote(note, text, look, code);
    this.#notes.set(note, { text, at_s: this.#store.now_s });
    showAge(note, "", false);
  }

  /** Grey out stale answers, and remove those that are over. */
  update() {
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
        this.#discard(note);
      } else if (age_s >= GONE_S) {
        this.#empty(note);
      } else {
        showAge(note, age_s >= AGED_S ? agoText(age_s) : "", age_s >= OLD_S);
      }
    }
  }

  clear() {
    for (const [note, { text }] of [...this.#notes]) {
      if (note.textContent === text) {
        this.#empty(note);
      } else {
        this.#discard(note);
      }
    }
  }

  #empty(note) {
    showNote(note, "", "plain");
    this.#discard(note);
  }

  #discard(note) {
    showAge(note, "", false);
    this.#notes.delete(note);
  }
}

const ofStores = new WeakMap();

/** The one of the page. */
export function notesOf(store, connection) {
  if (!ofStores.has(store)) {
    ofStores.set(store, new AnswerNotes(store, connection));
  }
  return ofStores.get(store);
}

/** look: plain, good or bad; code: the outcome, for programs and tests. */
export function showNote(note, text, look, code = "") {
  setText(note, text);
  setAttribute(note, "data-look", look);
  setAttribute(note, "data-code", code);
}

// The style sheet writes the age: a text would be read out each second.
function showAge(note, text, isOld) {
  setAttribute(note, "data-age", text);
  setAttribute(note, "data-old", String(isOld));
}

/** Sends Commands: confirms where it matters, shows the outcome beside the button and in `#last-answer`. */
export class CommandSender {
  #store;
  #connection;
  #notes;

  constructor(store, connection) {
    this.#store = store;
    this.#connection = connection;
    this.#notes = notesOf(store, connection);
  }

  disabledReason(name, data = {}) {
    return disabledReason(this.#store, this.#connection, name, data);
  }

  /** note: shows the outcome; question: for dialog.js; isForced: an unknown name; aircraft: for which it was chosen. Returns null if not sent. */
  async send(name, data, { note, question = null, isForced = false, aircraft = this.#store.aircraft }) {
    const command = commandText(this.#store.catalogue.get(name)?.title ?? name, data);
    if (question !== null && !(await confirm(question))) {
      this.#notes.show(note, `not sent: ${CANCELLED.text}`, "plain", CANCELLED.code);
      return null;
    }
    // While the dialog was open, control may have changed.
    const reason = this.#isOther(aircraft) ? OTHER_AIRCRAFT : this.disabledReason(name, data);
    if (reason !== null) {
      this.#show(note, command, `not sent: ${reason.text}`, "bad", reason.code);
      return null;
    }
    this.#show(note, command, WAITING, "plain", "waiting");
    const answer = await this.#connection.command(name, data, { aircraft, isForced });
    // An answer of another aircraft than the watched one is not shown.
    if (!this.#isOther(aircraft)) {
      this.#show(note, command, answerText(answer), answerLook(answer), answerCode(answer));
    }
    return answer;
  }

  #isOther(aircraft) {
    return this.#store.aircraft !== aircraft;
  }

  #show(note, command, text, look, code) {
    this.#notes.show(note, text, look, code);
    const last = document.getElementById("last-answer");
    if (last !== null) {
      this.#notes.show(last, `${command}: ${text}`, look, code);
    }
  }
}

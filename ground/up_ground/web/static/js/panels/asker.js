import { confirm } from "../dialog.js";
import { notesOf } from "./answer_notes.js";
import { answerLook, answerWords, commandWords } from "./words.js";
import { objection } from "./why.js";

export { tell } from "./answer_notes.js";

/**
 * Sends Commands for the user: confirms where it matters, and shows progress and outcome beside the
 * button and in `#last-answer`.
 */
export class Asker {
  #store;
  #connection;
  #notes;

  constructor(store, connection) {
    this.#store = store;
    this.#connection = connection;
    this.#notes = notesOf(store, connection);
  }

  /** Why a Command is not offered; empty: it is. */
  objection(name, data = {}) {
    return objection(this.#store, this.#connection, name, data);
  }

  /**
   * name: of the Command; note: shows the progress; question: for dialog.js, null: no confirmation;
   * isForced: a name that the server does not know is sent all the same. Returns the answer; null:
   * it was not sent.
   */
  async ask(name, data, { note, question = null, isForced = false }) {
    const { aircraft } = this.#store;
    if (question !== null && !(await confirm(question))) {
      this.#notes.tell(note, "not sent: you said no", "plain");
      return null;
    }
    // While the dialog was open, control may have changed.
    const why = this.#moved(aircraft) || this.objection(name, data);
    if (why) {
      this.#notes.tell(note, `not sent: ${why}`, "bad");
      this.#tellLast(commandWords(name, data), `not sent: ${why}`, "bad");
      return null;
    }
    const words = commandWords(name, data);
    this.#notes.tell(note, "sent, waiting for the answer", "plain");
    this.#tellLast(words, "sent, waiting for the answer", "plain");
    const answer = await this.#connection.command(name, data, { aircraft, isForced });
    // An answer of another aircraft than the watched one is not shown.
    if (!this.#moved(aircraft)) {
      this.#notes.tell(note, answerWords(answer), answerLook(answer));
      this.#tellLast(words, answerWords(answer), answerLook(answer));
    }
    return answer;
  }

  #moved(aircraft) {
    return this.#store.aircraft === aircraft ? "" : "another aircraft was chosen meanwhile";
  }

  #tellLast(words, text, look) {
    const last = document.getElementById("last-answer");
    if (last !== null) {
      this.#notes.tell(last, `${words}: ${text}`, look);
    }
  }
}

import { confirm } from "../dialog.js";
import { setAttribute, setText } from "../readout.js";
import { answerLook, answerWords, commandWords } from "./words.js";
import { objection } from "./why.js";

/**
 * Sends Commands as a person does: asks back where it matters, says that it is under way and
 * what became of it, beside the button and in `#last-answer`.
 */
export class Asker {
  #store;
  #connection;

  constructor(store, connection) {
    this.#store = store;
    this.#connection = connection;
  }

  /** @returns {string} why a Command is not offered; empty: it is */
  objection(name, data = {}) {
    return objection(this.#store, this.#connection, name, data);
  }

  /**
   * @param {string} name of the Command
   * @param {object} data
   * @param {{note: HTMLElement, question?: object|null, isForced?: boolean}} where note: says how it
   *   goes; question: for dialog.js, null: nothing is asked; isForced: a name that the server does
   *   not know is sent all the same
   * @returns {Promise<object|null>} the answer; null: it was not sent
   */
  async ask(name, data, { note, question = null, isForced = false }) {
    if (question !== null && !(await confirm(question))) {
      tell(note, "not sent: you said no", "plain");
      return null;
    }
    // While the question stood there, control may have gone elsewhere.
    const why = this.objection(name, data);
    if (why) {
      tell(note, `not sent: ${why}`, "bad");
      tellLast(commandWords(name, data), `not sent: ${why}`, "bad");
      return null;
    }
    const words = commandWords(name, data);
    tell(note, "sent, waiting for the answer", "plain");
    tellLast(words, "sent, waiting for the answer", "plain");
    const answer = await this.#connection.command(name, data, { isForced });
    tell(note, answerWords(answer), answerLook(answer));
    tellLast(words, answerWords(answer), answerLook(answer));
    return answer;
  }
}

/**
 * @param {HTMLElement} note
 * @param {string} text
 * @param {"plain"|"good"|"bad"} look
 */
export function tell(note, text, look) {
  setText(note, text);
  setAttribute(note, "data-look", look);
}

function tellLast(words, text, look) {
  const last = document.getElementById("last-answer");
  if (last !== null) {
    tell(last, `${words}: ${text}`, look);
  }
}

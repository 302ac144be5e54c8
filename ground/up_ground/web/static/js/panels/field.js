import { html, showProblem } from "../dom.js";

/** A field with its label, its button, and the error of its content. */
export class Field {
  #read;
  #send;
  #isOffered = false;

  /** input: attributes; read: validates the text; send: called with a valid value. */
  constructor({ id, label, button, input, read, send }) {
    this.#read = read;
    this.#send = send;
    this.input = html("input", { id, "aria-describedby": `${id}-note`, ...input });
    this.button = html("button", { type: "submit", id: `${id}-send`, text: button });
    this.note = html("p.note", { id: `${id}-note`, role: "status" });
    this.hint = html("p.quiet");
    this.label = html("label", { for: id, text: label });
    this.element = html(
      "form.field",
      { novalidate: true, on: { submit: (event) => this.#submit(event), input: () => this.#validate() } },
      this.label,
      html("div.field-row", {}, this.input, this.button),
      this.hint,
      this.note,
    );
    this.offer(false);
  }

  /** isOffered: otherwise the keyboard cannot reach it either. */
  offer(isOffered) {
    this.#isOffered = isOffered;
    this.input.disabled = !isOffered;
    this.button.disabled = !isOffered;
  }

  /** Its value; null: not valid for sending. */
  get value() {
    const { value, problem } = this.#read(this.input.value);
    return problem ? null : value;
  }

  /** Reset: the input was meant for something else. */
  clear() {
    this.input.value = "";
    this.#say("");
  }

  #validate() {
    const { problem } = this.input.value === "" ? { problem: "" } : this.#read(this.input.value);
    this.#say(problem);
  }

  #submit(event) {
    event.preventDefault();
    const { value, problem } = this.#read(this.input.value);
    this.#say(problem);
    if (!problem && this.#isOffered) {
      this.#send(value);
    } else {
      this.input.focus();
    }
  }

  #say(problem) {
    showProblem(this.input, this.note, problem);
  }
}

export function numberBetween(least, most, unit) {
  return (text) => {
    const value = text.trim() === "" ? NaN : Number(text);
    if (!Number.isFinite(value)) {
      return { value, problem: "write a number" };
    }
    const isIn = value >= least && value <= most;
    return { value, problem: isIn ? "" : `must be ${least} to ${most} ${unit}` };
  };
}

export function textUpTo(longest) {
  return (text) => {
    const value = text.trim();
    if (value === "") {
      return { value, problem: "write something" };
    }
    const isShort = [...value].length <= longest;
    return { value, problem: isShort ? "" : `must be at most ${longest} characters` };
  };
}

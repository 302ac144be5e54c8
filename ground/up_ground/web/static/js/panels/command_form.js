import { CommandField } from "./command_field.js";
import { element } from "./element.js";
import { jsonFields } from "./field_value.js";
import { setText } from "../readout.js";

/** The fields of a Command that the server knows. */
export class KnownFields {
  #fields;

  /** command: of Catalogue.get(). */
  constructor(command) {
    this.#fields = command.fields.map((field, place) => new CommandField(field, place));
    this.element = element("div.any-fields", {}, ...this.#fields.map((each) => each.element));
  }

  offer(isOffered) {
    this.#fields.forEach((each) => each.offer(isOffered));
  }

  /** The data of the Command; null: a field is wrong and shows its error. */
  read() {
    const data = {};
    let firstWrong = null;
    for (const field of this.#fields) {
      const { problem, isLeftOut, value } = field.read();
      field.say(problem);
      if (problem) {
        firstWrong ??= field;
      } else if (!isLeftOut) {
        define(data, field.name, value);
      }
    }
    firstWrong?.focus();
    return firstWrong === null ? data : null;
  }
}

/** The fields of an unknown Command: one text of JSON. */
export class UnknownFields {
  #input;
  #note = element("p.note", { id: "any-json-note", role: "status" });

  constructor() {
    this.#input = element("textarea", {
      id: "any-json",
      rows: 3,
      spellcheck: "false",
      placeholder: '{"field": 1}',
      "aria-describedby": "any-json-note",
    });
    this.#input.addEventListener("input", () => this.#say(jsonFields(this.#input.value).problem));
    this.element = element(
      "div.any-fields",
      {},
      element(
        "div.field",
        {},
        element("label", { for: "any-json", text: "Its fields, as JSON (empty: none)" }),
        this.#input,
        this.#note,
      ),
    );
  }

  offer(isOffered) {
    this.#input.disabled = !isOffered;
  }

  /** The data of the Command; null: not an object. */
  read() {
    const { problem, value } = jsonFields(this.#input.value);
    this.#say(problem);
    if (problem) {
      this.#input.focus();
      return null;
    }
    return value;
  }

  #say(problem) {
    this.#input.setAttribute("aria-invalid", String(problem !== ""));
    this.#note.setAttribute("data-look", problem ? "bad" : "plain");
    setText(this.#note, problem);
  }
}

// A field may be called as anything, __proto__ too.
function define(data, name, value) {
  Object.defineProperty(data, name, { value, enumerable: true, configurable: true, writable: true });
}

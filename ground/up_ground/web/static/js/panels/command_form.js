import { html, showProblem } from "../dom.js";
import { fieldValue, jsonFields, wanted } from "./field_value.js";

/** One field of any Command: its input, its type and bounds, and the error of its content. */
export class CommandField {
  #field;
  #input;
  #null = null;
  #note;

  /** field: of Catalogue.get(); place: among its Command's fields. */
  constructor(field, place) {
    this.#field = field;
    const id = `any-field-${place}`;
    this.#input = inputOf(field, { id, name: field.name, "aria-describedby": `${id}-hint ${id}-note` });
    this.#note = html("p.note", { id: `${id}-note`, role: "status" });
    const row = html("div.field-row", {}, this.#input);
    if (field.isNullable) {
      this.#null = html("input", { type: "checkbox", id: `${id}-null` });
      row.append(html("label.choice", {}, this.#null, "null"));
    }
    const unit = field.unit === "" ? "" : `, ${field.unit}`;
    const optional = field.isRequired ? "" : " (may be left out)";
    this.element = html(
      "div.field",
      { on: { input: () => this.#validate(), change: () => this.#validate() } },
      html("label", { for: id, text: `${field.name}${unit}${optional}` }),
      row,
      html("p.quiet", { id: `${id}-hint`, text: field.text }),
      this.#note,
    );
  }

  get name() {
    return this.#field.name;
  }

  read() {
    return fieldValue(this.#field, this.#input.value, this.#null?.checked === true);
  }

  offer(isOffered) {
    this.#input.disabled = !isOffered || this.#null?.checked === true;
    if (this.#null !== null) {
      this.#null.disabled = !isOffered;
    }
  }

  say(problem) {
    showProblem(this.#input, this.#note, problem);
  }

  focus() {
    this.#input.focus();
  }

  #validate() {
    const isNull = this.#null?.checked === true;
    this.#input.disabled = isNull;
    this.say(this.#input.value === "" && !isNull ? "" : this.read().problem);
  }
}

function inputOf(field, has) {
  const choices = field.choices ?? (field.type === "boolean" ? [true, false] : null);
  if (choices !== null) {
    const select = html("select", has, html("option", { value: "", text: "--" }));
    select.append(
      ...choices.map((each) => html("option", { value: JSON.stringify(each), text: String(each) })),
    );
    return select;
  }
  if (field.type === "text") {
    return html("input", { type: "text", autocomplete: "off", ...has });
  }
  if (field.type === "number" || field.type === "integer") {
    return html("input", { type: "text", inputmode: "text", autocomplete: "off", ...has });
  }
  return html("textarea", { rows: 3, spellcheck: "false", placeholder: field.type === "list" ? "[]" : "{}", title: wanted(field), ...has });
}

export class KnownFields {
  #fields;

  constructor(command) {
    this.#fields = command.fields.map((field, place) => new CommandField(field, place));
    this.element = html("div.any-fields", {}, ...this.#fields.map((each) => each.element));
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
  #note = html("p.note", { id: "any-json-note", role: "status" });

  constructor() {
    this.#input = html("textarea", {
      id: "any-json",
      rows: 3,
      spellcheck: "false",
      placeholder: '{"field": 1}',
      "aria-describedby": "any-json-note",
    });
    this.#input.addEventListener("input", () => this.#say(jsonFields(this.#input.value).problem));
    this.element = html(
      "div.any-fields",
      {},
      html(
        "div.field",
        {},
        html("label", { for: "any-json", text: "Its fields, as JSON (empty: none)" }),
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
    showProblem(this.#input, this.#note, problem);
  }
}

// A field may be called as anything, __proto__ too.
function define(data, name, value) {
  Object.defineProperty(data, name, { value, enumerable: true, configurable: true, writable: true });
}

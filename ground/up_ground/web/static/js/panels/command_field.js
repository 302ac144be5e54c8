import { setText } from "../readout.js";
import { element } from "./element.js";
import { fieldValue, wanted } from "./field_value.js";

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
    this.#note = element("p.note", { id: `${id}-note`, role: "status" });
    const row = element("div.field-row", {}, this.#input);
    if (field.isNullable) {
      this.#null = element("input", { type: "checkbox", id: `${id}-null` });
      row.append(element("label.choice", {}, this.#null, "null"));
    }
    const unit = field.unit === "" ? "" : `, ${field.unit}`;
    const optional = field.isRequired ? "" : " (may be left out)";
    this.element = element(
      "div.field",
      { on: { input: () => this.#judge(), change: () => this.#judge() } },
      element("label", { for: id, text: `${field.name}${unit}${optional}` }),
      row,
      element("p.quiet", { id: `${id}-hint`, text: field.text }),
      this.#note,
    );
  }

  /** On the wire. */
  get name() {
    return this.#field.name;
  }

  /** Its content. */
  read() {
    return fieldValue(this.#field, this.#input.value, this.#null?.checked === true);
  }

  offer(isOffered) {
    this.#input.disabled = !isOffered || this.#null?.checked === true;
    if (this.#null !== null) {
      this.#null.disabled = !isOffered;
    }
  }

  /** empty: none. */
  say(problem) {
    this.#input.setAttribute("aria-invalid", String(problem !== ""));
    this.#note.setAttribute("data-look", problem ? "bad" : "plain");
    setText(this.#note, problem);
  }

  focus() {
    this.#input.focus();
  }

  #judge() {
    const isNull = this.#null?.checked === true;
    this.#input.disabled = isNull;
    this.say(this.#input.value === "" && !isNull ? "" : this.read().problem);
  }
}

function inputOf(field, has) {
  const choices = field.choices ?? (field.type === "boolean" ? [true, false] : null);
  if (choices !== null) {
    const select = element("select", has, element("option", { value: "", text: "--" }));
    select.append(
      ...choices.map((each) => element("option", { value: JSON.stringify(each), text: String(each) })),
    );
    return select;
  }
  if (field.type === "text") {
    return element("input", { type: "text", autocomplete: "off", ...has });
  }
  if (field.type === "number" || field.type === "integer") {
    return element("input", { type: "text", inputmode: "text", autocomplete: "off", ...has });
  }
  return element("textarea", { rows: 3, spellcheck: "false", placeholder: field.type === "list" ? "[]" : "{}", title: wanted(field), ...has });
}

import { setAttribute, setText } from "../readout.js";
import { element } from "./element.js";
import { AXES, GREATEST, LOOPS, TERMS, cellWords, gainText, isUsed, readGain } from "./gain_set.js";

/** The fields of a set of gains: a table for each loop, a row for each axis. */
export class GainsTable {
  #editor;
  #onInput;
  #cells = new Map();
  #shape = "";

  /** onInput: something was written. */
  constructor(editor, onInput) {
    this.#editor = editor;
    this.#onInput = onInput;
    this.element = element("div.gains", { id: "gains" });
  }

  /** isOffered: whether anything may be written. */
  show(isOffered) {
    const shape = [...this.#editor.flying.keys()].join();
    if (shape !== this.#shape) {
      this.#shape = shape;
      this.#build();
    }
    const conflicts = new Set(this.#editor.conflicts.map(({ path }) => path));
    for (const [path, { input, flying }] of this.#cells) {
      const text = this.#editor.textOf(path);
      if (input.value !== text && (document.activeElement !== input || !this.#editor.isCellEdited(path))) {
        input.value = text;
      }
      const isEdited = this.#editor.isCellEdited(path);
      const isWrong = isEdited && readGain(text).problem !== "";
      input.disabled = !isOffered;
      setAttribute(input, "aria-invalid", String(isWrong));
      setAttribute(input, "data-edited", String(isEdited));
      setAttribute(input, "data-conflict", String(conflicts.has(path)));
      setText(flying, isEdited ? gainText(this.#editor.flying.get(path)) : "");
    }
  }

  #build() {
    this.#cells.clear();
    this.element.replaceChildren();
    for (const loop of LOOPS) {
      const used = AXES.filter((axis) => isUsed(loop, axis));
      const rows = used.map((axis) => this.#row(loop, axis)).filter((row) => row !== null);
      if (rows.length > 0) {
        const head = element("tr", {}, element("th", { scope: "col", text: "" }));
        head.append(...TERMS.map((term) => element("th", { scope: "col", text: term.toUpperCase() })));
        const title = element("caption", {}, element("strong", { text: capital(loop.word) }), ` ${loop.unit}`);
        const body = element("tbody", {}, ...rows);
        this.element.append(element("table", {}, title, element("thead", {}, head), body));
      }
    }
  }

  #row(loop, axis) {
    const paths = TERMS.map((term) => `${loop.key}.${axis.key}.${term}`);
    if (!paths.every((path) => this.#editor.flying.has(path))) {
      return null;
    }
    const row = element("tr", {}, element("th", { scope: "row", text: axis.word }));
    for (const path of paths) {
      const input = element("input", {
        name: path,
        type: "text",
        inputmode: "decimal",
        autocomplete: "off",
        "aria-label": `${cellWords(path)}, 0 to ${GREATEST}`,
        on: { input: () => this.#written(path) },
      });
      const flying = element("small", { title: "flies now" });
      this.#cells.set(path, { input, flying });
      row.append(element("td", {}, input, flying));
    }
    return row;
  }

  #written(path) {
    this.#editor.write(path, this.#cells.get(path).input.value);
    this.#onInput();
  }
}

function capital(word) {
  return word[0].toUpperCase() + word.slice(1);
}

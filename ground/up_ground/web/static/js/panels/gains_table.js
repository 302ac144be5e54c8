import { html, setAttribute, setText } from "../dom.js";
import {
  AXES,
  cellsOf,
  cellText,
  difference,
  gainText,
  MAX_GAIN,
  isUsed,
  LOOPS,
  readGain,
  TERMS,
} from "./gains_editor.js";
import { agoText } from "./messages.js";
import { capital } from "../state/format.js";
import { OUTCOMES } from "../state/schema.js";

/** The fields of a set of gains: a table for each loop, a row for each axis. */
export class GainsTable {
  #editor;
  #onInput;
  #cells = new Map();
  #shape = "";

  constructor(editor, onInput) {
    this.#editor = editor;
    this.#onInput = onInput;
    this.element = html("div.gains", { id: "gains" });
  }

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
        const head = html("tr", {}, html("th", { scope: "col", text: "" }));
        head.append(...TERMS.map((term) => html("th", { scope: "col", text: term.toUpperCase() })));
        const title = html("caption", {}, html("strong", { text: capital(loop.word) }), ` ${loop.unit}`);
        const body = html("tbody", {}, ...rows);
        this.element.append(html("table", {}, title, html("thead", {}, head), body));
      }
    }
  }

  #row(loop, axis) {
    const paths = TERMS.map((term) => `${loop.key}.${axis.key}.${term}`);
    if (!paths.every((path) => this.#editor.flying.has(path))) {
      return null;
    }
    const row = html("tr", {}, html("th", { scope: "row", text: axis.word }));
    for (const path of paths) {
      const input = html("input", {
        name: path,
        type: "text",
        inputmode: "decimal",
        autocomplete: "off",
        "aria-label": `${cellText(path)}, 0 to ${MAX_GAIN}`,
        on: { input: () => this.#written(path) },
      });
      const flying = html("small", { title: "flies now" });
      this.#cells.set(path, { input, flying });
      row.append(html("td", {}, input, flying));
    }
    return row;
  }

  #written(path) {
    this.#editor.write(path, this.#cells.get(path).input.value);
    this.#onInput();
  }
}

/** The sent sets: time, sender, changes and outcome. */
export class GainsHistory {
  #list = html("ol.gains-history", { id: "gains-history" });
  #ages = [];
  #shown = null;

  constructor() {
    this.element = html("details", { hidden: true }, html("summary", { text: "History" }), this.#list);
  }

  /** message: the server's `gains`; since_s: seconds since its arrival. */
  show(message, since_s) {
    if (message !== this.#shown) {
      this.#shown = message;
      this.#build(entriesOf(message));
    }
    for (const { time, age_s } of this.#ages) {
      setText(time, agoText(age_s + since_s));
    }
  }

  #build(entries) {
    this.element.hidden = entries.length === 0;
    this.#ages = [];
    this.#list.replaceChildren();
    for (const entry of [...entries].reverse()) {
      const time = html("time");
      const changes = difference(cellsOf(entry.before), cellsOf(entry.after)).map(({ words }) => words);
      const reason = entry.outcome === "ack" || !entry.reason ? "" : `: ${entry.reason}`;
      const outcome = `${OUTCOMES[entry.outcome] ?? entry.outcome}${reason}`;
      this.#list.append(
        html(
          "li",
          { "data-outcome": entry.outcome },
          html("span", { text: changes.join("; ") || "no difference" }),
          html("span.quiet", { text: `by ${entry.by || "somebody"}, ${outcome}, ` }, time),
        ),
      );
      this.#ages.push({ time, age_s: Number(entry.age_s) || 0 });
    }
  }
}

/** message: the server's `gains`. Returns its history, the oldest first. */
export function entriesOf(message) {
  const entries = Array.isArray(message?.history) ? message.history : [];
  return entries
    .filter((each) => each !== null && typeof each === "object")
    .toSorted((one, other) => Number(one.number) - Number(other.number));
}

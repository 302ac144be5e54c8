import { html, setAttribute } from "../dom.js";
import { AREA, CIRCLE } from "./editor.js";
import { FENCE, isPlaced, KINDS, MISSION } from "./plan.js";

const TOOLS = [...Object.keys(KINDS).filter(isPlaced).map((kind) => [MISSION, kind]), [FENCE, AREA], [FENCE, CIRCLE]];

/** As `loiter turns`. */
export function kindText(kind) {
  return kind.replaceAll("_", " ");
}

/** On the map: whether a click draws, what it adds, undo, redo, delete. */
export class DrawingBar {
  #editor;
  #tool;
  #undo;
  #redo;
  #delete;

  constructor(editor) {
    this.#editor = editor;
    this.toggle = button("Draw", "Draw a mission or a fence", "map-draw", () => editor.draw(!editor.isDrawing));
    this.#tool = html("select", { id: "map-tool", "aria-label": "A click on the map adds", on: { change: () => this.#choose() } });
    this.#tool.append(
      ...TOOLS.map(([name, kind]) => html("option", { value: `${name} ${kind}`, text: `${name === FENCE ? "fence " : ""}${kindText(kind)}` })),
    );
    this.#undo = button("Undo", "Undo (Ctrl+Z)", "map-undo", () => editor.undo());
    this.#redo = button("Redo", "Redo (Ctrl+Y)", "map-redo", () => editor.redo());
    this.#delete = button("Delete", "Delete the selected item (Delete)", "map-delete", () => editor.remove());
    const has = { role: "group", "aria-label": "Drawing", hidden: true };
    this.element = html("div.map-drawing", has, this.#tool, this.#undo, this.#redo, this.#delete);
    document.addEventListener("keydown", (event) => this.#onKey(event));
  }

  /** canDraw: the map takes drawings. */
  update(canDraw) {
    const { name, kind, isDrawing, canUndo, canRedo, item } = this.#editor;
    this.toggle.hidden = !canDraw;
    setAttribute(this.toggle, "aria-pressed", String(isDrawing));
    this.element.hidden = !canDraw || !isDrawing;
    // Not :has() in the style sheets: it would compute the whole page's style at every change of a text.
    setAttribute(document.documentElement, "data-drawing", String(canDraw && isDrawing));
    this.#tool.value = `${name} ${isPlaced(kind) ? kind : "waypoint"}`;
    this.#undo.disabled = !canUndo;
    this.#redo.disabled = !canRedo;
    this.#delete.disabled = item === null;
  }

  #choose() {
    const [name, kind] = this.#tool.value.split(" ");
    this.#editor.show(name);
    this.#editor.choose(kind);
  }

  #onKey(event) {
    const isTyped = event.target.matches?.("input, select, textarea") || document.querySelector("dialog[open]") !== null;
    if (!this.#editor.isDrawing || isTyped || !(event.ctrlKey || event.metaKey) || event.altKey) {
      return;
    }
    const key = event.key.toLowerCase();
    if (key === "z" || key === "y") {
      event.preventDefault();
      key === "y" || event.shiftKey ? this.#editor.redo() : this.#editor.undo();
    }
  }
}

function button(text, title, id, click) {
  return html("button", { type: "button", id, text, title, on: { click } });
}

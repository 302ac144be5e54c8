import { html, showProblem } from "../dom.js";
import { kindText } from "./drawing_bar.js";
import { changed, FENCE, KINDS, ofKind, placeOfItem, withHeight } from "./plan.js";

/** label, unit and bounds of each field; the bounds are those of up/mission/items.py. */
const FIELDS = {
  latitude: { label: "Latitude", minimum: -90, maximum: 90 },
  longitude: { label: "Longitude", minimum: -180, maximum: 180 },
  altitude: { label: "Height, m", minimum: -1000, maximum: 9000 },
  above_sea: { label: "Above sea level", isFlag: true },
  over: { label: "Over the point", isFlag: true },
  radius: { label: "Radius, m", minimum: 10, maximum: 100000, isOptional: true },
  clockwise: { label: "Clockwise", isFlag: true, initial: true },
  turns: { label: "Turns", minimum: 0.1, maximum: 1000, initial: 1 },
  time: { label: "Time, s", minimum: 0, maximum: 86400, initial: 0 },
  airspeed: { label: "Airspeed, m/s", minimum: 3, maximum: 60 },
  item: { label: "To item", minimum: 1, maximum: 700 },
  repeat: { label: "Times, -1 without end", minimum: -1, maximum: 1000, initial: 1 },
  inside: { label: "Stay inside", isFlag: true, initial: true },
};

/** What of a field's value is wrong; empty: nothing. value: NaN: not a number. */
export function faultOf(key, value) {
  const { minimum, maximum } = FIELDS[key];
  if (!Number.isFinite(value)) {
    return "write a number";
  }
  return value >= minimum && value <= maximum ? "" : `must be ${minimum} to ${maximum}`;
}

/** The fields of the selected item or border. */
export class ItemForm {
  #editor;
  #shown = "";
  #note = html("p.note", { id: "plan-item-note", role: "status" });

  constructor(editor) {
    this.#editor = editor;
    this.element = html("div.plan-item", { id: "plan-item", role: "group", "aria-label": "Selected item" });
  }

  update() {
    const { item, selected, name } = this.#editor;
    const keys = item === null ? [] : keysOf(name, item);
    const shown = JSON.stringify([name, selected, item?.kind, keys]);
    if (shown !== this.#shown) {
      this.#shown = shown;
      this.#build(keys);
    }
    this.element.hidden = item === null;
    for (const input of this.element.querySelectorAll("[data-field]")) {
      const { field } = input.dataset;
      const value = item[field] ?? FIELDS[field]?.initial;
      if (input.type === "checkbox") {
        input.checked = value === true;
      } else if (document.activeElement !== input) {
        input.value = value === undefined ? "" : String(value);
      }
    }
  }

  #build(keys) {
    const { item, name, selected } = this.#editor;
    const what = name === FENCE ? "Border" : "Item";
    const title = html("h3", { text: `${what} ${selected + 1}` });
    const kinds = name === FENCE || item === null ? [] : [this.#kindField(item)];
    const fields = html("div.requests", {}, ...kinds, ...keys.map((key) => this.#field(key)));
    showProblem(html("input"), this.#note, "");
    this.element.replaceChildren(title, fields, this.#note);
  }

  #kindField(item) {
    const change = ({ target }) => this.#change(ofKind({ ...this.#nearPlace(), ...item }, target.value), true);
    const select = html("select", { id: "plan-kind", "data-field": "kind", on: { change } });
    select.append(...Object.keys(KINDS).map((kind) => html("option", { value: kind, text: kindText(kind) })));
    return fieldOf("plan-kind", "Kind", select);
  }

  // An item that gets a place gets that of a neighbour, or the middle of the map.
  #nearPlace() {
    const near = this.#editor.list.slice(0, this.#editor.selected).findLast((each) => placeOfItem(each) !== null);
    return placeOfItem(near) ?? this.#editor.middle() ?? {};
  }

  #field(key) {
    const { label, isFlag = false } = FIELDS[key];
    const id = `plan-${key}`;
    if (isFlag) {
      const change = ({ target }) => this.#change({ [key]: target.checked });
      const input = html("input", { id, type: "checkbox", "data-field": key, on: { change } });
      return html("div.field", {}, html("label.choice", {}, input, label));
    }
    const change = ({ target }) => this.#read(key, target);
    const has = { id, type: "number", inputmode: "decimal", step: "any", "data-field": key, "aria-describedby": "plan-item-note" };
    return fieldOf(id, label, html("input", { ...has, on: { change } }));
  }

  #read(key, input) {
    const text = input.value.trim();
    const isNone = text === "" && FIELDS[key].isOptional === true && this.#editor.name !== FENCE;
    const value = text === "" ? NaN : Number(text);
    const problem = isNone ? "" : faultOf(key, value);
    showProblem(input, this.#note, problem);
    if (problem === "") {
      this.#change({ [key]: isNone ? null : value });
    }
  }

  #change(fields, isWhole = false) {
    const { list, selected } = this.#editor;
    this.#editor.put(isWhole ? list.map((each, at) => (at === selected ? fields : each)) : changed(list, selected, fields));
  }
}

/** One height for all items. */
export function heightOfAll(editor) {
  const note = html("p.note", { id: "plan-height-note", role: "status" });
  const input = html("input", { id: "plan-height", type: "number", inputmode: "decimal", step: "any" });
  const submit = (event) => {
    event.preventDefault();
    const value = input.value.trim() === "" ? NaN : Number(input.value);
    const problem = faultOf("altitude", value);
    showProblem(input, note, problem);
    if (problem === "") {
      editor.put(withHeight(editor.list, value));
    }
  };
  const button = html("button", { type: "submit", id: "plan-height-set", text: "Set" });
  const label = html("label", { for: "plan-height", text: "Height of all above home, m" });
  return html("form.field", { novalidate: true, on: { submit } }, label, html("div.field-row", {}, input, button), note);
}

function keysOf(name, item) {
  if (name === FENCE) {
    return item.corners ? ["inside"] : ["inside", "latitude", "longitude", "radius"];
  }
  return KINDS[item.kind] ?? [];
}

function fieldOf(id, label, input) {
  return html("div.field", {}, html("label", { for: id, text: label }), input);
}

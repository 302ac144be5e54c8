import { html, setAttribute, setText } from "../dom.js";
import { clockText } from "../panels/messages.js";
import { distance_m, distanceText } from "../state/earth.js";
import { headingText, plainNumber } from "../state/format.js";
import { kindText } from "./drawing_bar.js";
import { FENCE, legsOf, MISSION, totalOf } from "./plan.js";

const HEADS = { mission: ["No.", "Kind", "Height", "", "Leg", "Time"], fence: ["No.", "Shape", "Side", "Size"] };

/** The drawn mission or fence as a table; a row is selected by its number. */
export class PlanTable {
  #editor;
  #shown = "";
  #body = html("tbody");
  #head = html("tr");
  #total = html("p.quiet", { id: "plan-total" });
  #general = html("ul.plan-problems", { id: "plan-problems" });
  #table = html("table.plan-table", { id: "plan-table" }, html("thead", {}, this.#head), this.#body);

  constructor(editor) {
    this.#editor = editor;
    this.element = html("div", {}, html("div.plan-rows", {}, this.#table), this.#total, this.#general);
  }

  /** flown: number of the item that the aircraft flies; null: none of these. */
  update(home, homeAltitude_m, flown) {
    const { name, list, version } = this.#editor;
    const shown = JSON.stringify([version, home, homeAltitude_m]);
    if (shown !== this.#shown) {
      this.#shown = shown;
      this.#build(name, list, home, homeAltitude_m);
    }
    [...this.#body.children].forEach((row, index) => setAttribute(row, "data-flown", String(index + 1 === flown)));
  }

  #build(name, list, home, homeAltitude_m) {
    const focused = this.#body.contains(document.activeElement);
    this.#head.replaceChildren(...HEADS[name].map((text) => html("th", { scope: "col", text })));
    const legs = name === FENCE ? [] : legsOf(list, home);
    const cells = name === FENCE ? borderCells : (item, index) => itemCells(item, legs[index]);
    const { problems } = this.#editor;
    this.#body.replaceChildren(...list.map((each, index) => this.#row(index, cells(each, index), problems)));
    if (focused) {
      this.#body.querySelector('[aria-pressed="true"]')?.focus();
    }
    this.#table.hidden = list.length === 0;
    setText(this.#total, name === FENCE ? fenceText(list) : totalText(list, home, homeAltitude_m));
    const others = problems.filter(({ item }) => list[item - 1] === undefined);
    this.#general.replaceChildren(...others.map(problemLine));
  }

  #row(index, cells, problems) {
    const own = problems.filter(({ item }) => item === index + 1);
    const isSelected = this.#editor.selected === index;
    const click = () => this.#editor.select(isSelected ? null : index);
    const button = html("button", { type: "button", text: String(index + 1), "aria-pressed": String(isSelected), on: { click } });
    const number = html("th", { scope: "row" }, button);
    const row = html("tr", { "data-item": index + 1 }, number, ...cells.map((text) => html("td", { text })));
    if (own.length > 0) {
      row.classList.add("is-bad");
      row.lastElementChild.append(html("ul.plan-problems", {}, ...own.map(problemLine)));
    }
    return row;
  }
}

function problemLine({ item, code, text }) {
  return html("li", { "data-code": code, "data-of": item, text });
}

function itemCells(item, leg) {
  const reference = item.above_sea ? " above sea" : "";
  const height = item.altitude === undefined ? "" : `${plainNumber(item.altitude)} m${reference}`;
  const way = leg === null ? "" : `${distanceText(leg.distance_m)}, ${headingText(leg.course_deg)}°`;
  return [kindText(item.kind ?? ""), height, detailText(item), way, leg === null ? "" : clockText(leg.time_s)];
}

/** What an item says beside its place and height, as `radius 80 m, 2 turns`. */
export function detailText(item) {
  const parts = [
    item.over && "over the point",
    item.radius !== undefined && `radius ${plainNumber(item.radius)} m`,
    item.clockwise === false && "counter-clockwise",
    item.kind === "loiter_turns" && `${plainNumber(item.turns ?? 1)} ${(item.turns ?? 1) === 1 ? "turn" : "turns"}`,
    item.kind === "loiter_time" && `${plainNumber(item.time ?? 0)} s`,
    item.kind === "loiter" && "without end",
    item.kind === "speed" && `${plainNumber(item.airspeed)} m/s`,
    item.kind === "jump" && `to ${item.item}, ${item.repeat === -1 ? "without end" : `${item.repeat ?? 1} times`}`,
  ];
  return parts.filter(Boolean).join(", ");
}

/** As `12 items, 3.4 km, 6:10 without wind, at most 120 m above home`. */
export function totalText(list, home, homeAltitude_m) {
  if (list.length === 0) {
    return "No items. Draw on the map, or open a file.";
  }
  const { length_m, time_s, highest_m } = totalOf(list, home, homeAltitude_m);
  const height = highest_m === null ? "" : `, at most ${plainNumber(highest_m)} m above home`;
  return `${countText(MISSION, list.length)}, ${distanceText(length_m)}, ${clockText(time_s)} without wind${height}`;
}

export function fenceText(list) {
  if (list.length === 0) {
    return "No borders. Draw on the map, or open a file.";
  }
  return countText(FENCE, list.length);
}

/** As `1 border`, `4 items`; name: of the plan. */
export function countText(name, count) {
  const noun = name === FENCE ? "border" : "item";
  return count === 1 ? `1 ${noun}` : `${count} ${noun}s`;
}

function borderCells(border) {
  const side = border.inside === false ? "stay outside" : "stay inside";
  return border.corners ? ["area", side, areaText(border.corners)] : ["circle", side, `radius ${distanceText(border.radius)}`];
}

function areaText(corners) {
  const places = corners.map(([latitude, longitude]) => ({ latitude, longitude }));
  const around_m = places.reduce((sum, each, index) => sum + distance_m(each, places[(index + 1) % places.length]), 0);
  return `${corners.length} corners, ${distanceText(around_m)} around`;
}

import { storageOf } from "../link/storage.js";
import { History } from "./history.js";
import * as plan from "./plan.js";

const KEY = "mission";
export const AREA = "area";
export const CIRCLE = "circle";

/**
 * The mission and the fence that this page draws: the items, the selection, and what the
 * aircraft uses of it. It has no element; the map and the panel show it when `version` changes.
 *
 * Fields to read: `name` (the plan in work), `kind` (that a click adds), `isDrawing`, `selected` (an
 * index, null: none), `problems` ([{item, code, text}]), `used` ({id, list}: last exchanged with the
 * aircraft, null: nothing).
 */
export class Editor {
  #history;
  #memory;
  #calls = new Set();
  #kinds = { [plan.MISSION]: "waypoint", [plan.FENCE]: AREA };
  #problems = { [plan.MISSION]: [], [plan.FENCE]: [] };
  #used;

  name = plan.MISSION;
  selected = null;
  isDrawing = false;
  version = 0;
  /** The middle of the map, where the keyboard adds; null: no map yet. */
  middle = () => null;

  constructor(memory = storageOf("sessionStorage")) {
    this.#memory = memory;
    const { drawn, used } = keptIn(memory);
    this.#history = new History(drawn);
    this.#used = used;
  }

  /** Call after each change. */
  subscribe(call) {
    this.#calls.add(call);
  }

  /** The mission and the fence: {mission, fence}. */
  get drawn() {
    return this.#history.present;
  }

  /** The plan in work. */
  get list() {
    return this.drawn[this.name];
  }

  get item() {
    return this.list[this.selected] ?? null;
  }

  get kind() {
    return this.#kinds[this.name];
  }

  get canUndo() {
    return this.#history.canUndo;
  }

  get canRedo() {
    return this.#history.canRedo;
  }

  get problems() {
    return [...plan.problemsOf(this.name, this.list), ...this.#problems[this.name]];
  }

  get used() {
    return this.#used[this.name];
  }

  /** Whether the aircraft has this plan, as far as it was exchanged; id: that it reports. */
  isUsed(id, name = this.name) {
    const used = this.#used[name];
    return used !== null && used.id === id && plan.isSame(used.list, this.drawn[name]);
  }

  draw(isDrawing) {
    this.isDrawing = isDrawing;
    this.#tell();
  }

  /** Work at the mission or at the fence. */
  show(name) {
    if (name !== this.name) {
      this.name = name;
      this.select(null);
    }
  }

  choose(kind) {
    this.#kinds[this.name] = kind;
    this.select(this.name === plan.FENCE ? null : this.selected);
  }

  select(index) {
    this.selected = index;
    this.#tell();
  }

  /** Add at a place what `kind` says: a mission's at its end, a corner of the selected area, or a new border. */
  add(place) {
    if (this.name === plan.MISSION) {
      const kind = plan.isPlaced(this.kind) ? this.kind : "waypoint";
      this.insert(this.list.length, plan.itemAt(this.list, this.list.length, kind, place));
    } else if (this.kind === CIRCLE) {
      this.insert(this.list.length, plan.circleAt(place));
    } else if (this.item?.corners === undefined) {
      this.insert(this.list.length, { corners: [plan.cornerAt(place)] });
    } else {
      this.put(plan.withCorner(this.list, this.selected, this.item.corners.length, place, true));
    }
  }

  /** Add without a place: after the selected item, otherwise at the end. */
  addItem() {
    const index = this.selected === null ? this.list.length : this.selected + 1;
    this.insert(index, plan.itemAt(this.list, index, this.kind, null));
  }

  insert(index, item) {
    this.put(plan.inserted(this.list, index, item), index);
  }

  remove(index = this.selected) {
    if (this.list[index] !== undefined) {
      const rest = plan.removed(this.list, index);
      this.put(rest, rest.length === 0 ? null : Math.min(index, rest.length - 1));
    }
  }

  /** list: of the plan in work from now on. */
  put(list, selected = this.selected) {
    this.load({ [this.name]: list }, selected);
  }

  /** Replace one plan or both; the problems of a replaced one are over. */
  load(plans, selected = null) {
    this.#history.put({ ...this.drawn, ...plans });
    for (const name of Object.keys(plans)) {
      this.#problems[name] = [];
    }
    this.selected = selected;
    this.#tell();
  }

  undo() {
    this.#history.undo();
    this.#jumped();
  }

  redo() {
    this.#history.redo();
    this.#jumped();
  }

  setProblems(name, problems) {
    this.#problems[name] = problems;
    this.#tell();
  }

  /** The aircraft has this list in use by this identity. */
  setUsed(name, id, list) {
    this.#used = { ...this.#used, [name]: { id, list } };
    this.#tell();
  }

  #jumped() {
    this.#problems = { [plan.MISSION]: [], [plan.FENCE]: [] };
    this.selected = this.item === null ? null : this.selected;
    this.#tell();
  }

  #tell() {
    this.version += 1;
    this.#memory.set(KEY, JSON.stringify({ drawn: this.drawn, used: this.#used }));
    for (const call of this.#calls) {
      call();
    }
  }
}

function keptIn(memory) {
  let kept = {};
  try {
    kept = JSON.parse(memory.get(KEY) ?? "{}") ?? {};
  } catch {
    // Of another version of this page.
  }
  const used = (name) => {
    const { id, list } = kept.used?.[name] ?? {};
    return typeof id === "string" ? { id, list: plan.listOf(list) } : null;
  };
  const each = (of) => Object.fromEntries(plan.PLANS.map((name) => [name, of(name)]));
  return { drawn: each((name) => plan.listOf(kept.drawn?.[name])), used: each(used) };
}

const ofStores = new WeakMap();

/** The one of the page. */
export function editorOf(store) {
  if (!ofStores.has(store)) {
    ofStores.set(store, new Editor());
  }
  return ofStores.get(store);
}

import { html, setAttribute, setText } from "../dom.js";
import { pictureOf } from "../map/picture.js";
import { CommandSender } from "../panels/command_sender.js";
import { showReason } from "../panels/disabled_reason.js";
import { modeReason, piModes } from "../state/flight_mode.js";
import { kindText } from "./drawing_bar.js";
import { AREA, CIRCLE, editorOf } from "./editor.js";
import { heightOfAll, ItemForm } from "./item_form.js";
import { FENCE, isPlaced, KINDS, MISSION } from "./plan.js";
import { PlanTable } from "./plan_table.js";
import { flownItem, limitsText, usedState } from "./progress.js";
import { Transfer } from "./transfer.js";

const COMMIT = "up.mission.commit";
const REQUEST = "up.mission.request";
const ITEM = "up.mission.item";
const MODE = "up.flight_mode.set";
const NO_MISSION = { code: "not_uploaded", text: "The aircraft does not have the drawn mission: upload it." };

/** The drawn mission and fence: table, fields, files, transfer to the aircraft, start. */
export function mount(place, store, connection) {
  const editor = editorOf(store);
  const sender = new CommandSender(store, connection);
  const transfer = new Transfer(store, connection, editor);
  const table = new PlanTable(editor);
  const form = new ItemForm(editor);
  const state = html("p", { id: "mission-state" });
  const limits = html("p.quiet", { id: "plan-limits" });
  const why = html("p.why", { id: "mission-why" });
  const note = html("p.note", { id: "mission-note", role: "status" });
  const tabs = new Map([MISSION, FENCE].map((name) => [name, button(name === FENCE ? "Fence" : "Mission", `plan-${name}`, () => editor.show(name))]));
  const kind = html("select", { id: "plan-new", "aria-label": "Kind to add", on: { change: () => editor.choose(kind.value) } });
  const add = button("Add", "plan-add", addItem);
  const remove = button("Delete", "plan-delete", () => editor.remove());
  const clear = button("Clear", "plan-clear", () => editor.put([], null));
  const upload = button("Upload", "plan-upload", () => transfer.upload(places()));
  const download = button("Download", "plan-download", () => transfer.download());
  const start = button("Start (MISSION)", "mission-start", startMission);
  const from = button("From here", "mission-from", flyFrom);
  const input = html("input", { id: "plan-file", type: "file", accept: ".plan,.waypoints,.txt,.json", hidden: true, on: { change: openFile } });
  const files = [
    button("Open", "plan-open", () => input.click()),
    button("Save .plan", "plan-save", () => transfer.save("plan", places())),
    button("Save .waypoints", "plan-save-waypoints", () => transfer.save("waypoints", places())),
  ];
  const heights = heightOfAll(editor);
  const group = (label, ...all) => html("div.buttons", { role: "group", "aria-label": label }, ...all);
  const details = html(
    "details",
    { id: "mission", on: { toggle: () => details.open && update() } },
    html("summary", {}, place.querySelector("h2"), state),
    group("Plan", ...tabs.values()),
    table.element,
    limits,
    group("Items", kind, add, remove, clear),
    form.element,
    heights,
    why,
    group("Aircraft", upload, download, start, from),
    note,
    transfer.element,
    group("Files", ...files, input),
  );
  place.append(details);
  let shownKinds = "";
  editor.subscribe(() => {
    // Who begins to draw, or selects an item on the map, wants to see the items.
    details.open ||= editor.isDrawing;
    update();
  });

  function button(text, id, click) {
    return html("button", { type: "button", text, id, on: { click } });
  }

  function places() {
    return { home: pictureOf(store).home, homeAltitude_m: store.number("home.altitude") };
  }

  function addItem() {
    const middle = editor.middle();
    if (editor.name === MISSION && !isPlaced(editor.kind)) {
      editor.addItem();
    } else if (middle !== null) {
      editor.add(middle);
    }
  }

  function openFile() {
    const [file] = input.files;
    if (file !== undefined) {
      transfer.open(file);
      // The same file again is a change, too.
      input.value = "";
    }
  }

  function startMission() {
    const item = store.number("mission.item") ?? 1;
    const text = `It continues at item ${item} of ${store.number("mission.count") ?? editor.list.length}. The pilot's switch decides: leaving AUTO there takes over immediately.`;
    sender.send(MODE, { mode: "MISSION" }, { note, question: { title: "Start the mission?", text, yes: "Start", no: "Leave it" } });
  }

  function flyFrom() {
    const item = editor.selected + 1;
    const text = `Item ${item} of ${editor.list.length} is flown next; in MISSION it is flown immediately.`;
    sender.send(ITEM, { item }, { note, question: { title: `Continue at item ${item}?`, text, yes: "Continue there", no: "Leave it" } });
  }

  function startReason() {
    const code = piModes(store)?.get("MISSION");
    const offered = code === undefined ? "mode_unknown" : code;
    return offered === null ? sender.disabledReason(MODE, { mode: "MISSION" }) : { code: offered, text: `MISSION is not offered: ${modeReason(offered)}.` };
  }

  function showButtons() {
    const reason = sender.disabledReason(COMMIT);
    const isUsed = usedState(editor, store, MISSION) === "same";
    showReason(why, reason);
    upload.disabled = transfer.isBusy || reason !== null;
    setText(upload, editor.list.length === 0 ? `Remove the ${editor.name}` : `Upload the ${editor.name}`);
    download.disabled = transfer.isBusy || sender.disabledReason(REQUEST) !== null;
    const starting = startReason();
    start.disabled = starting !== null;
    start.title = starting?.text ?? "";
    const following = sender.disabledReason(ITEM) ?? (isUsed ? null : NO_MISSION);
    from.disabled = following !== null || editor.item === null;
    from.title = following?.text ?? "";
    [start, from, heights].forEach((each) => (each.hidden = editor.name === FENCE));
    remove.disabled = editor.item === null;
    clear.disabled = editor.list.length === 0;
    files.forEach((each) => (each.disabled = transfer.isBusy || !connection.isOpen));
  }

  function showKinds() {
    if (shownKinds !== editor.name) {
      shownKinds = editor.name;
      const kinds = editor.name === FENCE ? [AREA, CIRCLE] : Object.keys(KINDS);
      kind.replaceChildren(...kinds.map((each) => html("option", { value: each, text: kindText(each) })));
    }
    kind.value = editor.kind;
    for (const [name, tab] of tabs) {
      setAttribute(tab, "aria-pressed", String(name === editor.name));
    }
  }

  function update() {
    const { code, text } = flownItem(editor, store);
    setText(state, text);
    setAttribute(state, "data-code", code);
    setAttribute(state, "data-freshness", store.freshness(null));
    if (details.open) {
      const { home, homeAltitude_m } = places();
      const isShown = editor.name === MISSION && code === "same";
      table.update(home, homeAltitude_m, isShown ? store.number("mission.item") : null);
      setText(limits, limitsText(store));
      form.update();
      showKinds();
      showButtons();
    }
  }

  return { update };
}

import { confirm } from "../dialog.js";
import { html, setAttribute, setText } from "../dom.js";
import { CommandSender } from "./command_sender.js";
import { gainsReason, gainsWarning, showReason } from "./disabled_reason.js";
import { cellsOf, difference, GainsEditor, setBefore } from "./gains_editor.js";
import { entriesOf, GainsHistory, GainsTable } from "./gains_table.js";
import { ageText } from "../state/format.js";

const NAME = "arduino.pids.tunings";

export function mount(place, store, connection) {
  return new GainsPanel(place, store, connection);
}

class GainsPanel {
  #store;
  #sender;
  #editor = new GainsEditor();
  #history = new GainsHistory();
  #table = new GainsTable(this.#editor, () => this.update());
  #state = html("p.quiet", { id: "gains-state" });
  #why = html("p.why", { id: "gains-why" });
  #conflict = html("ul.conflict", { id: "gains-conflict", role: "alert" });
  #difference = html("ul.difference", { id: "gains-difference", "aria-live": "polite" });
  #note = html("p.note", { id: "gains-note", role: "status" });
  #buttons;
  #shown = undefined;
  #shownAircraft = null;
  #came_s = 0;

  constructor(place, store, connection) {
    this.#store = store;
    this.#sender = new CommandSender(store, connection);
    const button = (id, text, click) => html("button", { type: "button", id, text, on: { click } });
    this.#buttons = {
      send: button("gains-send", "Send gains", () => this.#send()),
      discard: button("gains-discard", "Discard", () => this.#discard()),
      undo: button("gains-undo", "Undo", () => this.#undo()),
      ask: button("gains-ask", "Ask the aircraft", () => this.#ask({ request: true })),
    };
    const { send, discard, undo, ask } = this.#buttons;
    const row = html("div.buttons", {}, undo, discard, send);
    place.append(this.#state, html("div.row", {}, ask), this.#why, this.#table.element, this.#conflict, this.#difference);
    place.append(row, this.#note, this.#history.element);
  }

  update() {
    this.#take();
    const store = this.#store;
    const reason = gainsReason(store, this.#sender);
    showReason(this.#why, reason, gainsWarning(store));
    setText(this.#state, this.#stateText());
    this.#table.show(reason === null);
    this.#showLists();
    const { send, discard, undo, ask } = this.#buttons;
    send.disabled = reason !== null || this.#editor.wanted === null;
    discard.hidden = !this.#editor.isEdited;
    undo.disabled = reason !== null || this.#before() === null;
    // A recorded flight cannot be changed.
    ask.hidden = undo.hidden = send.hidden = store.replay !== null;
    ask.disabled = this.#sender.disabledReason(NAME, { request: true }) !== null;
    this.#history.show(store.gains, store.flight_s - this.#came_s);
  }

  // Gains that change elsewhere never overwrite the input here.
  #take() {
    const { aircraft, gains } = this.#store;
    if (aircraft !== this.#shownAircraft) {
      this.#shownAircraft = aircraft;
      this.#editor.discard();
      setText(this.#note, "");
    }
    if (gains !== this.#shown) {
      this.#shown = gains;
      this.#came_s = this.#store.flight_s;
      this.#editor.takeFlying(gains?.flying ?? null);
    }
  }

  #showLists() {
    const editor = this.#editor;
    const problems = editor.problems.map(({ words }) => words);
    const changes = editor.difference.map(({ words }) => words);
    showLines(this.#difference, [...problems, ...changes]);
    setAttribute(this.#difference, "data-problems", String(problems.length));
    showLines(this.#conflict, editor.conflicts.map(({ words }) => words));
  }

  #stateText() {
    const gains = this.#store.gains;
    if (!gains?.flying) {
      return "The active gains are not known yet.";
    }
    const told_s = (Number(gains.age_ms) || 0) / 1000 + this.#store.flight_s - this.#came_s;
    return `Active gains, reported by the aircraft ${ageText(told_s)} ago.`;
  }

  async #send() {
    const { wanted, conflicts } = this.#editor;
    if (wanted === null) {
      return;
    }
    const changed = this.#editor.difference.map(({ words }) => words);
    const found = conflicts.map(({ words }) => `Changed by another page: ${words}.`);
    const text = [...changed, ...found, gainsWarning(this.#store)].filter(Boolean).join("\n");
    const isYes = await confirm({ title: "Send these gains?", text, yes: "Send", no: "Not yet" });
    if (isYes) {
      this.#editor.accept();
      await this.#ask({ pids: wanted });
    }
  }

  async #undo() {
    const before = this.#before();
    if (before === null) {
      return;
    }
    const changes = difference(this.#editor.flying, cellsOf(before)).map(({ words }) => words);
    const text = [...changes, gainsWarning(this.#store)].filter(Boolean).join("\n");
    const question = { title: "Send the set before?", text, yes: "Send", no: "Leave it" };
    if (await confirm(question)) {
      await this.#ask({ pids: before });
    }
  }

  #discard() {
    this.#editor.discard();
    setText(this.#note, "");
    this.update();
  }

  #before() {
    return setBefore(entriesOf(this.#store.gains), this.#editor.flying);
  }

  #ask(data) {
    return this.#sender.send(NAME, data, { note: this.#note });
  }
}

function showLines(list, lines) {
  const shown = [...list.children].map((each) => each.textContent);
  if (shown.join("\n") !== lines.join("\n")) {
    list.replaceChildren(...lines.map((text) => html("li", { text })));
  }
  list.hidden = lines.length === 0;
}

import { confirm } from "../dialog.js";
import { html, setText } from "../dom.js";
import { notesOf } from "../panels/command_sender.js";
import { answerCode, answerLook, answerText } from "../panels/messages.js";
import { FENCE, listOf, MISSION, PLANS } from "./plan.js";
import { countText, fenceText, totalText } from "./plan_table.js";

/** The server and the aircraft end a transfer before. */
const TRANSFER_S = 600;
const FILE_S = 15;
/** Of a message around a file's text. */
const ROOM_BYTES = 1024;

/** Uploads, downloads, opens and saves plans through the ground server (docs/mission.md). */
export class Transfer {
  #store;
  #connection;
  #editor;
  #notes;
  #note = html("p.note", { id: "plan-note", role: "status" });
  #remarks = html("ul.plan-problems", { id: "plan-remarks" });
  #bar = html("progress", { id: "plan-progress", "aria-label": "Progress of the transfer", hidden: true });

  #saved = "";

  isBusy = false;

  constructor(store, connection, editor) {
    this.#store = store;
    this.#connection = connection;
    this.#editor = editor;
    this.#notes = notesOf(store, connection);
    this.element = html("div", {}, this.#bar, this.#note, this.#remarks);
    connection.on("plan.progress", (message) => this.#onProgress(message));
  }

  async upload({ home, homeAltitude_m }) {
    const { name, list, problems } = this.#editor;
    const { aircraft } = this.#store;
    const content = name === FENCE ? fenceText(list) : totalText(list, home, homeAltitude_m);
    const known = problems.length === 0 ? "" : ` ${problems.length} known problems: the aircraft may refuse it.`;
    const question = {
      title: list.length === 0 ? `Remove the ${name}?` : `Upload the ${name}?`,
      text: `${list.length === 0 ? "The aircraft has none afterwards." : `${content}.`}${known} The aircraft checks all of it, and uses it in place of what it has.`,
      yes: list.length === 0 ? "Remove" : "Upload",
      no: "Leave it",
    };
    if (!(await confirm(question)) || aircraft !== this.#store.aircraft) {
      return;
    }
    const beacon = this.#connection.shownBeacon();
    const upload = { type: "plan.upload", aircraft, plan: name, items: list, beacon };
    const answer = await this.#request(upload, TRANSFER_S, (answer) => this.#uploadedText(answer, name, list));
    if (answer.outcome === "ack") {
      this.#editor.setUsed(name, String(answer.plan_id), list);
    }
    // The numbers are those of the plan that was sent.
    if (this.#editor.drawn[name] === list) {
      this.#editor.setProblems(name, problemsIn(answer, name));
    }
  }

  async download() {
    const { name } = this.#editor;
    const { aircraft } = this.#store;
    const download = { type: "plan.download", aircraft, plan: name };
    const answer = await this.#request(download, TRANSFER_S, (answer) => downloadedText(answer, name));
    if (answer.outcome === "ack" && aircraft === this.#store.aircraft) {
      const list = listOf(answer.items);
      this.#editor.load({ [name]: list });
      this.#editor.setUsed(name, String(answer.plan_id), list);
    }
  }

  /** Draw what a file has; a mission's file leaves the fence unchanged. */
  async open(file) {
    const limit = this.#connection.welcome?.max_message ?? 65536;
    if (file.size > limit - ROOM_BYTES) {
      this.#notes.show(this.#note, `${file.name} is too large`, "bad", "file_too_large");
      return;
    }
    const text = await file.text();
    const answer = await this.#request({ type: "plan.read", name: file.name.slice(0, 200), text }, FILE_S);
    if (answer.outcome === "ack") {
      const fence = answer.form === "waypoints" ? {} : { [FENCE]: listOf(answer.borders) };
      this.#editor.load({ [MISSION]: listOf(answer.items), ...fence });
    }
  }

  /** form: plan or waypoints. */
  async save(form, { home, homeAltitude_m }) {
    const { mission, fence } = this.#editor.drawn;
    const at = home === null ? null : [home.latitude, home.longitude, homeAltitude_m ?? 0];
    // A waypoint file has no place for a fence.
    const borders = form === "plan" ? fence : [];
    const answer = await this.#request({ type: "plan.write", form, items: mission, borders, home: at }, FILE_S);
    if (answer.outcome === "ack") {
      // The browser reads it later.
      URL.revokeObjectURL(this.#saved);
      this.#saved = URL.createObjectURL(new Blob([String(answer.text)], { type: "text/plain" }));
      html("a", { href: this.#saved, download: `mission.${form}` }).click();
    }
  }

  // After an upload: the plan now in use.
  #uploadedText(answer, name, list) {
    if (answer.outcome === "ack") {
      return list.length === 0 ? `The aircraft has no ${name} now.` : `In use now: ${name} with ${countText(name, list.length)}, read back and equal to the drawn one.`;
    }
    const isKept = ["refused", "unsent"].includes(answer.outcome) || String(answer.detail).startsWith("plan_");
    const plans = PLANS.map((each) => [each, this.#store.number(`${each}.count`) ?? 0]);
    const kept = plans.map(([each, count]) => `${each} with ${countText(each, count)}`).join(", ");
    return `${answerText(answer)}${isKept ? `. Still in use: ${kept}.` : ""}`;
  }

  /** textOf: the words for the answer. */
  async #request(message, limit_s, textOf = answerText) {
    this.isBusy = true;
    this.#remarks.replaceChildren();
    this.#notes.show(this.#note, "sent, waiting for the answer", "plain", "waiting");
    const answer = await this.#connection.request(message, limit_s);
    this.isBusy = false;
    this.#bar.hidden = true;
    this.#notes.show(this.#note, textOf(answer), answerLook(answer), answerCode(answer));
    const isUpload = message.type === "plan.upload";
    const remarks = [...(isUpload ? [] : listed(answer.problems)), ...listed(answer.notes)];
    this.#remarks.replaceChildren(...remarks.map(({ item, code, text }) => html("li", { "data-code": code, text: `${item ? `${item}: ` : ""}${text}` })));
    return answer;
  }

  #onProgress({ aircraft, phase, done, of }) {
    if (this.isBusy && aircraft === this.#store.aircraft) {
      this.#bar.hidden = false;
      this.#bar.max = of || 1;
      this.#bar.value = done;
      setText(this.#note, `${phase}: ${done} of ${of}`);
    }
  }
}

function downloadedText(answer, name) {
  const count = countText(name, listOf(answer.items).length);
  return answer.outcome === "ack" ? `Drawn as the aircraft has it: ${count}.` : answerText(answer);
}

function listed(found) {
  const all = Array.isArray(found) ? found : [];
  return all.filter((each) => each !== null && typeof each === "object").map(({ plan, item, code, text }) => {
    return { plan, item: Number(item) || 0, code: String(code), text: String(text).slice(0, 300) };
  });
}

function problemsIn(answer, name) {
  const problems = listed(answer.problems).filter(({ plan = name }) => plan === name);
  const more = answer.untold > 0 ? [{ item: 0, code: "untold", text: `and ${answer.untold} more` }] : [];
  return [...problems, ...more];
}

import { html, setAttribute, setText } from "../dom.js";
import { storageOf } from "../link/storage.js";
import { ControlRequests, controlTexts, offeredActions } from "./control_requests.js";
import { Field, textUpTo } from "./field.js";
import { Pairing, SignIn } from "./keys.js";

/** By which name the others see this page; kept in the browser. */
export class PageName {
  #connection;
  #memory = storageOf("localStorage");
  #field;
  #summary = html("summary");

  constructor(connection) {
    this.#connection = connection;
    this.#field = new Field({
      id: "page-name",
      label: "Name that the others see",
      button: "Set",
      input: { type: "text", maxlength: 40, autocomplete: "nickname" },
      read: textUpTo(40),
      send: (name) => this.#set(name),
    });
    this.element = html("details", { hidden: true }, this.#summary, this.#field.element);
  }

  update() {
    const welcome = this.#connection.isOpen ? this.#connection.welcome : null;
    this.element.hidden = welcome === null || welcome.is_replay === true;
    this.#field.offer(welcome !== null);
    if (welcome !== null) {
      setText(this.#summary, `This is ${welcome.name}`);
    }
  }

  // The name is part of the page's hello: the page reconnects, with its token.
  #set(name) {
    this.#memory.set("name", name);
    this.element.open = false;
    this.#connection.stop();
    this.#connection.start();
  }
}

/** Another page requests control from this one: shown in view at every scroll position. */
export class ControlNotice {
  #store;
  #connection;
  #text = html("strong", { id: "control-notice-text" });
  #aircraft = null;

  constructor(store, connection, answer) {
    this.#store = store;
    this.#connection = connection;
    const button = (action, text) =>
      html("button", {
        type: "button",
        id: `control-notice-${action}`,
        text,
        on: { click: () => answer(action, this.#aircraft) },
      });
    this.element = html(
      "div.control-notice",
      { id: "control-notice", hidden: true },
      html("p", { role: "alert" }, this.#text),
      html("div.row", {}, button("give", "Give it"), button("deny", "Keep it")),
    );
  }

  update() {
    const asked = this.#connection.isOpen ? this.#asked() : null;
    this.#aircraft = asked?.aircraft ?? null;
    setText(this.#text, asked === null ? "" : noticeText(asked, this.#store.names.length));
    this.element.hidden = asked === null;
  }

  // The watched aircraft has precedence, but another one may be requested as well.
  #asked() {
    const all = [this.#store.status, ...this.#store.statuses.values()];
    return all.find((each) => each?.control?.holder === "you" && each.control.asked_by) ?? null;
  }
}

/** status: with the request to this page; count: of aircraft on this page. */
export function noticeText({ aircraft, control }, count) {
  const name = String(control.asked_by.name || `page ${control.asked_by.page}`);
  return `${name} requests control${count > 1 ? ` of ${aircraft}` : ""} from this page.`;
}

const ASK = "Request control";
const BUTTONS = [
  ["request", ASK],
  ["give", "Give it"],
  ["deny", "Keep it"],
  ["release", "Release control"],
];

/** The owner of control of the aircraft, and the actions that change it. */
export function mount(place, store, connection) {
  const holder = html("p.holder", { id: "control-holder", role: "status" });
  const asked = html("p.asked", { id: "control-asked", hidden: true });
  const note = html("p.note", { id: "control-note", role: "status" });
  const others = html("p.quiet", { id: "control-pages" });
  const buttons = new Map();
  for (const [action, text] of BUTTONS) {
    const press = () => send(action === "request" && isWaiting ? "release" : action);
    const button = html(`button.${action}`, { type: "button", id: `control-${action}`, text, on: { click: press } });
    buttons.set(action, button);
  }
  const answers = html("div.buttons", {}, buttons.get("give"), buttons.get("deny"));
  const own = html("div.buttons", {}, buttons.get("request"), buttons.get("release"));
  const more = [new SignIn(connection), new Pairing(connection), new PageName(connection)];
  place.append(holder, asked, answers, own, note, others, ...more.map((each) => each.element));
  const requests = new ControlRequests();
  const notice = new ControlNotice(store, connection, send);
  document.body.append(notice.element);
  let isWaiting = false;
  // A denied request is reported.
  connection.on("fault", (message) => requests.fault(message, store.aircraft, store.now_s));
  connection.on("closed", () => requests.clear());

  function send(action, aircraft = store.aircraft) {
    const control = store.statuses.get(aircraft)?.control;
    const to = action === "give" || action === "deny" ? (control?.asked_by?.page ?? null) : null;
    const isSent = connection.send({ type: "control", aircraft, action, to });
    if (isSent && action === "request") {
      requests.asked(aircraft, String(control?.holder_name || ""), store.now_s);
    } else if (isSent) {
      requests.withdraw(aircraft);
    }
  }

  return {
    update() {
      const control = connection.isOpen ? (store.status?.control ?? null) : null;
      const page = connection.welcome?.page ?? null;
      const words = controlTexts(control, connection.isOpen ? connection.welcome : null);
      isWaiting = control !== null && requests.isWaiting(store.aircraft, control, page, store.now_s);
      setText(holder, words.holder);
      setAttribute(holder, "data-holder", control?.holder ?? "unknown");
      setText(asked, words.asked);
      asked.hidden = words.asked === "";
      setText(others, words.pages);
      const offered = offeredActions(control, connection.isOpen ? connection.welcome : null);
      for (const [action, button] of buttons) {
        const isOffered = offered.has(action);
        button.hidden = !isOffered;
        button.disabled = !isOffered;
      }
      setAttribute(place, "data-can-request", String(offered.has("request")));
      answers.hidden = !offered.has("give");
      own.hidden = !offered.has("request") && !offered.has("release");
      setText(buttons.get("request"), isWaiting ? "Waiting for control (withdraw)" : ASK);
      setAttribute(buttons.get("request"), "data-waiting", String(isWaiting));
      const state = requests.state(store.aircraft, store.now_s);
      setText(note, state?.text ?? "");
      setAttribute(note, "data-code", state?.code ?? "");
      notice.update();
      for (const each of more) {
        each.update();
      }
    },
  };
}

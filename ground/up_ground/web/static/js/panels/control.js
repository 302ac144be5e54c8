import { setAttribute, setText } from "../readout.js";
import { element } from "./element.js";
import { ControlNotice } from "./control_notice.js";
import { controlWords, offeredActions } from "./control_words.js";
import { ControlWishes } from "./control_wishes.js";
import { PageName } from "./page_name.js";

const ASK = "Ask for control";
const BUTTONS = [
  ["request", ASK],
  ["give", "Give it"],
  ["deny", "Keep it"],
  ["release", "Leave control"],
];

/** The owner of control of the aircraft, and the actions that change it. */
export function mount(place, store, connection) {
  const holder = element("p.holder", { id: "control-holder", role: "status" });
  const asked = element("p.asked", { id: "control-asked", hidden: true });
  const note = element("p.note", { id: "control-note", role: "status" });
  const others = element("p.quiet", { id: "control-pages" });
  const buttons = new Map();
  for (const [action, text] of BUTTONS) {
    const press = () => send(action === "request" && isWaiting ? "release" : action);
    const button = element(`button.${action}`, { type: "button", id: `control-${action}`, text, on: { click: press } });
    buttons.set(action, button);
  }
  const answers = element("div.buttons", {}, buttons.get("give"), buttons.get("deny"));
  const own = element("div.buttons", {}, buttons.get("request"), buttons.get("release"));
  const name = new PageName(connection);
  place.append(holder, asked, answers, own, note, others, name.element);
  const wishes = new ControlWishes();
  const notice = new ControlNotice(store, connection, send);
  document.body.append(notice.element);
  let isWaiting = false;
  // A denied request is reported.
  connection.on("fault", (message) => wishes.fault(String(message.text ?? ""), store.aircraft, store.now_s));
  connection.on("closed", () => wishes.forget());

  function send(action, aircraft = store.aircraft) {
    const control = store.statuses.get(aircraft)?.control;
    const to = action === "give" || action === "deny" ? (control?.asked_by?.page ?? null) : null;
    const isSent = connection.send({ type: "control", aircraft, action, to });
    if (isSent && action === "request") {
      wishes.asked(aircraft, String(control?.holder_name || ""), store.now_s);
    } else if (isSent) {
      wishes.withdraw(aircraft);
    }
  }

  return {
    update() {
      const control = connection.isOpen ? (store.status?.control ?? null) : null;
      const page = connection.welcome?.page ?? null;
      const words = controlWords(control, connection.isOpen ? connection.welcome : null);
      isWaiting = control !== null && wishes.isWaiting(store.aircraft, control, page, store.now_s);
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
      answers.hidden = !offered.has("give");
      own.hidden = !offered.has("request") && !offered.has("release");
      setText(buttons.get("request"), isWaiting ? "Waiting for control (withdraw)" : ASK);
      setAttribute(buttons.get("request"), "data-waiting", String(isWaiting));
      setText(note, wishes.words(store.aircraft, store.now_s));
      notice.update();
      name.update();
    },
  };
}

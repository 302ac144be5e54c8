import { setAttribute, setText } from "../readout.js";
import { element } from "./element.js";
import { PageName } from "./page_name.js";
import { controlWords, offeredActions } from "./control_words.js";

const BUTTONS = [
  ["request", "Ask for control"],
  ["give", "Give it"],
  ["deny", "Keep it"],
  ["release", "Leave control"],
];

/**
 * Who holds control of the aircraft, and how it changes hands.
 * @param {HTMLElement} place
 * @param {object} store
 * @param {object} connection
 * @returns {{update: () => void}}
 */
export function mount(place, store, connection) {
  const holder = element("p.holder", { id: "control-holder", role: "status" });
  const asked = element("p.asked", { id: "control-asked", role: "alert", hidden: true });
  const note = element("p.note", { id: "control-note", role: "status" });
  const others = element("p.quiet", { id: "control-pages" });
  const buttons = new Map();
  for (const [action, text] of BUTTONS) {
    const press = () => send(action);
    const button = element(`button.${action}`, { type: "button", id: `control-${action}`, text, on: { click: press } });
    buttons.set(action, button);
  }
  const answers = element("div.buttons", {}, buttons.get("give"), buttons.get("deny"));
  const own = element("div.buttons", {}, buttons.get("request"), buttons.get("release"));
  const name = new PageName(connection);
  place.append(holder, asked, answers, own, note, others, name.element);
  let sentAt_s = null;
  let sentFor = "";
  // A wish that was denied is told so.
  connection.on("fault", (message) => {
    sentAt_s = null;
    setText(note, String(message.text ?? ""));
  });

  function send(action) {
    const control = store.status?.control;
    const to = action === "give" || action === "deny" ? (control?.asked_by?.page ?? null) : null;
    const isSent = connection.send({ type: "control", aircraft: store.aircraft, action, to });
    setText(note, isSent ? "" : "not sent: there is no connection to the ground server");
    if (isSent && action === "request" && control?.holder !== "nobody") {
      sentAt_s = store.now_s;
      sentFor = String(control?.holder_name || "the other one");
    }
  }

  function showWaiting(control) {
    if (sentAt_s === null) {
      return;
    }
    if (control?.holder === "you" || control?.holder === "nobody") {
      sentAt_s = null;
      setText(note, "");
    } else {
      const waited_s = Math.floor(store.now_s - sentAt_s);
      setText(note, `${sentFor} was asked ${waited_s} s ago`);
      if (waited_s >= 30) {
        sentAt_s = null;
        setText(note, `${sentFor} did not give control within 30 s`);
      }
    }
  }

  return {
    update() {
      const control = connection.isOpen ? (store.status?.control ?? null) : null;
      const words = controlWords(control, connection.isOpen ? connection.welcome : null);
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
      showWaiting(control);
      name.update();
    },
  };
}

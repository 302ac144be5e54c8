import { setText } from "../readout.js";
import { element } from "./element.js";

/** Another page requests control from this one: shown in view at every scroll position. */
export class ControlNotice {
  #store;
  #connection;
  #text = element("strong", { id: "control-notice-text" });
  #aircraft = null;

  constructor(store, connection, answer) {
    this.#store = store;
    this.#connection = connection;
    const button = (action, text) =>
      element("button", {
        type: "button",
        id: `control-notice-${action}`,
        text,
        on: { click: () => answer(action, this.#aircraft) },
      });
    this.element = element(
      "div.control-notice",
      { id: "control-notice", hidden: true },
      element("p", { role: "alert" }, this.#text),
      element("div.row", {}, button("give", "Give it"), button("deny", "Keep it")),
    );
  }

  update() {
    const asked = this.#connection.isOpen ? this.#asked() : null;
    this.#aircraft = asked?.aircraft ?? null;
    setText(this.#text, asked === null ? "" : noticeWords(asked, this.#store.names.length));
    this.element.hidden = asked === null;
  }

  // The watched aircraft has precedence, but another one may be requested as well.
  #asked() {
    const all = [this.#store.status, ...this.#store.statuses.values()];
    return all.find((each) => each?.control?.holder === "you" && each.control.asked_by) ?? null;
  }
}

/** status: with the request to this page; count: of aircraft on this page. */
export function noticeWords({ aircraft, control }, count) {
  const name = String(control.asked_by.name || `page ${control.asked_by.page}`);
  return `${name} asks you for control${count > 1 ? ` of ${aircraft}` : ""}.`;
}

import { keepsakeOf } from "../link/keepsake.js";
import { setText } from "../readout.js";
import { element } from "./element.js";
import { Field, textUpTo } from "./field.js";

/** By which name the others see this page; kept in the browser. */
export class PageName {
  #connection;
  #memory = keepsakeOf("localStorage");
  #field;
  #summary = element("summary");

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
    this.element = element("details", { hidden: true }, this.#summary, this.#field.element);
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

import { html, setText, showProblem } from "../dom.js";
import { Field } from "./field.js";

const KEY = /^[A-Za-z0-9_-]{8,64}$/;
const SECRET = { type: "password", autocomplete: "off", spellcheck: "false" };

/** The right to control by the key of the ground station, which the server exchanges for a cookie. */
export class SignIn {
  #connection;
  #field;
  #out = html("button.quiet", { type: "button", id: "sign-out", text: "Sign out", on: { click: () => this.#signOut() } });

  constructor(connection) {
    this.#connection = connection;
    this.#field = new Field({
      id: "page-key",
      label: "Key of this ground station",
      button: "Sign in",
      input: { type: "password", maxlength: 64, autocomplete: "current-password" },
      read: (text) => {
        const value = text.trim();
        return { value, problem: KEY.test(value) ? "" : "a key is 8 to 64 letters, digits, _ and -" };
      },
      send: (key) => this.#signIn(key),
    });
    if (new URLSearchParams(location.hash.slice(1)).has("key")) {
      // As addresses of older versions had it.
      history.replaceState(null, "", location.pathname);
      setText(this.#field.hint, "A key does not belong into the address, where it was removed: paste it here.");
    }
    this.element = html("div", {}, this.#field.element, this.#out);
  }

  update() {
    const welcome = this.#connection.isOpen ? this.#connection.welcome : null;
    const isOffered = welcome?.denial?.code === "no_key";
    this.#field.element.hidden = !isOffered;
    this.#field.offer(isOffered);
    this.#out.hidden = welcome?.signed_in !== true;
  }

  async #signIn(key) {
    const problem = await request("POST", { authorization: `Bearer ${key}` });
    if (problem === "") {
      this.#field.clear();
      // The page is itself again by its token, now with the cookie.
      this.#connection.stop();
      this.#connection.start();
    } else {
      showProblem(this.#field.input, this.#field.note, problem);
    }
  }

  async #signOut() {
    const problem = await request("DELETE");
    setText(this.#out, problem === "" ? "Sign out" : `Sign out (${problem})`);
  }
}

/** Returns why the server refuses; empty: done. */
async function request(method, headers = {}) {
  try {
    const answer = await fetch("session", { method, headers });
    return answer.ok ? "" : (await answer.text()).trim();
  } catch {
    return "not connected to the ground server";
  }
}

/** A field for the text of `up keys add`, by which this ground station gets a key of the aircraft. */
export class Pairing {
  #connection;
  #field;

  constructor(connection) {
    this.#connection = connection;
    this.#field = new Field({
      id: "pairing",
      label: "Pairing text of up keys add",
      button: "Pair",
      input: { ...SECRET, maxlength: 300 },
      read: (text) => {
        const value = text.trim();
        return { value, problem: value.startsWith("upkey:") ? "" : "a pairing text begins with upkey:" };
      },
      send: (pairing) => this.#pair(pairing),
    });
    const hint = isSecureContext ? "" : "Others may read this connection: open the page by HTTPS, or on the server's machine.";
    setText(this.#field.hint, hint);
    this.element = html("details", { hidden: true }, html("summary", { text: "Pair with an aircraft" }), this.#field.element);
  }

  async #pair(pairing) {
    const { outcome, reason, aircraft, key, role } = await this.#connection.request({ type: "pair", pairing });
    if (outcome === "ack") {
      this.#field.clear();
      setText(this.#field.note, `Paired with ${aircraft} as ${key} (${role}).`);
    } else {
      showProblem(this.#field.input, this.#field.note, String(reason));
    }
  }

  update() {
    const welcome = this.#connection.isOpen ? this.#connection.welcome : null;
    this.element.hidden = welcome === null || welcome.may_control !== true;
    this.#field.offer(!this.element.hidden && isSecureContext);
  }
}

import { sentence } from "./disabled_reason.js";

const LIMIT_S = 30;
/** The server reports the end of a request; without a report the page ends it a little later. */
const LATE_S = 3;
const SHOWN_S = 30;

/** This page's requests for control, with their outcomes, by aircraft. */
export class ControlRequests {
  #requests = new Map();
  #notes = new Map();

  /** holder: the page asked; empty: none in particular. */
  asked(aircraft, holder, now_s) {
    this.#notes.delete(aircraft);
    this.#requests.set(aircraft, { holder, at_s: now_s });
  }

  /** aircraft: for which no request is pending now. */
  withdraw(aircraft) {
    this.#requests.delete(aircraft);
    this.#notes.delete(aircraft);
  }

  /** Note a denied request; without one for the watched aircraft the first pending one is meant. */
  fault({ code, text }, aircraft, now_s) {
    const place = this.#requests.has(aircraft) ? aircraft : ([...this.#requests.keys()][0] ?? aircraft);
    this.#requests.delete(place);
    this.#notes.set(place, { code: String(code ?? ""), text: String(text ?? ""), at_s: now_s });
  }

  clear() {
    this.#requests.clear();
    this.#notes.clear();
  }

  /** control: of its status; page: this page's number. Returns whether this page waits for control. */
  isWaiting(aircraft, control, page, now_s) {
    const request = this.#requests.get(aircraft);
    if (control?.holder === "you") {
      this.withdraw(aircraft);
      return false;
    }
    if (request !== undefined && now_s - request.at_s > LIMIT_S + LATE_S) {
      this.#requests.delete(aircraft);
      const text = `${request.holder || "The other one"} did not give control within ${LIMIT_S} s.`;
      this.#notes.set(aircraft, { code: "request_timeout", text, at_s: now_s });
    }
    return this.#requests.has(aircraft) || isRequester(control, page);
  }

  state(aircraft, now_s) {
    const request = this.#requests.get(aircraft);
    if (request !== undefined) {
      const text = `Control was requested of ${request.holder}, who has ${LIMIT_S} s to answer.`;
      return request.holder === "" ? null : { code: "requested", text };
    }
    const note = this.#notes.get(aircraft);
    return note === undefined || now_s - note.at_s > SHOWN_S ? null : note;
  }
}

/** Whether a page, by its number, has the pending request. */
export function isRequester(control, page) {
  return typeof page === "number" && control?.asked_by?.page === page;
}

/** The owner of control in words; empty: no text. welcome: null: disconnected. */
export function controlTexts(control, welcome) {
  if (welcome === null) {
    return { holder: "No connection: this page has no control.", asked: "", pages: "" };
  }
  if (welcome.is_replay) {
    return { holder: "A replay: there is nothing to control.", asked: "", pages: "" };
  }
  return {
    holder: [ownerText(control), watchText(control, welcome)].filter(Boolean).join(" "),
    asked: askedText(control, welcome),
    pages: pagesText(control, welcome),
  };
}

/** Of request, give, deny, release: the actions available to a page now. */
export function offeredActions(control, welcome) {
  if (welcome === null || welcome.is_replay || welcome.may_control === false || control === null) {
    return new Set();
  }
  if (control.holder !== "you") {
    return new Set(["request"]);
  }
  return new Set(control.asked_by ? ["give", "deny", "release"] : ["release"]);
}

function ownerText(control) {
  const name = String(control?.holder_name || "");
  switch (control?.holder) {
    case "you":
      return "You have control. All others watch.";
    case "page":
      return `${name || "Another page"} has control. You watch.`;
    case "ground":
      return `Another ground station has control${name ? ` (${name})` : ""}. You watch.`;
    case "nobody":
      return "Control is free.";
    default:
      return "The owner of control is not known yet.";
  }
}

function watchText(control, welcome) {
  if (welcome.may_control !== false || control?.holder === "you") {
    return "";
  }
  return `This page may only watch: ${sentence(welcome.denial?.text || "by the server's settings")}`;
}

function askedText(control, welcome) {
  // This page's own request is shown beside its button.
  if (!control?.asked_by || isRequester(control, welcome.page)) {
    return "";
  }
  const name = String(control.asked_by.name || `page ${control.asked_by.page}`);
  return control.holder === "you" ? `${name} requests control from this page.` : `${name} requests control.`;
}

function pagesText(control, welcome) {
  const pages = Array.isArray(control?.pages) ? control.pages : [];
  const names = pages.map((each) =>
    each.page === welcome.page ? `${each.name} (this one)` : String(each.name),
  );
  return names.length > 1 ? `${names.length} pages look on: ${names.join(", ")}.` : "";
}

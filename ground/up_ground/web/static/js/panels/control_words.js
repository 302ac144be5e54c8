import { isAsker } from "./control_wishes.js";
import { sentence } from "./why.js";

/**
 * The owner of control, in words. control: of the server's `status`; welcome: null: disconnected.
 * Returns empty: no text.
 */
export function controlWords(control, welcome) {
  if (welcome === null) {
    return { holder: "No connection: nobody here has control.", asked: "", pages: "" };
  }
  if (welcome.is_replay) {
    return { holder: "A replay: there is nothing to control.", asked: "", pages: "" };
  }
  return {
    holder: [holderWords(control), watchWords(control, welcome)].filter(Boolean).join(" "),
    asked: askedWords(control, welcome),
    pages: pagesWords(control, welcome),
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

function holderWords(control) {
  const name = String(control?.holder_name || "");
  switch (control?.holder) {
    case "you":
      return "You have control. All others watch.";
    case "page":
      return `${name || "Another page"} has control. You watch.`;
    case "ground":
      return `Another ground station has control${name ? ` (${name})` : ""}. You watch.`;
    case "nobody":
      return "Nobody has control.";
    default:
      return "Who has control is not known yet.";
  }
}

function watchWords(control, welcome) {
  if (welcome.may_control !== false || control?.holder === "you") {
    return "";
  }
  return `This page may only watch: ${sentence(welcome.why_not || "the server says so")}`;
}

function askedWords(control, welcome) {
  // This page's own request is shown beside its button.
  if (!control?.asked_by || isAsker(control, welcome.page)) {
    return "";
  }
  const name = String(control.asked_by.name || `page ${control.asked_by.page}`);
  return control.holder === "you" ? `${name} asks you for control.` : `${name} asks for control.`;
}

function pagesWords(control, welcome) {
  const pages = Array.isArray(control?.pages) ? control.pages : [];
  const names = pages.map((each) =>
    each.page === welcome.page ? `${each.name} (this one)` : String(each.name),
  );
  return names.length > 1 ? `${names.length} pages look on: ${names.join(", ")}.` : "";
}

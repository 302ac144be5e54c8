import { html } from "./dom.js";

const KEYS = [
  ["?", "this list"],
  ["1 2 3 4 5", "go to instruments, map, control, charts, events"],
  ["V", "the flying view, or all parts"],
  ["T", "dark or daylight"],
  ["S", "sound on or off"],
  ["Tab, Shift+Tab", "next, previous control"],
  ["Space or Enter, held", "arm or disarm, on its button"],
  ["+ - F", "on the map: closer, farther, follow or not"],
  ["Enter", "on the map: what its middle offers; while drawing, a point there"],
  ["arrows, Delete", "on a drawn point: move it, remove it"],
  ["Ctrl+Z, Ctrl+Y", "while drawing: undo, redo"],
  ["K J L", "in a replay: play or pause, 5 s back, 5 s on"],
  ["Escape", "close a dialog: no"],
];
const PLACES = ["instruments", "panel-map", "panel-control", "panel-charts", "panel-events"];

/** The dialog that lists the keys, and the keys themselves. */
export function mountHelp() {
  const dialog = document.getElementById("help");
  const list = document.getElementById("help-keys");
  for (const [key, meaning] of KEYS) {
    list.append(html("dt", {}, key), html("dd", {}, meaning));
  }
  const open = () => dialog.open || dialog.showModal();
  document.getElementById("help-button").addEventListener("click", open);
  document.getElementById("help-close").addEventListener("click", () => dialog.close());
  document.addEventListener("keydown", (event) => {
    if (!isForPage(event)) {
      return;
    }
    const button = { v: "view-button", t: "theme-button", s: "sound-button" }[event.key.toLowerCase()];
    if (event.key === "?") {
      open();
    } else if (button !== undefined) {
      document.getElementById(button).click();
    } else if (event.key >= "1" && event.key <= String(PLACES.length)) {
      goTo(PLACES[Number(event.key) - 1]);
    }
  });
}

function isForPage(event) {
  const isPlain = !event.ctrlKey && !event.altKey && !event.metaKey && !event.repeat;
  const isTyping = event.target.closest?.(
    "input, select, textarea, dialog[open], [contenteditable]",
  );
  return isPlain && !isTyping && document.querySelector("dialog[open]") === null;
}

function goTo(id) {
  const place = document.getElementById(id);
  if (!place.hasAttribute("tabindex")) {
    place.tabIndex = -1;
  }
  place.focus({ preventScroll: true });
  place.scrollIntoView({ block: "start" });
}

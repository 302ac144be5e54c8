import { html, setAttribute, setText } from "../dom.js";
import { CommandSender } from "./command_sender.js";
import { agoText } from "./messages.js";

const WORD = { info: "", warning: "Warning: ", alarm: "Alarm: " };

/** The lines of a list of events: those that are there stay, so that only new ones are read out. */
export class EventLines {
  #list;
  #window;
  #lines = new Map();
  #agesAt_s = -Infinity;

  /** window: the scrolling viewport. */
  constructor(list, window) {
    this.#list = list;
    this.#window = window;
  }

  get isAtNewest() {
    const { scrollTop, clientHeight, scrollHeight } = this.#window;
    return scrollHeight - scrollTop - clientHeight < 24;
  }

  toNewest() {
    this.#window.scrollTop = this.#window.scrollHeight;
  }

  /** events: the newest last. */
  show(events, now_s) {
    const wasAtNewest = this.isAtNewest;
    const wanted = new Set(events.map(keyOf));
    for (const [key, { line }] of this.#lines) {
      if (!wanted.has(key)) {
        line.remove();
        this.#lines.delete(key);
      }
    }
    let before = null;
    for (const event of [...events].reverse()) {
      const key = keyOf(event);
      if (!this.#lines.has(key)) {
        this.#add(event, before);
      }
      this.#lines.get(key).at_s = event.at_s;
      before = this.#lines.get(key).line;
    }
    this.#agesAt_s = -Infinity;
    this.showAges(now_s);
    if (wasAtNewest) {
      this.toNewest();
    }
  }

  /** Rewrite the ages, once a second. */
  showAges(now_s) {
    if (Math.abs(now_s - this.#agesAt_s) < 1) {
      return;
    }
    this.#agesAt_s = now_s;
    for (const { age, at_s } of this.#lines.values()) {
      setText(age, agoText(now_s - at_s));
    }
  }

  #add(event, before) {
    // Ages change by themselves: they are not for reading out.
    const age = html("time", { "aria-hidden": "true" });
    const text = html("span", { text: `${WORD[event.level] ?? ""}${event.text}` });
    const line = html("li", { "data-level": event.level, "data-kind": event.kind, "data-code": event.code }, text, age);
    this.#list.insertBefore(line, before);
    this.#lines.set(keyOf(event), { line, age, at_s: event.at_s });
  }
}

// Another aircraft and a restarted server count from one again.
function keyOf({ number, level, text }) {
  return JSON.stringify([number, level, text]);
}

const LEVELS = [
  ["info", "All"],
  ["warning", "Warnings and alarms"],
  ["alarm", "Alarms"],
];
const ORDER = ["info", "warning", "alarm"];
const MARK = "black_box.mark";

export function mount(place, store, connection) {
  const sender = new CommandSender(store, connection);
  const note = html("p.note", { role: "status" });
  const list = html("ol");
  const log = html(
    "div.events",
    {
      id: "events",
      role: "log",
      tabindex: 0,
      "aria-label": "Events",
      "aria-live": "polite",
      "aria-relevant": "additions",
    },
    list,
  );
  const lines = new EventLines(list, log);
  const filter = html("select", { id: "events-level", "aria-label": "Which events" });
  filter.append(...LEVELS.map(([value, text]) => html("option", { value, text })));
  const jump = html("button.jump", { type: "button", id: "events-newest", hidden: true, text: "Newest" });
  const mark = html("button", {
    type: "button",
    id: "events-mark",
    text: "Mark now",
    title: "Write a mark into the flight log",
  });
  const none = html("p.quiet", { text: "Nothing has happened yet." });
  place.append(html("div.row", {}, filter, mark, jump), note, none, log);
  let shownVersion = -1;
  let shownLevel = "";

  log.addEventListener("scroll", () => (jump.hidden = lines.isAtNewest));
  jump.addEventListener("click", () => lines.toNewest());
  filter.addEventListener("change", () => show());
  mark.addEventListener("click", () => sender.send(MARK, { text: "mark" }, { note }));

  function show() {
    shownVersion = store.eventsVersion;
    shownLevel = filter.value;
    const least = ORDER.indexOf(shownLevel);
    const shown = store.events.filter((each) => ORDER.indexOf(each.level) >= least);
    lines.show(shown, store.flight_s);
    none.hidden = shown.length > 0;
    setText(none, store.events.length > 0 ? "None of this kind." : "Nothing has happened yet.");
    jump.hidden = lines.isAtNewest;
  }

  return {
    update() {
      if (store.eventsVersion !== shownVersion || filter.value !== shownLevel) {
        show();
      }
      lines.showAges(store.flight_s);
      const reason = sender.disabledReason(MARK);
      mark.disabled = reason !== null;
      mark.hidden = store.replay !== null;
      setAttribute(mark, "title", reason?.text ?? "Write a mark into the flight log");
    },
  };
}

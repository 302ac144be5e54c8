import { setAttribute, setText } from "../readout.js";
import { Asker } from "./asker.js";
import { element } from "./element.js";
import { EventLines } from "./event_lines.js";

const LEVELS = [
  ["info", "All"],
  ["warning", "Warnings and alarms"],
  ["alarm", "Alarms"],
];
const ORDER = ["info", "warning", "alarm"];
const MARK = "black_box.mark";

/** The events in plain words, the newest last. */
export function mount(place, store, connection) {
  const asker = new Asker(store, connection);
  const note = element("p.note", { role: "status" });
  const list = element("ol");
  const log = element(
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
  const filter = element("select", { id: "events-level", "aria-label": "Which events" });
  filter.append(...LEVELS.map(([value, text]) => element("option", { value, text })));
  const jump = element("button.jump", { type: "button", id: "events-newest", hidden: true, text: "Newest" });
  const mark = element("button", {
    type: "button",
    id: "events-mark",
    text: "Mark now",
    title: "Write a mark into the flight log",
  });
  const none = element("p.quiet", { text: "Nothing has happened yet." });
  place.append(element("div.row", {}, filter, mark, jump), note, none, log);
  let shownVersion = -1;
  let shownLevel = "";

  log.addEventListener("scroll", () => (jump.hidden = lines.isAtNewest));
  jump.addEventListener("click", () => lines.toNewest());
  filter.addEventListener("change", () => show());
  mark.addEventListener("click", () => asker.ask(MARK, { text: "mark" }, { note }));

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
      const why = asker.objection(MARK);
      mark.disabled = why !== "";
      mark.hidden = store.replay !== null;
      setAttribute(mark, "title", why || "Write a mark into the flight log");
    },
  };
}

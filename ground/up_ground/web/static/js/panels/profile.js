import { Asker } from "./asker.js";
import { element } from "./element.js";
import { profileParts } from "./profile_words.js";

const REQUEST = "arduino.profile.request";

/** The airframe as the Arduino holds it, to read. */
export function mount(place, store, connection) {
  const asker = new Asker(store, connection);
  const note = element("p.note", { role: "status" });
  const ask = element("button", {
    type: "button",
    id: "profile-ask",
    text: "Ask the aircraft",
    on: { click: () => asker.ask(REQUEST, {}, { note }) },
  });
  const how = element("p.quiet", {
    text: "airframe.yml on the aircraft sets it; from here it can only be read.",
  });
  const parts = element("div.profile", { id: "profile" });
  place.append(how, element("div.row", {}, ask), note, parts);
  let shown = null;

  function show(profile) {
    shown = profile;
    parts.replaceChildren();
    for (const { title, rows } of profile === null ? [] : profileParts(profile)) {
      const list = element("dl");
      for (const [name, words] of rows) {
        list.append(element("dt", { text: name }), element("dd", { text: words }));
      }
      parts.append(element("h3", { text: title }), list);
    }
  }

  return {
    update() {
      ask.hidden = store.replay !== null;
      ask.disabled = asker.objection(REQUEST) !== "";
      if (store.profile !== shown) {
        show(store.profile);
      }
    },
  };
}

import { html, setAttribute, setText } from "../dom.js";
import { Pace } from "../readout.js";
import { ageText, UNKNOWN } from "../state/format.js";
import { READINGS } from "../state/schema.js";

const WORDS = { live: "live", stale: "old", none: "never came" };

/** Each reading on board: its source, its age, and whether it can be trusted. */
export function mount(element, store) {
  const body = html("tbody");
  const head = ["Reading", "From", "Age", "State"].map((name) =>
    html("th", { scope: "col" }, name),
  );
  element.append(
    html("table", { class: "readings" }, html("thead", {}, html("tr", {}, ...head)), body),
  );
  const lines = Object.entries(READINGS).map(([reading, { title }]) => {
    const source = html("td", { "data-key": `source.${reading}` });
    const age = html("td", { class: "number", "data-key": `age_ms.${reading}` });
    const state = html("td", { class: "reading-state" });
    const row = html(
      "tr",
      {},
      html("th", { scope: "row" }, title || reading),
      source,
      age,
      state,
    );
    body.append(row);
    return { reading, source, age, state };
  });
  const pace = new Pace();
  return {
    update() {
      const isTime = pace.isTime(store.now_s);
      for (const { reading, source, age, state } of lines) {
        const age_s = store.age_s(reading);
        const freshness = age_s === null ? "none" : store.freshness(reading);
        setText(source, store.text(`source.${reading}`) ?? UNKNOWN);
        if (isTime || age_s === null) {
          setText(age, ageText(age_s));
        }
        setText(state, WORDS[freshness]);
        setAttribute(source, "data-freshness", store.freshnessAt(`source.${reading}`));
        setAttribute(age, "data-freshness", freshness);
        setAttribute(state, "data-state", freshness);
      }
    },
  };
}

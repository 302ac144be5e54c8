import { setAttribute, setText } from "../readout.js";
import { acknowledge, forgetOthers, isAcknowledged } from "./acknowledged.js";
import { element } from "./element.js";

/**
 * The alarms that stand: a bar each, until it is over. Acknowledging silences it.
 * @param {HTMLElement} place
 * @param {object} store
 * @returns {{update: () => void}}
 */
export function mount(place, store) {
  const bars = new Map();

  function barOf(alarm) {
    const text = element("strong");
    const button = element("button.acknowledge", {
      type: "button",
      on: { click: () => acknowledge(alarm) },
    });
    const bar = element(
      "div.alarm",
      { role: "alert", "data-kind": alarm.kind, "data-level": alarm.level },
      text,
      button,
    );
    return { bar, text, button };
  }

  return {
    update() {
      const standing = store.alarms.filter((each) => typeof each?.text === "string");
      forgetOthers(standing);
      const keys = new Set(standing.map(keyOf));
      for (const [key, { bar }] of bars) {
        if (!keys.has(key)) {
          bar.remove();
          bars.delete(key);
        }
      }
      for (const alarm of standing) {
        if (!bars.has(keyOf(alarm))) {
          bars.set(keyOf(alarm), barOf(alarm));
          place.append(bars.get(keyOf(alarm)).bar);
        }
        const { bar, text, button } = bars.get(keyOf(alarm));
        const isSeen = isAcknowledged(alarm);
        setText(text, alarm.text);
        setText(button, isSeen ? "Acknowledged" : "Acknowledge");
        setAttribute(bar, "data-acknowledged", String(isSeen));
        button.disabled = isSeen;
      }
      place.hidden = bars.size === 0;
    },
  };
}

function keyOf(alarm) {
  return `${alarm.kind} ${alarm.level}`;
}

import { html, setAttribute, setText } from "../dom.js";
import { offlineReason } from "./disabled_reason.js";
import { modeReason } from "../state/flight_mode.js";
import { acknowledge, dropAcknowledged, isAcknowledged } from "../state/alarm_level.js";

/** The active alarms: a bar each, until it is over. Acknowledging silences it. */
export function mount(place, store, connection) {
  const bars = new Map();
  const away = html("div.alarm", { id: "aircraft-away", role: "alert", "data-level": "warning" }, html("strong"));
  const fallback = html("div.alarm", { id: "fallback", role: "alert", "data-level": "alarm" }, html("strong"));
  let aircraft = store.aircraft;

  function showFallback() {
    const code = store.freshness(null) === "none" ? null : store.text("flight_control.fallback");
    if (code === null) {
      fallback.remove();
    } else if (!fallback.isConnected) {
      place.prepend(fallback);
    }
    const now = store.text("flight_control.mode") ?? "No flight mode of the Raspberry Pi";
    const asked = store.text("flight_control.selected");
    setText(fallback.firstChild, `${now} replaces ${asked}: ${modeReason(code ?? "")}`);
    setAttribute(fallback, "data-code", code ?? "");
  }

  // If the aircraft had sent telemetry before, its own alarm already reports this.
  function showAway(standing) {
    const isReported = standing.some(({ code }) => code === "aircraft_offline");
    const reason = isReported || !connection.isOpen ? null : offlineReason(store);
    if (reason === null) {
      away.remove();
    } else if (!away.isConnected) {
      place.prepend(away);
    }
    setText(away.firstChild, reason?.text ?? "");
    setAttribute(away, "data-code", reason?.code ?? "");
  }

  function barOf(alarm) {
    const text = html("strong");
    const button = html("button.acknowledge", {
      type: "button",
      on: { click: () => acknowledge(alarm) },
    });
    const bar = html(
      "div.alarm",
      { role: "alert", "data-kind": alarm.kind, "data-code": alarm.code ?? "", "data-level": alarm.level },
      text,
      button,
    );
    return { bar, text, button };
  }

  return {
    update() {
      const standing = store.alarms.filter((each) => typeof each?.text === "string");
      // An acknowledgement for one aircraft does not hold for another.
      dropAcknowledged(store.aircraft === aircraft ? standing : []);
      aircraft = store.aircraft;
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
      showAway(standing);
      showFallback();
      place.hidden = place.childElementCount === 0;
    },
  };
}

function keyOf(alarm) {
  return `${alarm.kind} ${alarm.level}`;
}

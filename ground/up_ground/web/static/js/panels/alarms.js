import { html, setAttribute, setText } from "../dom.js";
import { offlineReason } from "./disabled_reason.js";
import { modeReason } from "../state/flight_mode.js";
import { acknowledge, allAlarms, dropAcknowledged, isAcknowledged, keyOf } from "../state/alarm_level.js";
import { OtherAlarm } from "./other_alarm.js";

/** The active alarms: a bar each, until it is over; one bar for other aircraft. Acknowledging silences it. */
export function mount(place, store, connection) {
  const bars = new Map();
  const away = html("div.alarm", { id: "aircraft-away", role: "alert", "data-level": "warning" }, html("strong"));
  const fallback = html("div.alarm", { id: "fallback", role: "alert", "data-level": "alarm" }, html("strong"));
  const failsafe = html("div.alarm", { id: "failsafe", role: "alert", "data-level": "alarm" }, html("strong"));
  const other = new OtherAlarm(store);

  function show(banner, code, text) {
    if (code === null) {
      banner.remove();
    } else if (!banner.isConnected) {
      place.prepend(banner);
    }
    setText(banner.firstChild, code === null ? "" : text);
    setAttribute(banner, "data-code", code ?? "");
  }

  function showMode() {
    const told = (path) => (store.freshness(null) === "none" ? null : store.text(path));
    const now = store.text("flight_control.mode") ?? "No flight mode of the Raspberry Pi";
    const asked = store.text("flight_control.selected");
    const code = told("flight_control.fallback");
    show(fallback, code, `${now} replaces ${asked}: ${modeReason(code)}`);
    const cause = told("failsafe.cause");
    const end = "The pilot's switch or another flight mode ends it.";
    show(failsafe, cause, `Failsafe, ${modeReason(cause)}: ${asked}. ${end}`);
  }

  // If the aircraft had sent telemetry before, its own alarm already reports this.
  function showAway(standing) {
    const isReported = standing.some(({ code }) => code === "aircraft_offline");
    const reason = isReported || !connection.isOpen ? null : offlineReason(store);
    show(away, reason?.code ?? null, reason?.text ?? "");
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
      const all = allAlarms(store).filter((each) => typeof each.text === "string");
      const standing = all.filter((each) => each.aircraft === store.aircraft);
      dropAcknowledged(all);
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
      showMode();
      other.show(place, all.filter((each) => each.aircraft !== store.aircraft));
      place.hidden = place.childElementCount === 0;
    },
  };
}

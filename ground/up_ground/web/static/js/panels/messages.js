import { MODES, OUTCOMES } from "../state/schema.js";

/** The effect of a flight mode, in a few words; empty for an unknown one. */
export function modeText(mode) {
  return Object.hasOwn(MODES, mode) ? MODES[mode].about : "";
}

/** title: of a Command in the catalogue; `{}` in it is the value of its only field. */
export function commandText(title, data = {}) {
  const values = Object.values(data);
  return title.replace("{}", () => (values.length === 1 ? String(values[0]).replaceAll("_", " ") : ""));
}

export function answerText(answer) {
  const reason = String(answer.reason ?? "").replace(/[.\s]+$/, "") || String(answer.code ?? "");
  const after_ms = answer.round_trip_ms;
  const because = reason === "" ? "" : `: ${reason}`;
  const text = Object.hasOwn(OUTCOMES, answer.outcome) ? OUTCOMES[answer.outcome] : `unknown outcome ${answer.outcome}`;
  if (answer.outcome !== "ack") {
    return `${text}${because}`;
  }
  return reason || (Number.isFinite(after_ms) ? `${text} after ${Math.round(after_ms)} ms` : text);
}

/** The outcome for programs: `ack`, `nack forbidden`, `unsent no_link`. */
export function answerCode(answer) {
  return answer.code ? `${answer.outcome} ${answer.code}` : String(answer.outcome);
}

export function answerLook(answer) {
  return answer.outcome === "ack" ? "good" : "bad";
}

/** Data rate of a telemetry period. frame_bytes: measured; null: unknown. */
export function costText(period_ms, frame_bytes) {
  if (frame_bytes === null || !(period_ms > 0)) {
    return "data rate unknown: no frame yet";
  }
  const kilobytes = (3600 * frame_bytes) / period_ms;
  const rate = 1000 / period_ms;
  const often = rate >= 1 ? `${trimmed(rate)} a second` : `one every ${trimmed(1 / rate)} s`;
  return `${often}, about ${amount(kilobytes)} an hour at ${Math.round(frame_bytes)} bytes a frame`;
}

export function agoText(age_s) {
  if (!Number.isFinite(age_s)) {
    return "";
  }
  const whole_s = Math.max(0, Math.floor(age_s));
  if (whole_s < 60) {
    return `${whole_s} s ago`;
  }
  if (whole_s < 3600) {
    return `${Math.floor(whole_s / 60)} min ago`;
  }
  return `${Math.floor(whole_s / 3600)} h ${Math.floor((whole_s % 3600) / 60)} min ago`;
}

/** As 3:07 or 1:02:07. */
export function clockText(time_s) {
  const whole_s = Math.max(0, Math.floor(Number.isFinite(time_s) ? time_s : 0));
  const minutes = Math.floor(whole_s / 60) % 60;
  const seconds = String(whole_s % 60).padStart(2, "0");
  const hours = Math.floor(whole_s / 3600);
  return hours > 0
    ? `${hours}:${String(minutes).padStart(2, "0")}:${seconds}`
    : `${minutes}:${seconds}`;
}

function trimmed(value) {
  return String(Number(value.toFixed(value < 10 ? 1 : 0)));
}

function amount(kilobytes) {
  return kilobytes < 10000 ? `${Math.round(kilobytes)} KB` : `${trimmed(kilobytes / 1000)} MB`;
}

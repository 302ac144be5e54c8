const MODES = {
  RATE: "the sticks ask for rotation",
  FBW: "the sticks ask for attitude, within limits",
  AUTO: "modules on the Raspberry Pi may fly; without one the sticks ask for attitude",
};

/** The effect of a flight mode, in a few words; empty for an unknown one. */
export function modeWords(mode) {
  return Object.hasOwn(MODES, mode) ? MODES[mode] : "";
}

/** name: of a Command. Returns the request of a Command, as a heading. */
export function commandWords(name, data = {}) {
  switch (name) {
    case "up.flight_mode.set":
      return `Flight mode ${data.mode}`;
    case "up.arm":
      return "Arm";
    case "up.disarm":
      return "Disarm";
    case "up.telemetry.frequency":
      return `Telemetry every ${data.frequency} ms`;
    case "android.speak":
      return `Say "${data.text}"`;
    case "black_box.mark":
      return `Mark "${data.text}"`;
    case "arduino.pids.tunings":
      return data.request ? "Ask for the gains" : "New gains";
    case "arduino.profile.request":
      return "Ask for the profile";
    case "arduino.calibrate":
      return `Calibrate ${String(data.what).replace("_", " ")}`;
    default:
      return name;
  }
}

/** The outcome of a Command, in plain words. */
export function answerWords(answer) {
  const reason = String(answer.reason ?? "")
    .replace(/^not sent: /, "")
    .replace(/; it is not known whether it was carried out$/, "")
    .replace(/[.\s]+$/, "");
  const after_ms = answer.round_trip_ms;
  switch (answer.outcome) {
    case "ack":
      if (reason) {
        return reason;
      }
      return Number.isFinite(after_ms)
        ? `carried out after ${Math.round(after_ms)} ms`
        : "carried out";
    case "nack":
      return refusalWords(reason || String(answer.code ?? ""));
    case "timeout":
      return `${reason || "no answer"}: nobody knows whether it was carried out`;
    case "unsent":
      return `not sent: ${reason || "no connection"}`;
    case "refused":
      return `refused by the ground server: ${reason || "no reason given"}`;
    default:
      return `an answer that this page does not know: ${answer.outcome}`;
  }
}

/** Its style. */
export function answerLook(answer) {
  return answer.outcome === "ack" ? "good" : "bad";
}

/** Data rate of a telemetry period. frame_bytes: measured; null: unknown. */
export function costWords(period_ms, frame_bytes) {
  if (frame_bytes === null || !(period_ms > 0)) {
    return "what it costs is not known yet: no frame came";
  }
  const kilobytes = (3600 * frame_bytes) / period_ms;
  const rate = 1000 / period_ms;
  const often = rate >= 1 ? `${trimmed(rate)} a second` : `one every ${trimmed(1 / rate)} s`;
  return `${often}, about ${amount(kilobytes)} an hour at ${Math.round(frame_bytes)} bytes a frame`;
}

/** How long ago, short. */
export function agoWords(age_s) {
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
export function clockWords(time_s) {
  const whole_s = Math.max(0, Math.floor(Number.isFinite(time_s) ? time_s : 0));
  const minutes = Math.floor(whole_s / 60) % 60;
  const seconds = String(whole_s % 60).padStart(2, "0");
  const hours = Math.floor(whole_s / 3600);
  return hours > 0
    ? `${hours}:${String(minutes).padStart(2, "0")}:${seconds}`
    : `${minutes}:${seconds}`;
}

// The board's own refusal already has its name: do not repeat it.
function refusalWords(reason) {
  const [, ofBoard] = /^the Arduino refused: (.+)$/s.exec(reason) ?? [];
  return ofBoard ? `refused by the Arduino: ${ofBoard}` : `refused by the aircraft: ${reason || "no reason given"}`;
}

function trimmed(value) {
  return String(Number(value.toFixed(value < 10 ? 1 : 0)));
}

function amount(kilobytes) {
  return kilobytes < 10000 ? `${Math.round(kilobytes)} KB` : `${trimmed(kilobytes / 1000)} MB`;
}

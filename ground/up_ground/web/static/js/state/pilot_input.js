const CENTRE_US = 1500;
const HALF_TRAVEL_US = 500;
/** The bank at full stick of a new Arduino. */
const ROLL_DEG = 50;

/** The bank that the stick demands in FBW, right wing down positive; null: no demand in other modes. */
export function rollDemand_deg(store) {
  const stick_us = store.number("rx.ailerons");
  if (store.text("flight_mode") !== "FBW" || stick_us === null || store.freshness("rx") !== "live") {
    return null;
  }
  const limit_deg = store.profile?.fly_by_wire?.roll_deg;
  const part = Math.max(-1, Math.min(1, (stick_us - CENTRE_US) / HALF_TRAVEL_US));
  return part * (Number.isFinite(limit_deg) ? limit_deg : ROLL_DEG);
}

/** The positions' modes without a profile: the firmware's defaults (docs/airframe.md). */
const SELECTS = { low: "ACRO", middle: "FBW", high: "AUTO" };

/**
 * The mode that the pilot's switch selects: the aircraft reports the position, its profile the
 * meaning of the position. Returns ACRO, RATE, FBW or AUTO; null: not known.
 */
export function switchMode(store) {
  const position = store.text("arduino.switch");
  if (position === null || !Object.hasOwn(SELECTS, position)) {
    return null;
  }
  const told = store.profile?.switch?.[position];
  return typeof told === "string" ? told : SELECTS[position];
}

/** The position and what it selects; without a profile, the default. */
export function switchText(store) {
  const position = store.text("arduino.switch");
  const selected = switchMode(store);
  if (selected === null) {
    return position ?? "";
  }
  const isTold = typeof store.profile?.switch?.[position] === "string";
  return `${position}: ${selected}${isTold ? "" : " (default)"}`;
}

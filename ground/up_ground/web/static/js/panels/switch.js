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

/**
 * What the pilot's switch selects where it stands: the aircraft tells the position, its profile
 * what the position means.
 * @param {object} store
 * @returns {string|null} ACRO, RATE, FBW or AUTO; null: not known
 */
export function switchMode(store) {
  const position = store.text("arduino.switch");
  const selected = position === null ? null : store.profile?.switch?.[position];
  return typeof selected === "string" ? selected : null;
}

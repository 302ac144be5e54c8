const RANK = { observer: 0, operator: 1, pilot: 2 };

/** The least role for each Command (docs/protocols.md 5); Commands not listed: an operator. */
const NEEDED = {
  "arduino.profile.request": "observer",
  "up.arm": "pilot",
  "up.disarm": "pilot",
  "arduino.calibrate": "pilot",
  "arduino.pids.tunings": "pilot",
};

/**
 * role: allowed by the aircraft's link; null: unknown, the aircraft refuses; name: of the Command;
 * least: role in the server's catalogue; null: the table above decides. Returns whether to offer
 * it.
 */
export function roleAllows(role, name, least = null) {
  if (role === null || !Object.hasOwn(RANK, role)) {
    return true;
  }
  const needed = least ?? (Object.hasOwn(NEEDED, name) ? NEEDED[name] : "operator");
  return RANK[role] >= RANK[needed];
}

/** Whether it only requests data, and needs no control. */
export function isOnlyRequest(name, data = {}) {
  return (
    name === "arduino.profile.request" || (name === "arduino.pids.tunings" && data.request === true)
  );
}

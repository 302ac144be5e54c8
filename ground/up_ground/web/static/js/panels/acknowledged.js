const known = new Set();

/**
 * Silence an alarm until it is over and returns.
 * @param {{kind: string, level: string}} alarm
 */
export function acknowledge(alarm) {
  known.add(keyOf(alarm));
}

/**
 * @param {{kind: string, level: string}} alarm
 * @returns {boolean} whether the user has acknowledged it
 */
export function isAcknowledged(alarm) {
  return known.has(keyOf(alarm));
}

/**
 * Forget alarms that are over: when one returns, it sounds again.
 * @param {{kind: string, level: string}[]} alarms that are active now
 */
export function forgetOthers(alarms) {
  const standing = new Set(alarms.map(keyOf));
  for (const key of known) {
    if (!standing.has(key)) {
      known.delete(key);
    }
  }
}

function keyOf(alarm) {
  return `${alarm.kind} ${alarm.level}`;
}

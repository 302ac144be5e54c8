const known = new Set();

/** Silence an alarm until it is over and returns. */
export function acknowledge(alarm) {
  known.add(keyOf(alarm));
}

/** Whether the user has acknowledged it. */
export function isAcknowledged(alarm) {
  return known.has(keyOf(alarm));
}

/** Forget alarms that are over: when one returns, it sounds again. alarms: that are active now. */
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

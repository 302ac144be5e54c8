const LEVELS = ["none", "info", "warning", "alarm"];

export function worstLevel(alarms) {
  const worst = Math.max(0, ...alarms.map((each) => LEVELS.indexOf(each?.level)));
  return LEVELS[worst];
}

/**
 * The worst alarm; alarms that the page detects come before those from the server. Returns text: in
 * two words; null: not known.
 */
export function alarmOf(store, connection) {
  if (!connection.isOpen) {
    return { level: "alarm", text: connection.isFull ? "server full" : "no server" };
  }
  const level = worstLevel(store.alarms);
  if (level !== "alarm" && store.aircraftState === "silent") {
    return { level: "alarm", text: "silent" };
  }
  if (level === "none") {
    return { level, text: store.aircraftState === "live" ? "none" : null };
  }
  const worst = store.alarms.filter((each) => each.level === level);
  return { level, text: worst.length === 1 ? String(worst[0].kind) : `${worst.length} alarms` };
}

/** The active alarms of all aircraft, those of the watched one first: {aircraft, kind, code, level, text}. */
export function allAlarms(store) {
  const own = store.alarms.map((each) => ({ ...each, aircraft: store.aircraft }));
  return [...own, ...store.fleet.othersAlarms(store.aircraft)];
}

/** What sounds: {alarm, all} for the bell: of any aircraft, without acknowledged alarms. */
export function soundingAlarms(store, connection) {
  const all = allAlarms(store).filter((each) => !isAcknowledged(each));
  const shown = alarmOf(store, connection);
  const isOfPage = !connection.isOpen || (shown.level === "alarm" && worstLevel(store.alarms) !== "alarm");
  return { alarm: isOfPage ? shown : { level: worstLevel(all), text: null }, all };
}

const known = new Set();

/** Silence an alarm until it is over and returns. alarm: with its aircraft. */
export function acknowledge(alarm) {
  known.add(keyOf(alarm));
}

export function isAcknowledged(alarm) {
  return known.has(keyOf(alarm));
}

/** Forget alarms that are over: when one returns, it sounds again. alarms: all that are active now. */
export function dropAcknowledged(alarms) {
  const standing = new Set(alarms.map(keyOf));
  for (const key of known) {
    if (!standing.has(key)) {
      known.delete(key);
    }
  }
}

/** Identifies an alarm while it lasts. */
export function keyOf({ aircraft, kind, level }) {
  return `${aircraft} ${kind} ${level}`;
}

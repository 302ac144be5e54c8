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

/**
 * How long the aircraft has been in flight: since it was armed, an aircraft without a motor since it
 * counts as in flight. A page that was opened later knows the event, or no more than its own time.
 */
export class FlightTimer {
  #seen_s = null;

  /** Returns {time_s, isExact}; null: not in flight, or unknown. Times are the flight's. */
  update(store) {
    const isInFlight = store.flag("armed") === true || store.flag("in_flight") === true;
    const now_s = store.flight_s;
    if (!isInFlight || (this.#seen_s !== null && now_s < this.#seen_s)) {
      this.#seen_s = null;
    }
    if (!isInFlight) {
      return null;
    }
    this.#seen_s ??= now_s;
    const armed = store.events.findLast(({ code }) => code === "armed" || code === "disarmed");
    const isExact = store.flag("armed") === true && armed?.code === "armed";
    return { time_s: Math.max(0, now_s - (isExact ? armed.at_s : this.#seen_s)), isExact };
  }
}

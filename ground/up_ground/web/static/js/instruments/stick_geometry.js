const REACH = 44;
const MIDDLE_US = 1500;
const HALF_US = 500;

/**
 * Where a stick stands in its gimbal: right and up are positive pulses, but a pulled elevator
 * (above 1500 us, nose up) is a stick drawn down. along: the channel of the vertical. Returns null:
 * a channel is not known.
 */
export function stickPlace(x_us, y_us, along) {
  if (x_us === null || y_us === null) {
    return null;
  }
  const down = along === "elevator" ? 1 : -1;
  return {
    x: (share(x_us) * REACH).toFixed(1),
    y: (down * share(y_us) * REACH).toFixed(1),
  };
}

/** -1 at 1000 us, 0 at 1500 us, 1 at 2000 us, and not beyond 1.1. */
export function share(pulse_us) {
  return Math.max(-1.1, Math.min(1.1, (pulse_us - MIDDLE_US) / HALF_US));
}

/** Whether it lies beyond the scale of 1000 to 2000 us. */
export function beyond(pulse_us) {
  return pulse_us < MIDDLE_US - HALF_US
    ? "low"
    : pulse_us > MIDDLE_US + HALF_US
      ? "high"
      : "within";
}

import { short } from "../dom.js";

/** Distance of one degree of pitch in the drawing. */
export const UNITS_PER_DEG = 5;

/** The rungs of the pitch ladder: long with a number each 10 degrees, short each 5, near the horizon 2.5. */
export function rungs() {
  const all = [];
  for (let pitch_deg = -90; pitch_deg <= 90; pitch_deg += 2.5) {
    const isNear = Math.abs(pitch_deg) < 20;
    if (pitch_deg === 0 || (pitch_deg % 5 !== 0 && !isNear)) {
      continue;
    }
    const isTen = pitch_deg % 10 === 0;
    const halfWidth = isTen ? 34 : pitch_deg % 5 === 0 ? 18 : 9;
    all.push({ pitch_deg, halfWidth, label: isTen ? String(Math.abs(pitch_deg)) : "" });
  }
  return all;
}

/** The transform of the ball: right wing down turns it to the left, nose up moves it down. */
export function ballTransform(roll_deg, pitch_deg) {
  const shift = Math.max(-90, Math.min(90, pitch_deg)) * UNITS_PER_DEG;
  return `rotate(${short(-roll_deg)}) translate(0 ${short(shift)})`;
}

/** Whether a rung's label, with its middle at x, y of the ladder, is whole within bank arc and picture. */
export function isWhole(x, y, roll_deg, pitch_deg) {
  const turn = (-roll_deg * Math.PI) / 180;
  const down = y + Math.max(-90, Math.min(90, pitch_deg)) * UNITS_PER_DEG;
  const across = x * Math.cos(turn) - down * Math.sin(turn);
  const along = x * Math.sin(turn) + down * Math.cos(turn);
  const isBelowArc = along > -40 || Math.hypot(across, along) < 95;
  return isBelowArc && Math.abs(across) < (along < -10 ? 88 : 107) && along < 133;
}

export function rollMarks() {
  const lengths = { 10: 6, 20: 6, 30: 12, 45: 7, 60: 12 };
  return Object.entries(lengths).flatMap(([roll_deg, length]) => [
    { roll_deg: -Number(roll_deg), length },
    { roll_deg: Number(roll_deg), length },
  ]);
}

/** A point on a circle around the middle, clockwise from above. */
export function onCircle(angle_deg, radius) {
  const angle = (angle_deg * Math.PI) / 180;
  return [radius * Math.sin(angle), -radius * Math.cos(angle)];
}

const REACH = 44;
const MIDDLE_US = 1500;
const HALF_US = 500;

/** A stick in its gimbal; nose up (above 1500 us) is a stick drawn down. along: the vertical channel. */
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

/**
 * A scale that moves past a pointer, greater values above.
 *
 * Only changes are reported: `first` is the lowest mark drawn and stays the same until the value
 * has moved by a whole step; in between only `shift` changes.
 */
export class TapeScale {
  /** step: between marks; units: of the drawing for a step; height: of the drawing. */
  constructor({ step, units, height }) {
    this.step = step;
    this.units = units;
    this.count = 2 * (Math.ceil(height / 2 / units) + 1) + 1;
  }

  /** value: at the pointer. Returns shift: how far down the marks move. */
  at(value) {
    const middle = Math.round(value / this.step);
    const below = (this.count - 1) / 2;
    return {
      first: (middle - below) * this.step,
      shift: (value / this.step - middle) * this.units,
    };
  }

  /** place: of a mark, counted from the lowest. Returns where it is drawn while the shift is 0. */
  y(place) {
    return ((this.count - 1) / 2 - place) * this.units;
  }
}

/** The needle of a scale that is finer around zero: the root of value / most, within the length. */
export function rootScale(value, most, length) {
  const share = Math.min(1, Math.abs(value) / most);
  return Math.sign(value) * Math.sqrt(share) * length;
}

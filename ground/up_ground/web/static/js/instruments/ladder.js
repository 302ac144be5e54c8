import { short } from "./svg.js";

/** Distance of one degree of pitch in the drawing. */
export const UNITS_PER_DEG = 5;

/**
 * The rungs of the pitch ladder to the zenith and the nadir: long and numbered each 10 degrees,
 * short each 5, and near the horizon each 2.5.
 */
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

/**
 * Where the ball stands: right wing down turns the picture to the left, nose up moves it down.
 * Returns of a transform attribute.
 */
export function ballTransform(roll_deg, pitch_deg) {
  const shift = Math.max(-90, Math.min(90, pitch_deg)) * UNITS_PER_DEG;
  return `rotate(${short(-roll_deg)}) translate(0 ${short(shift)})`;
}

/**
 * Whether the label of a rung is whole within the bank arc and the edges of the picture. x: of its
 * middle, on the ladder; y: of its middle, on the ladder.
 */
export function isWhole(x, y, roll_deg, pitch_deg) {
  const turn = (-roll_deg * Math.PI) / 180;
  const down = y + Math.max(-90, Math.min(90, pitch_deg)) * UNITS_PER_DEG;
  const across = x * Math.cos(turn) - down * Math.sin(turn);
  const along = x * Math.sin(turn) + down * Math.cos(turn);
  const isBelowArc = along > -40 || Math.hypot(across, along) < 95;
  return isBelowArc && Math.abs(across) < (along < -10 ? 88 : 107) && along < 133;
}

/** The marks of the roll scale. */
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

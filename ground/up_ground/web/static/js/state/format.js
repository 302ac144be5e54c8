export const UNKNOWN = "--";

/** sign: + before values that are not negative. */
export function numberText(value, decimals = 0, { sign = false } = {}) {
  if (value === null || value === undefined || !Number.isFinite(value)) {
    return UNKNOWN;
  }
  let shown = value.toFixed(decimals);
  if (Number(shown) === 0) {
    shown = shown.replace("-", "");
  }
  return sign && !shown.startsWith("-") ? `+${shown}` : shown;
}

/** value: of unknown precision. Returns with its significant digits, 9 at most. */
export function plainNumber(value) {
  if (!Number.isFinite(value)) {
    return UNKNOWN;
  }
  if (Number.isSafeInteger(value)) {
    return String(value);
  }
  // Single precision: show only the digits that distinguish the value from its neighbours.
  const isSingle = Math.fround(value) === value;
  const figures = [6, 7, 8].find((each) => isSingle && Math.fround(Number(value.toPrecision(each))) === value);
  return String(Number(value.toPrecision(figures ?? 9)));
}

/** As `0.03 s`, `12.4 s`, `3 min`, `2 h`. */
export function ageText(age_s) {
  if (age_s === null || age_s === undefined || !Number.isFinite(age_s)) {
    return UNKNOWN;
  }
  if (age_s < 9.995) {
    return `${Math.max(0, age_s).toFixed(2)} s`;
  }
  if (age_s < 99.95) {
    return `${age_s.toFixed(1)} s`;
  }
  if (age_s < 3600) {
    return `${(age_s / 60).toFixed(0)} min`;
  }
  return age_s < 360000 ? `${(age_s / 3600).toFixed(0)} h` : "days";
}

export function flagText(value, yes = "yes", no = "no") {
  return value === null || value === undefined ? UNKNOWN : value ? yes : no;
}

/** The same direction in 0 (included) to 360 (not included). */
export function compassDegrees(degrees) {
  return degrees === null ? null : ((degrees % 360) + 360) % 360;
}

export function headingText(degrees) {
  if (degrees === null) {
    return UNKNOWN;
  }
  return String(Math.round(compassDegrees(degrees)) % 360).padStart(3, "0");
}

export function capital(word) {
  return word[0].toUpperCase() + word.slice(1);
}

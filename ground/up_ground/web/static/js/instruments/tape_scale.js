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

/**
 * The needle of a scale that is finer around zero: the root of the share, with its sign. most: the
 * value at the end; length: of the scale from its middle. Returns upwards positive, within the
 * length.
 */
export function rootScale(value, most, length) {
  const share = Math.min(1, Math.abs(value) / most);
  return Math.sign(value) * Math.sqrt(share) * length;
}

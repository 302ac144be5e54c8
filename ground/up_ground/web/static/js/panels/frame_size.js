/** Overhead of a frame's message around its tree: its name, the beacon, the line's end. */
const AROUND_BYTES = 52;
const EVERY = 20;

/** Bytes of a telemetry frame as received from the aircraft: measured now and then. */
export class FrameSize {
  #nextAt = 0;

  /** @type {number|null} the mean of the last ones; null: no frame yet */
  bytes = null;

  /** tree: of the newest frame; count: of all frames so far. */
  look(tree, count) {
    if (count === 0 || count < this.#nextAt) {
      return;
    }
    this.#nextAt = count + EVERY;
    const bytes = new TextEncoder().encode(JSON.stringify(tree)).length + AROUND_BYTES;
    this.bytes = this.bytes === null ? bytes : this.bytes + (bytes - this.bytes) / 4;
  }
}

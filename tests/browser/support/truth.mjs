// What the aircraft truly did, on the clock of the page.

const METRES_PER_DEG = 111_320;

/**
 * Return a showcase's true states so far, each with the time of the machine's clock at which it
 * was. The model flies in real time and each state is written immediately: the line that was read
 * with the least delay gives the start of its clock.
 */
export async function truthOf(showcase) {
  let began_s = Infinity;
  let rows = [];
  for (let look = 0; look < 10; look += 1) {
    rows = showcase.truth();
    began_s = Math.min(began_s, Date.now() / 1000 - rows[rows.length - 1].time_s);
    await new Promise((resolve) => setTimeout(resolve, 15));
  }
  return rows.map((row) => ({ ...row, unix_s: began_s + row.time_s }));
}

/** The states between two times, seconds. */
export function between(truth, from_s, to_s) {
  return truth.filter(({ unix_s }) => unix_s >= from_s && unix_s <= to_s);
}

/** How far two places are from each other, metres. */
export function distance_m(one, other) {
  const north = (one.latitude - other.latitude) * METRES_PER_DEG;
  const east_per_deg = METRES_PER_DEG * Math.cos((one.latitude * Math.PI) / 180);
  return Math.hypot(north, (one.longitude - other.longitude) * east_per_deg);
}

/**
 * Return by how many seconds shown values are late, and how far they are off then.
 * @param {{unix_s: number, value: number}[]} shown
 * @param {{unix_s: number}[]} truth
 * @param {string} column
 * @returns {{late_s: number, off: number}} off: the mean of the absolute differences
 */
export function lateness(shown, truth, column, most_s = 1.5) {
  let best = { late_s: NaN, off: Infinity };
  for (let late_s = 0; late_s <= most_s; late_s += 0.02) {
    let sum = 0;
    let index = 0;
    for (const { unix_s, value } of shown) {
      const at_s = unix_s - late_s;
      while (index + 1 < truth.length && truth[index + 1].unix_s <= at_s) {
        index += 1;
      }
      sum += Math.abs(truth[index][column] - value);
    }
    const off = sum / shown.length;
    if (off < best.off) {
      best = { late_s, off };
    }
  }
  return best;
}

/**
 * A flight of the server: {name, aircraft, start_unix_s, length_s, armed_s, bands, events, columns}.
 * offset_s: how much later it is drawn.
 */
export class FlightData {
  offset_s = 0;
  #number;

  constructor(number, about) {
    this.#number = number;
    Object.assign(this, about);
  }

  /** The number of the column with a name, or of its first kind; -1: none. */
  find(name) {
    const exact = this.columns.findIndex((each) => each.name === name);
    return exact < 0 ? this.columns.findIndex((each) => each.name.startsWith(`${name} [`)) : exact;
  }

  /** What a chart of that many pixels shows of a span of the page's time: {times_s, values}; NaN: a gap. */
  async window(column, begin_s, end_s, pixels) {
    return this.#points("window", column, begin_s, end_s, { pixels });
  }

  /** The values of a span as they are, from its begin on. */
  async samples(column, begin_s, end_s) {
    return this.#points("samples", column, begin_s, end_s);
  }

  /** {times_s, east_m, north_m, values}: the track, and a column's values there. */
  async track(column) {
    const data = await this.#get("track", { column });
    const count = data.byteLength / 20;
    const part = (index) => new Float32Array(data, count * (8 + 4 * index), count);
    const times_s = new Float64Array(data, 0, count).map((each) => each + this.offset_s);
    return { times_s, east_m: part(0), north_m: part(1), values: part(2) };
  }

  async #points(what, column, begin_s, end_s, more = {}) {
    const span = { begin: begin_s - this.offset_s, end: end_s - this.offset_s };
    const data = await this.#get(what, { column, ...span, ...more });
    const count = data.byteLength / 12;
    const times_s = new Float64Array(data, 0, count).map((each) => each + this.offset_s);
    return { times_s, values: new Float32Array(data, count * 8, count) };
  }

  async #get(what, query) {
    const answer = await fetch(`log/${what}?${new URLSearchParams({ flight: this.#number, ...query })}`);
    if (!answer.ok) {
      throw new Error(`${what}: ${await answer.text()}`);
    }
    return answer.arrayBuffer();
  }
}

/** All flights of the server. */
export async function readFlights() {
  const answer = await fetch("log/index");
  if (!answer.ok) {
    throw new Error("this server shows no flight: start it with 'up log view FLIGHT'");
  }
  const { flights } = await answer.json();
  return flights.map((each, number) => new FlightData(number, each));
}

const COLOURS = 6;

/** One curve: a column of a flight, {flight, column, name, unit}, and the newest points fetched of it. */
export class Signal {
  points = { times_s: new Float64Array(), values: new Float32Array() };

  /** isOther: of the flight that is drawn over the first one. */
  constructor(flight, column, isOther, colour) {
    this.flight = flight;
    /** The name of its colour in the style sheet; both flights' curves of a name have one. */
    this.colour = `--curve-${(colour % COLOURS) + 1}`;
    this.column = column;
    this.isOther = isOther;
    ({ name: this.name, unit: this.unit } = flight.columns[column]);
  }

  /** The last value until a time; null: none is shown. */
  at(time_s) {
    const { times_s, values } = this.points;
    let [low, high] = [0, times_s.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      [low, high] = times_s[middle] <= time_s ? [middle + 1, high] : [low, middle];
    }
    return low > 0 && Number.isFinite(values[low - 1]) ? values[low - 1] : null;
  }

  /** The points as uPlot takes them: null is a gap. */
  get table() {
    const { times_s, values } = this.points;
    return [Array.from(times_s), Array.from(values, (each) => (Number.isFinite(each) ? each : null))];
  }
}

/** The signals of a name in all flights; empty: no flight has it. colour: a number. */
export function signalsOf(flights, name, colour = 0) {
  return flights.flatMap((flight, number) => {
    const column = flight.find(name);
    return column < 0 ? [] : [new Signal(flight, column, number > 0, colour)];
  });
}

/** Offer every name of all flights. */
export function fillSignals(datalist, flights) {
  const names = new Set(flights.flatMap((flight) => flight.columns.map((each) => each.name)));
  datalist.replaceChildren(
    ...[...names].sort().map((name) => {
      const option = document.createElement("option");
      option.value = name;
      return option;
    }),
  );
}

import { coloursOf, html } from "../dom.js";
import { spectrumOf } from "./fourier.js";
import { signalsOf } from "./signal.js";

const HEIGHT_PX = 190;
const NAMES = ["up.orientation.update.roll_rate", "simulator.truth.roll_rate_deg_s"];

/** The amplitudes of the frequencies in the visible part of one signal, of all flights. */
export class Spectrum {
  #UPlot;
  #flights;
  #window;
  #place = html("div.log-plot");
  #note = html("p", { id: "log-spectrum-note", role: "status" });
  #select = html("select", { "aria-label": "The signal of the spectrum", on: { change: () => this.load() } });
  #plot = null;
  #asked = 0;
  #found = [];

  constructor(UPlot, place, flights, window) {
    this.#UPlot = UPlot;
    this.#flights = flights;
    this.#window = window;
    const names = flights[0].columns.filter((each) => each.count > 100).map((each) => each.name);
    this.#select.append(...names.map((name) => html("option", { value: name, text: name })));
    const first = NAMES.find((name) => flights[0].find(name) >= 0);
    this.#select.value = first ? flights[0].columns[flights[0].find(first)].name : (names[0] ?? "");
    place.append(this.#select, this.#place, this.#note);
  }

  async load() {
    const asked = (this.#asked += 1);
    const { begin_s, end_s } = this.#window;
    const signals = signalsOf(this.#flights, this.#select.value);
    const samples = await Promise.all(signals.map((each) => each.flight.samples(each.column, begin_s, end_s)));
    if (asked === this.#asked) {
      this.#found = signals.map((signal, index) => ({ signal, ...spectrumOf(samples[index].times_s, samples[index].values) }));
      this.rebuild();
    }
  }

  rebuild() {
    this.#plot?.destroy();
    this.#plot = null;
    const known = this.#found.filter((each) => each.amplitudes);
    this.#note.textContent = known.length ? noteOf(known[0]) : "too few values, or a silence among them: show another span";
    const width = this.#place.clientWidth;
    if (known.length === 0 || width === 0) {
      return;
    }
    // The mean is removed: the first value is not a frequency.
    const tables = known.map(({ frequencies_hz, amplitudes }) => [Array.from(frequencies_hz.subarray(1)), Array.from(amplitudes.subarray(1))]);
    this.#plot = this.#make(width, this.#UPlot.join(tables), known);
    const [peak_hz, amplitude] = peakOf(known[0]);
    Object.assign(this.#place.dataset, { peakHz: peak_hz.toFixed(3), amplitude: amplitude.toFixed(4) });
  }

  #make(width, data, known) {
    const [dim, line] = coloursOf(this.#place, ["--dim", "--grid"]);
    const font = "11px system-ui, sans-serif";
    const axis = { stroke: dim, grid: { stroke: line, width: 1 }, ticks: { show: false }, font, labelFont: font, labelSize: 16 };
    const { unit } = known[0].signal;
    return new this.#UPlot(
      {
        width,
        height: HEIGHT_PX,
        padding: [6, 10, 0, 0],
        legend: { show: false },
        cursor: { drag: { x: true, y: false } },
        scales: { x: { time: false }, y: { distr: 3 } },
        axes: [
          { ...axis, size: 22, label: "frequency, Hz" },
          { ...axis, size: 44, label: `amplitude${unit ? `, ${unit}` : ""}`, values: (plot, splits) => splits.map(decadeText) },
        ],
        series: [
          {},
          ...known.map(({ signal }) => ({
            stroke: coloursOf(this.#place, [signal.isOther ? "--curve-2" : signal.colour])[0],
            width: 1.5,
            dash: signal.isOther ? [6, 4] : undefined,
            spanGaps: true,
            points: { show: false },
          })),
        ],
      },
      data,
      this.#place,
    );
  }
}

/** Labels of whole decades alone. */
function decadeText(value) {
  return value !== null && Math.abs(Math.log10(value) - Math.round(Math.log10(value))) < 1e-6 ? String(Number(value.toPrecision(1))) : "";
}

/** The frequency of the greatest amplitude, and that amplitude. */
function peakOf({ frequencies_hz, amplitudes }) {
  let peak = 1;
  amplitudes.forEach((each, index) => {
    peak = index > 0 && each > amplitudes[peak] ? index : peak;
  });
  return [frequencies_hz[peak], amplitudes[peak]];
}

function noteOf(found) {
  const [peak_hz, amplitude] = peakOf(found);
  const resolution_hz = found.frequencies_hz[1];
  return `greatest: ${amplitude.toPrecision(3)} ${found.signal.unit} at ${peak_hz.toPrecision(3)} Hz; ${found.rate_hz.toPrecision(3)} samples a second, steps of ${resolution_hz.toPrecision(2)} Hz, ${found.segments} averaged`;
}

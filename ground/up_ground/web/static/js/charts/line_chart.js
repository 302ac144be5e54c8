import { WINDOW_S } from "./history.js";
import { coloursOf, html, setText } from "../dom.js";
import { numberText, plainNumber } from "../state/format.js";

const HEIGHT_PX = 104;

/** One chart of the last minute by uPlot, with its newest values in words above it. */
export class LineChart {
  #UPlot;
  #lines;
  #unit;
  #leastSpan;
  #decimals;
  #plot = null;
  #canvas = html("div.chart-canvas", { role: "img" });
  #now = [];
  #title;
  #width = 0;
  // Reading clientWidth would compute the page's layout in the middle of its changes.
  #sizes = new ResizeObserver(([{ contentRect }]) => {
    this.#width = Math.round(contentRect.width);
  });
  #onTheme = () => this.#rebuild();

  /** decimals: null: as many as it has; leastSpan: of the vertical axis, null: a fiftieth of the values. */
  constructor(UPlot, { title, unit, decimals, leastSpan, lines }) {
    this.#UPlot = UPlot;
    this.#lines = lines;
    this.#unit = unit;
    this.#leastSpan = leastSpan;
    this.#decimals = decimals;
    this.#title = title;
    const head = html("p.chart-head", {}, html("strong", { text: title }));
    for (const line of lines) {
      const now = html("span", { "data-line": line.name });
      this.#now.push(now);
      head.append(now);
    }
    this.element = html("div.chart", {}, head, this.#canvas);
    this.#sizes.observe(this.#canvas);
    document.addEventListener("up-theme", this.#onTheme);
  }

  end() {
    this.#sizes.disconnect();
    document.removeEventListener("up-theme", this.#onTheme);
    this.#rebuild();
  }

  show(columns) {
    const width = this.#width;
    if (width === 0) {
      return;
    }
    this.#plot ??= this.#make(width, columns);
    if (this.#plot.width !== width) {
      this.#plot.setSize({ width, height: HEIGHT_PX });
    }
    this.#plot.setData(columns);
    this.#lines.forEach((line, index) => {
      setText(this.#now[index], `${line.label} ${this.#text(columns[index + 1].at(-1))}`);
    });
    this.#canvas.setAttribute("aria-label", this.#summary(columns[1]));
  }

  #rebuild() {
    this.#plot?.destroy();
    this.#plot = null;
  }

  #make(width, columns) {
    const colour = (name) => coloursOf(this.element, [name])[0];
    const axis = {
      stroke: colour("--dim"),
      grid: { stroke: colour("--line"), width: 1 },
      ticks: { show: false },
      font: "11px system-ui, sans-serif",
    };
    const series = this.#lines.map((line) => ({
      stroke: colour(line.colour),
      width: 1.5,
      dash: line.dash,
      spanGaps: false,
      // A single frame between two silences is a point, otherwise it would be invisible.
      points: { show: (plot, index, from, to) => to - from < 4, size: 3 },
    }));
    return new this.#UPlot(
      {
        width,
        height: HEIGHT_PX,
        padding: [6, 14, 0, 0],
        legend: { show: false },
        cursor: { show: false },
        select: { show: false },
        scales: {
          x: { time: false, range: [-WINDOW_S, 0] },
          y: { range: (plot, least, most) => span(least, most, this.#leastSpan) },
        },
        axes: [
          { ...axis, size: 22, values: (plot, splits) => splits.map((each) => `${each} s`) },
          { ...axis, size: 44, space: 24 },
        ],
        series: [{}, ...series],
      },
      columns,
      this.#canvas,
    );
  }

  #text(value) {
    if (!Number.isFinite(value)) {
      return "--";
    }
    const words = this.#decimals === null ? plainNumber(value) : numberText(value, this.#decimals);
    return `${words}${this.#unit}`;
  }

  #summary(values) {
    const known = values.filter((each) => each !== null);
    if (known.length === 0) {
      return `${this.#title}: no data in the last minute`;
    }
    const [least, most] = [Math.min(...known), Math.max(...known)];
    return `${this.#title} of the last minute: now ${this.#text(values.at(-1))}, between ${this.#text(least)} and ${this.#text(most)}`;
  }
}

/** The range of an axis that shows all values; leastSpan: null: a fiftieth of the values. */
export function span(least, most, leastSpan) {
  if (least === null || most === null || !Number.isFinite(least) || !Number.isFinite(most)) {
    return [-(leastSpan ?? 1) / 2, (leastSpan ?? 1) / 2];
  }
  const narrowest = leastSpan ?? (Math.max(Math.abs(least), Math.abs(most)) / 50 || 1);
  const margin = (most - least) * 0.08;
  const missing = Math.max(0, narrowest - (most - least) - 2 * margin) / 2;
  return [least - margin - missing, most + margin + missing];
}

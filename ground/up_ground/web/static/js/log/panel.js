import { coloursOf, html, setText } from "../dom.js";
import { plainNumber, UNKNOWN } from "../state/format.js";
import { signalsOf } from "./signal.js";
import { timeText } from "./time_window.js";

const HEIGHT_PX = 150;
const SYNC = "log";
const LEVELS = { warning: "--warn", alarm: "--alarm" };

/** Digits of a value under the cursor that is not whole. */
const DIGITS = 5;

function shortNumber(value) {
  return plainNumber(Number.isInteger(value) ? value : Number(value.toPrecision(DIGITS)));
}

/** Curves over the time in view, with their values at the cursor above them. */
export class Panel {
  #UPlot;
  #flights;
  #window;
  #modes;
  #signals = [];
  #plot = null;
  #values = [];
  #head = html("p.log-head");
  #place = html("div.log-plot");
  #asked = 0;
  #onRemoved;

  /** onRemoved: the panel shall go. */
  constructor(UPlot, { flights, window, modes }, names, onRemoved) {
    this.#UPlot = UPlot;
    this.#flights = flights;
    this.#window = window;
    this.#modes = modes;
    this.#onRemoved = onRemoved;
    this.element = html("section.log-panel", { "aria-label": "Curves" }, this.#head, this.#place);
    names.forEach((name) => this.#take(name));
    this.#showHead();
    this.#place.addEventListener("wheel", (event) => this.#onWheel(event), { passive: false });
  }

  /** Fetch the visible part; an answer that comes after a newer question is dropped. */
  async load() {
    const asked = (this.#asked += 1);
    const { begin_s, end_s } = this.#window;
    const pixels = Math.max(100, Math.round(this.#place.clientWidth * (globalThis.devicePixelRatio || 1)));
    const found = await Promise.all(
      this.#signals.map((each) => each.flight.window(each.column, begin_s, end_s, Math.min(pixels, 4096))),
    );
    if (asked === this.#asked) {
      this.#signals.forEach((each, index) => {
        each.points = found[index];
      });
      this.draw();
    }
  }

  draw() {
    const width = this.#place.clientWidth;
    if (width === 0) {
      return;
    }
    const tables = this.#signals.map((each) => each.table);
    const data = tables.length ? this.#UPlot.join(tables) : [[]];
    if (this.#plot === null) {
      this.#plot = this.#make(width, data);
    } else {
      this.#plot.setSize({ width, height: HEIGHT_PX });
      this.#plot.setData(data);
    }
    this.element.dataset.points = data[0].length;
    this.showCursor();
  }

  /** Build it again: other colours, other signals. */
  rebuild() {
    this.#plot?.destroy();
    this.#plot = null;
    this.#showHead();
    this.draw();
  }

  showCursor() {
    const { cursor_s } = this.#window;
    this.#signals.forEach((each, index) => {
      const value = cursor_s === null ? null : each.at(cursor_s);
      setText(this.#values[index], value === null ? UNKNOWN : `${shortNumber(value)} ${each.unit}`);
    });
  }

  #showHead() {
    this.#values = this.#signals.map(() => html("b"));
    const input = html("input", {
      list: "log-signals",
      placeholder: "add a signal",
      "aria-label": "Add a signal to this panel",
      on: { change: () => this.#add(input) },
    });
    this.#head.replaceChildren(
      ...this.#signals.map((each, index) => this.#chip(each, index)),
      input,
      html("button.quiet", { type: "button", text: "Remove panel", on: { click: () => this.#onRemoved(this) } }),
    );
  }

  #chip(signal, index) {
    const line = html(signal.isOther ? "i.is-other" : "i");
    line.style.borderColor = `var(${signal.colour})`;
    const remove = () => {
      this.#signals = this.#signals.filter((each) => each !== signal);
      this.rebuild();
    };
    return html(
      "span.signal",
      { "data-signal": signal.name },
      line,
      html("span", { text: signal.isOther ? "2nd flight" : signal.name }),
      this.#values[index],
      html("button.quiet", { type: "button", text: "\u00d7", "aria-label": `Remove ${signal.name}`, on: { click: remove } }),
    );
  }

  #add(input) {
    const isKnown = this.#take(input.value);
    input.setAttribute("aria-invalid", String(!isKnown));
    if (isKnown) {
      this.rebuild();
      this.load();
    }
  }

  #take(name) {
    const colour = this.#signals.filter((each) => !each.isOther).length;
    const found = signalsOf(this.#flights, name, colour);
    this.#signals.push(...found);
    return found.length > 0;
  }

  #onWheel(event) {
    if (event.ctrlKey) {
      event.preventDefault();
      this.#window.zoom(event.deltaY > 0 ? 1.3 : 1 / 1.3);
    }
  }

  #make(width, data) {
    const [dim, line] = coloursOf(this.element, ["--dim", "--grid"]);
    const axis = {
      stroke: dim,
      grid: { stroke: line, width: 1 },
      ticks: { show: false },
      font: "11px system-ui, sans-serif",
      labelFont: "11px system-ui, sans-serif",
    };
    const units = [...new Set(this.#signals.map((each) => each.unit).filter(Boolean))];
    return new this.#UPlot(
      {
        width,
        height: HEIGHT_PX,
        padding: [6, 10, 0, 0],
        legend: { show: false },
        cursor: { sync: { key: SYNC }, drag: { x: true, y: false, setScale: false }, points: { show: false } },
        scales: { x: { time: false, range: () => [this.#window.begin_s, this.#window.end_s] }, y: {} },
        axes: [
          { ...axis, size: 22, values: (plot, splits, index, space, step) => splits.map((each) => timeText(each, step < 1 ? 2 : 0)) },
          { ...axis, size: 44, labelSize: 16, space: 26, label: units.join(", ") || " " },
        ],
        series: [
          {},
          ...this.#signals.map((each) => ({
            stroke: coloursOf(this.element, [each.colour])[0],
            width: 1.5,
            dash: each.isOther ? [6, 4] : undefined,
            // A single value between two silences is a point, otherwise it would be invisible.
            points: { show: (plot, number, from, to) => to - from < 30, size: 4 },
          })),
        ],
        hooks: {
          drawClear: [(plot) => this.#drawBehind(plot)],
          setSelect: [(plot) => this.#onSelected(plot)],
          setCursor: [(plot) => this.#onCursor(plot)],
          ready: [(plot) => plot.over.addEventListener("dblclick", () => this.#window.showAll())],
        },
      },
      data,
      this.#place,
    );
  }

  #onSelected(plot) {
    const { left, width } = plot.select;
    if (width > 4) {
      this.#window.set(plot.posToVal(left, "x"), plot.posToVal(left + width, "x"));
      plot.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
    }
  }

  #onCursor(plot) {
    const { left } = plot.cursor;
    // The other panels only follow the one under the pointer.
    if (plot.over.matches(":hover")) {
      this.#window.setCursor(left >= 0 ? plot.posToVal(left, "x") : null);
    }
  }

  /** The modes as bands, warnings and alarms as lines. */
  #drawBehind(plot) {
    const { left, top, width, height } = plot.bbox;
    const x = (time_s) => plot.valToPos(time_s, "x", true);
    plot.ctx.save();
    for (const { begin_s, end_s, colour } of this.#modes.visible()) {
      plot.ctx.fillStyle = colour;
      plot.ctx.globalAlpha = 0.55;
      plot.ctx.fillRect(x(begin_s), top, x(end_s) - x(begin_s), height);
    }
    plot.ctx.globalAlpha = 0.8;
    for (const { time_s, level } of this.#flights[0].events) {
      const at = x(time_s);
      if (level in LEVELS && at >= left && at <= left + width) {
        [plot.ctx.fillStyle] = coloursOf(this.element, [LEVELS[level]]);
        plot.ctx.fillRect(at, top, 1, height);
      }
    }
    plot.ctx.restore();
  }
}

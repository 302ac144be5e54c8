import { ChosenChart } from "./chosen_chart.js";
import { History } from "./history.js";
import { LineChart } from "./line_chart.js";
import { html, showMissing, styleSheet } from "../dom.js";
import { rollDemand_deg } from "../state/pilot_input.js";

const MISSING =
  "the charts need uPlot, which is not installed: run tools/web_assets (it needs npm) and reload this page.";
/** A minute moves by one pixel in about 0.2 s. */
const DRAW_S = 0.2;
const CHARTS = [
  {
    title: "Roll",
    unit: "°",
    decimals: 0,
    leastSpan: 40,
    lines: [
      { name: "roll", label: "is", colour: "--accent" },
      { name: "demand", label: "stick asks", colour: "--text", dash: [4, 4] },
    ],
  },
  { title: "Pitch", unit: "°", decimals: 0, leastSpan: 20, lines: [{ name: "pitch", label: "is", colour: "--accent" }] },
  { title: "Altitude", unit: " m", decimals: 0, leastSpan: 20, lines: [{ name: "altitude", label: "is", colour: "--accent" }] },
  { title: "Age of a frame", unit: " ms", decimals: 0, leastSpan: 50, lines: [{ name: "age", label: "when it came", colour: "--accent" }] },
];

/** The last minute of attitude, altitude and the link's delay. */
export function mount(place, store, connection) {
  const notice = html("p.why", { hidden: true });
  const row = html("div.charts", { id: "charts" });
  place.append(notice, row);
  const names = CHARTS.flatMap((chart) => chart.lines.map((line) => line.name));
  const history = new History(names);
  const now_s = () => store.flight_s;
  let charts = [];
  let chosen = null;
  let drawn_s = -Infinity;
  let aircraft = null;

  async function begin() {
    try {
      const { default: UPlot } = await import("../../vendor/uplot/uPlot.esm.js");
      await styleSheet("vendor/uplot/uPlot.min.css");
      charts = CHARTS.map((each) => new LineChart(UPlot, each));
      chosen = new ChosenChart(UPlot);
      row.append(...charts.map((each) => each.element), chosen.element);
    } catch (error) {
      console.warn(error);
      notice.textContent = MISSING;
      notice.hidden = false;
      showMissing("uplot", MISSING);
    }
  }

  function clear() {
    history.clear();
    chosen?.clear();
  }

  // The curves of two aircraft never are one line, nor those of the first the second's.
  function follow() {
    if (store.aircraft !== aircraft) {
      aircraft = store.aircraft;
      clear();
      drawn_s = -Infinity;
    }
  }

  // The store has processed the frame already: it gets every message first.
  function take(message) {
    if (message.aircraft !== store.aircraft) {
      return;
    }
    follow();
    const age_s = store.age_s(null) ?? 0;
    const live = (reading, path) => (store.freshness(reading) === "live" ? store.number(path) : null);
    history.add(store.frameAt_s, {
      roll: live("orientation", "orientation.roll"),
      demand: rollDemand_deg(store),
      pitch: live("orientation", "orientation.pitch"),
      altitude: live("altitude", "altitude"),
      age: age_s * 1000,
    });
    chosen?.take(store, store.frameAt_s);
  }

  connection.on("message", (message) => {
    if (message.type === "frame") {
      take(message);
    } else if (message.type === "track" && store.replay !== null) {
      // Sent after each jump: the samples that follow belong to another time.
      clear();
    }
  });
  begin();

  return {
    update() {
      follow();
      if (document.hidden || store.now_s - drawn_s < DRAW_S) {
        return;
      }
      drawn_s = store.now_s;
      const [times_s, ...values] = history.columns(now_s());
      let first = 0;
      CHARTS.forEach((chart, index) => {
        const own = values.slice(first, first + chart.lines.length);
        first += chart.lines.length;
        charts[index]?.show([times_s, ...own]);
      });
      chosen?.show(now_s());
    },
  };
}

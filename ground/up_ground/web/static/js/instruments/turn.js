import { drawing, html, setAttribute, short, svg } from "../dom.js";
import { freshnessOf, Readout } from "../readout.js";
import { numberText } from "../state/format.js";

const MAX_DEG_S = 60;
const LENGTH = 92;

/** Roll and pitch in figures, and between them how fast the nose turns. */
export function mount(element, store) {
  const degrees = (value) => `${numberText(value, 1, { sign: true })}°`;
  const perSecond = (value) => `${numberText(value, 0, { sign: true })}°/s`;
  const roll = figure("Roll");
  const pitch = figure("Pitch");
  const turn = figure("Turn");
  const bar = svg("rect", { x: 0, y: -5, width: 0, height: 6, class: "turn-bar" });
  const scale = svg("g", { class: "turn-scale" });
  for (let rate = -MAX_DEG_S; rate <= MAX_DEG_S; rate += 10) {
    const x = (rate / MAX_DEG_S) * LENGTH;
    const length = rate === 0 ? 12 : rate % 30 === 0 ? 9 : 5;
    scale.append(svg("path", { d: `M${short(x)} ${2 - length}V2` }));
  }
  const picture = drawing(
    "-100 -12 200 18",
    "Rate of turn, 60 degrees a second at the ends",
    scale,
    bar,
  );
  element.append(roll.box, html("div", { class: "turn-middle" }, picture, turn.box), pitch.box);
  const readouts = [
    new Readout(roll.value, "orientation.roll", degrees, null, "number"),
    new Readout(pitch.value, "orientation.pitch", degrees, null, "number"),
    new Readout(turn.value, "rates.yaw", perSecond, null, "number"),
  ];
  return {
    update() {
      for (const each of readouts) {
        each.update(store);
      }
      const rate = store.number("rates.yaw");
      const share = Math.max(-1, Math.min(1, (rate ?? 0) / MAX_DEG_S));
      setAttribute(bar, "x", short(Math.min(0, share * LENGTH)));
      setAttribute(bar, "width", short(Math.abs(share * LENGTH)));
      setAttribute(element, "data-freshness", freshnessOf(store, rate, "orientation"));
    },
  };
}

function figure(name) {
  const value = html("span", { class: "figure-value" });
  return {
    value,
    box: html("span", { class: "figure" }, html("span", { class: "figure-name" }, name), value),
  };
}

import { drawing, hatch, html, setAttribute, setText, svg } from "../dom.js";
import { share } from "./servos.js";
import { storageOf } from "../link/storage.js";
import { freshnessOf } from "../readout.js";

const REACH = 44;

/** Which channel moves which way: [across, along] of the left and of the right stick. */
const MODES = {
  1: [
    ["rudder", "elevator"],
    ["ailerons", "throttle"],
  ],
  2: [
    ["rudder", "throttle"],
    ["ailerons", "elevator"],
  ],
};

/** The two sticks as received, in mode 2 or 1. */
export function mount(element, store) {
  const memory = storageOf("localStorage");
  let mode = memory.get("stick-mode") === "1" ? 1 : 2;
  const button = html("button", { type: "button", id: "stick-mode", class: "quiet" });
  const gimbals = [gimbalOf("left"), gimbalOf("right")];
  const pair = html("div", { class: "gimbals" }, ...gimbals.map((each) => each.place));
  element.append(button, pair);
  const name = () => setText(button, `Mode ${mode}`);
  button.addEventListener("click", () => {
    mode = mode === 1 ? 2 : 1;
    memory.set("stick-mode", String(mode));
    name();
  });
  name();
  return {
    update() {
      gimbals.forEach((gimbal, side) => gimbal.show(store, MODES[mode][side]));
    },
  };
}

function gimbalOf(side) {
  const stick = svg("circle", { r: 7, class: "stick" });
  const name = html("p", { class: "stick-name" });
  const element = drawing(
    "-52 -52 104 104",
    `${side} stick`,
    svg("rect", { x: -50, y: -50, width: 100, height: 100, class: "gimbal" }),
    svg("path", { d: "M-50 0H50M0 -50V50", class: "gimbal-cross" }),
    stick,
    hatch(`stick-hatch-${side}`, { x: -50, y: -50, width: 100, height: 100 }),
  );
  return {
    place: html("div", {}, element, name),
    show(store, [x, y]) {
      const x_us = store.number(`rx.${x}`);
      const y_us = store.number(`rx.${y}`);
      const place = stickPlace(x_us, y_us, y);
      setAttribute(element, "data-freshness", freshnessOf(store, place, "rx"));
      setAttribute(element, "data-across", x);
      setAttribute(element, "data-along", y);
      setText(name, `${y}, ${x}`);
      if (place !== null) {
        setAttribute(stick, "transform", `translate(${place.x} ${place.y})`);
      }
    },
  };
}

/** A stick in its gimbal; nose up (above 1500 us) is a stick drawn down. along: the vertical channel. */
export function stickPlace(x_us, y_us, along) {
  if (x_us === null || y_us === null) {
    return null;
  }
  const down = along === "elevator" ? 1 : -1;
  return {
    x: (share(x_us) * REACH).toFixed(1),
    y: (down * share(y_us) * REACH).toFixed(1),
  };
}

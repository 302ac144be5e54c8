import { drawing, hatch, onCircle, setAttribute, setText, short, svg } from "../dom.js";
import { ageText } from "../state/format.js";
import { rollDemand_deg } from "../state/pilot_input.js";

export const VIEW = { x: -200, y: -140, width: 400, height: 280 };
const FAR = 1200;
const ROLL_RADIUS = 112;
/** Distance of one degree of pitch in the drawing. */
const UNITS_PER_DEG = 5;

/** The artificial horizon: attitude as one sees it from the seat. */
export function mount(element, store) {
  const ball = ballOf();
  const labels = [];
  const ladder = ladderOf(labels);
  const pointer = svg("path", { d: "M0 -110 L-7 -97 L7 -97 Z", class: "roll-pointer" });
  const rollGroup = svg("g", {}, pointer);
  const bug = svg("path", { d: "M0 -113 L-6 -123 H6 Z", class: "roll-bug", visibility: "hidden" });
  const note = svg("text", { x: -7, y: 62, class: "horizon-note" });
  const picture = drawing(
    `${VIEW.x} ${VIEW.y} ${VIEW.width} ${VIEW.height}`,
    "Artificial horizon",
    svg("rect", { ...VIEW, class: "horizon-empty" }),
    svg(
      "g",
      { transform: "translate(-7 0)" },
      clipOf(),
      svg("g", { class: "ball" }, ball, svg("g", { "clip-path": "url(#ladder-clip)" }, ladder)),
      rollScale(),
      bug,
      rollGroup,
    ),
    hatch("horizon-hatch", VIEW),
    aircraftSymbol(),
    note,
  );
  element.append(picture);
  return {
    update() {
      const roll_deg = store.number("orientation.roll");
      const pitch_deg = store.number("orientation.pitch");
      const isThere = roll_deg !== null && pitch_deg !== null;
      const freshness = isThere ? store.freshness("orientation") : "none";
      setAttribute(element, "data-freshness", freshness);
      setText(note, noteText(store, freshness));
      showBug(bug, freshness === "live" ? rollDemand_deg(store) : null);
      if (!isThere) {
        return;
      }
      const transform = ballTransform(roll_deg, pitch_deg);
      setAttribute(ball, "transform", transform);
      setAttribute(ladder, "transform", transform);
      setAttribute(rollGroup, "transform", `rotate(${short(-roll_deg)})`);
      for (const { x, y, text } of labels) {
        const isShown = isWhole(x, y, roll_deg, pitch_deg);
        setAttribute(text, "visibility", isShown ? "inherit" : "hidden");
      }
      setAttribute(ball, "data-roll", short(roll_deg));
      setAttribute(ball, "data-pitch", short(pitch_deg));
    },
  };
}

/** Where the pointer of the roll scale will stand at the demanded bank. */
function showBug(bug, demand_deg) {
  setAttribute(bug, "visibility", demand_deg === null ? "hidden" : "visible");
  if (demand_deg !== null) {
    setAttribute(bug, "transform", `rotate(${short(-demand_deg)})`);
  }
}

function noteText(store, freshness) {
  if (freshness === "none") {
    return store.aircraftState === "live" ? "no attitude" : "";
  }
  if (freshness === "stale" && !store.isSilent) {
    return `attitude is ${ageText(store.age_s("orientation"))} old`;
  }
  return "";
}

function ballOf() {
  return svg(
    "g",
    { id: "horizon-ball" },
    svg("rect", { x: -FAR, y: -FAR, width: 2 * FAR, height: FAR, class: "sky" }),
    svg("rect", { x: -FAR, y: 0, width: 2 * FAR, height: FAR, class: "earth" }),
    svg("path", { d: `M${-FAR} 0H${FAR}`, class: "horizon-line" }),
  );
}

function ladderOf(labels) {
  const ladder = svg("g", { class: "ladder", "aria-hidden": "true" });
  for (const { pitch_deg, halfWidth, label } of rungs()) {
    const y = -pitch_deg * UNITS_PER_DEG;
    const dash = pitch_deg < 0 ? "5 3" : "none";
    const d = `M${-halfWidth} ${y}H${halfWidth}`;
    ladder.append(svg("path", { d, "stroke-dasharray": dash }));
    for (const side of label === "" ? [] : [-1, 1]) {
      const x = side * (halfWidth + 13);
      const text = svg("text", { x, y: y + 4 }, label);
      labels.push({ x, y, text });
      ladder.append(text);
    }
  }
  for (const side of [-1, 1]) {
    const y = -side * 90 * UNITS_PER_DEG;
    ladder.append(svg("circle", { cx: 0, cy: y, r: 6, class: side > 0 ? "zenith" : "nadir" }));
  }
  return ladder;
}

function clipOf() {
  const shape = svg("path", { d: "M-90 -50A104 104 0 0 1 90 -50L116 -20V140H-116V-20Z" });
  return svg("defs", {}, svg("clipPath", { id: "ladder-clip" }, shape));
}

function rollScale() {
  const [x, y] = onCircle(60, ROLL_RADIUS);
  const group = svg("g", { class: "roll-scale" });
  group.append(svg("path", { d: `M${-x} ${y}A${ROLL_RADIUS} ${ROLL_RADIUS} 0 0 1 ${x} ${y}` }));
  for (const { roll_deg, length } of rollMarks()) {
    const from = onCircle(roll_deg, ROLL_RADIUS).map(short);
    const to = onCircle(roll_deg, ROLL_RADIUS + length).map(short);
    group.append(svg("path", { d: `M${from}L${to}` }));
  }
  group.append(svg("path", { d: "M0 -112 L-7 -125 L7 -125 Z", class: "roll-zero" }));
  return group;
}

function aircraftSymbol() {
  const wings = "M-90 0h38v9M76 0h-38v9";
  return svg(
    "g",
    { class: "symbol" },
    svg("path", { d: wings, class: "symbol-edge" }),
    svg("path", { d: wings, class: "symbol-line" }),
    svg("rect", { x: -10.5, y: -3.5, width: 7, height: 7, class: "symbol-dot" }),
  );
}

/** The rungs of the pitch ladder: long with a number each 10 degrees, short each 5, near the horizon 2.5. */
export function rungs() {
  const all = [];
  for (let pitch_deg = -90; pitch_deg <= 90; pitch_deg += 2.5) {
    const isNear = Math.abs(pitch_deg) < 20;
    if (pitch_deg === 0 || (pitch_deg % 5 !== 0 && !isNear)) {
      continue;
    }
    const isTen = pitch_deg % 10 === 0;
    const halfWidth = isTen ? 34 : pitch_deg % 5 === 0 ? 18 : 9;
    all.push({ pitch_deg, halfWidth, label: isTen ? String(Math.abs(pitch_deg)) : "" });
  }
  return all;
}

/** The transform of the ball: right wing down turns it to the left, nose up moves it down. */
export function ballTransform(roll_deg, pitch_deg) {
  const shift = Math.max(-90, Math.min(90, pitch_deg)) * UNITS_PER_DEG;
  return `rotate(${short(-roll_deg)}) translate(0 ${short(shift)})`;
}

/** Whether a rung's label, with its middle at x, y of the ladder, is whole within bank arc and picture. */
export function isWhole(x, y, roll_deg, pitch_deg) {
  const turn = (-roll_deg * Math.PI) / 180;
  const down = y + Math.max(-90, Math.min(90, pitch_deg)) * UNITS_PER_DEG;
  const across = x * Math.cos(turn) - down * Math.sin(turn);
  const along = x * Math.sin(turn) + down * Math.cos(turn);
  const isBelowArc = along > -40 || Math.hypot(across, along) < 95;
  return isBelowArc && Math.abs(across) < (along < -10 ? 88 : 107) && along < 133;
}

export function rollMarks() {
  const lengths = { 10: 6, 20: 6, 30: 12, 45: 7, 60: 12 };
  return Object.entries(lengths).flatMap(([roll_deg, length]) => [
    { roll_deg: -Number(roll_deg), length },
    { roll_deg: Number(roll_deg), length },
  ]);
}

import { coloursOf, html } from "../dom.js";
import { plainNumber } from "../state/format.js";
import { linesBetween, stepOf, stepText, windowOf } from "../state/earth.js";

const NAMES = ["up.altitude.change.altitude", "up.location.update.speed", "simulator.truth.altitude_m", "up.location.update.altitude"];
/** From the least to the greatest value; distinct on a dark and on a bright page, and without colour vision. */
const SCALE = [[42, 125, 225], [150, 95, 200], [224, 96, 126], [240, 150, 36]];

/** share: 0 to 1. */
function scaleColour(share) {
  const place = Math.min(Math.max(share, 0), 1) * (SCALE.length - 1);
  const [low, part] = [Math.min(Math.floor(place), SCALE.length - 2), place - Math.min(Math.floor(place), SCALE.length - 2)];
  const mixed = SCALE[low].map((each, index) => Math.round(each + (SCALE[low + 1][index] - each) * part));
  return `rgb(${mixed.join(" ")})`;
}

/** The tracks of all flights in metres from the first position, coloured by a signal of the first. */
export class TrackMap {
  #flights;
  #window;
  #canvas = html("canvas", { role: "img", "aria-label": "Map of the track, north is up" });
  #scale = html("canvas", { "aria-hidden": "true" });
  #least = html("span");
  #most = html("span");
  #tracks = [];
  #select;

  constructor(place, flights, window) {
    this.#flights = flights;
    this.#window = window;
    const names = flights[0].columns.map((each) => each.name);
    const options = names.map((name) => html("option", { value: name, text: name }));
    this.#select = html("select", { "aria-label": "The track's colour", on: { change: () => this.load() } }, ...options);
    this.#select.value = NAMES.find((name) => flights[0].find(name) >= 0) ?? names[0];
    place.append(this.#select, this.#canvas, html("p.log-scale", {}, this.#least, this.#scale, this.#most));
    window.on("span", () => this.draw());
    window.on("cursor", () => this.draw());
  }

  async load() {
    this.#tracks = await Promise.all(
      this.#flights.map((flight) => flight.track(Math.max(0, flight.find(this.#select.value)))),
    );
    this.draw();
  }

  draw() {
    const sharp = globalThis.devicePixelRatio || 1;
    const size = { width_px: this.#canvas.clientWidth, height_px: this.#canvas.clientHeight };
    const points = this.#tracks.flatMap(({ east_m, north_m }) => Array.from(east_m, (each, index) => ({ east_m: each, north_m: north_m[index] })));
    if (size.width_px === 0 || points.length === 0) {
      return;
    }
    this.#canvas.width = size.width_px * sharp;
    this.#canvas.height = size.height_px * sharp;
    const pen = this.#canvas.getContext("2d");
    pen.scale(sharp, sharp);
    const view = windowOf(points, size);
    const x = (east_m) => size.width_px / 2 + (east_m - view.east_m) / view.metresPerPixel;
    const y = (north_m) => size.height_px / 2 - (north_m - view.north_m) / view.metresPerPixel;
    this.#drawGrid(pen, view, size, x, y);
    const known = this.#tracks[0].values.filter(Number.isFinite);
    const [least, most] = [known.reduce((low, each) => Math.min(low, each), Infinity), known.reduce((high, each) => Math.max(high, each), -Infinity)];
    this.#tracks.forEach((track, number) => this.#drawTrack(pen, track, number, (value) => (value - least) / (most - least || 1), x, y));
    this.#drawScale(least, most);
  }

  #drawGrid(pen, view, size, x, y) {
    const [line, dim] = coloursOf(this.#canvas.parentElement, ["--grid", "--dim"]);
    const step_m = stepOf(view.metresPerPixel);
    const half = { east: (size.width_px / 2) * view.metresPerPixel, north: (size.height_px / 2) * view.metresPerPixel };
    pen.strokeStyle = line;
    pen.lineWidth = 1;
    pen.beginPath();
    for (const east_m of linesBetween(view.east_m - half.east, view.east_m + half.east, step_m)) {
      pen.moveTo(x(east_m), 0);
      pen.lineTo(x(east_m), size.height_px);
    }
    for (const north_m of linesBetween(view.north_m - half.north, view.north_m + half.north, step_m)) {
      pen.moveTo(0, y(north_m));
      pen.lineTo(size.width_px, y(north_m));
    }
    pen.stroke();
    pen.fillStyle = dim;
    pen.font = "11px system-ui, sans-serif";
    pen.fillText(`a square is ${stepText(step_m)} wide, north is up`, 6, size.height_px - 6);
  }

  #drawTrack(pen, { times_s, east_m, north_m, values }, number, share, x, y) {
    const { begin_s, end_s, cursor_s } = this.#window;
    const [text, ground, dim] = coloursOf(this.#canvas.parentElement, ["--text", "--ground", "--dim"]);
    let at = -1;
    pen.setLineDash(number > 0 ? [5, 4] : []);
    for (let index = 1; index < times_s.length; index += 1) {
      const isInView = times_s[index] >= begin_s && times_s[index - 1] <= end_s;
      pen.globalAlpha = isInView ? 1 : 0.25;
      pen.lineWidth = isInView ? 3 : 1.5;
      pen.strokeStyle = Number.isFinite(values[index]) ? scaleColour(share(values[index])) : dim;
      pen.beginPath();
      pen.moveTo(x(east_m[index - 1]), y(north_m[index - 1]));
      pen.lineTo(x(east_m[index]), y(north_m[index]));
      pen.stroke();
      at = cursor_s !== null && times_s[index] <= cursor_s ? index : at;
    }
    pen.globalAlpha = 1;
    pen.setLineDash([]);
    pen.strokeStyle = text;
    pen.fillStyle = ground;
    pen.lineWidth = 2;
    pen.strokeRect(x(0) - 4, y(0) - 4, 8, 8);
    if (at >= 0) {
      pen.beginPath();
      pen.arc(x(east_m[at]), y(north_m[at]), 6, 0, 2 * Math.PI);
      pen.fill();
      pen.stroke();
    }
  }

  #drawScale(least, most) {
    const { unit } = this.#flights[0].columns[Math.max(0, this.#flights[0].find(this.#select.value))];
    const isKnown = Number.isFinite(least);
    this.#least.textContent = isKnown ? `${plainNumber(Number(least.toPrecision(4)))} ${unit}` : "no value";
    this.#most.textContent = isKnown ? `${plainNumber(Number(most.toPrecision(4)))} ${unit}` : "";
    [this.#scale.width, this.#scale.height] = [64, 1];
    const pen = this.#scale.getContext("2d");
    for (let column = 0; column < 64; column += 1) {
      pen.fillStyle = scaleColour(column / 63);
      pen.fillRect(column, 0, 1, 1);
    }
  }
}

import { coloursOf, html } from "../dom.js";

const COLOURS = 6;

/** The number of the colour of each mode, in the order of appearance; failsafe has its own. */
function coloursByMode(bands) {
  const names = [...new Set(bands.map((each) => each.name))].filter((each) => each !== "failsafe");
  const colours = new Map(names.map((name, index) => [name, `--mode-${(index % COLOURS) + 1}`]));
  return colours.set("failsafe", "--mode-failsafe");
}

/** The modes of the first flight: a strip of names, and bands behind the curves. */
export class Modes {
  #bands;
  #colours;
  #window;
  #strip;

  constructor(strip, flight, window) {
    this.#bands = flight.bands;
    this.#colours = coloursByMode(flight.bands);
    this.#window = window;
    this.#strip = strip;
    window.on("span", () => this.#show());
    this.#show();
  }

  /** The bands in view, with their present colours: {begin_s, end_s, name, colour}. */
  visible() {
    const { begin_s, end_s } = this.#window;
    return this.#bands
      .filter((each) => each.end_s > begin_s && each.begin_s < end_s)
      .map((each) => ({
        name: each.name,
        begin_s: Math.max(each.begin_s, begin_s),
        end_s: Math.min(each.end_s, end_s),
        colour: coloursOf(this.#strip, [this.#colours.get(each.name)])[0],
      }));
  }

  #show() {
    const { begin_s, end_s } = this.#window;
    const share = (time_s) => `${((time_s - begin_s) / (end_s - begin_s)) * 100}%`;
    this.#strip.replaceChildren(
      ...this.visible().map((each) => {
        const band = html("span", { text: each.name, title: each.name });
        band.style.left = share(each.begin_s);
        band.style.right = `calc(100% - ${share(each.end_s)})`;
        band.style.background = `var(${this.#colours.get(each.name)})`;
        return band;
      }),
    );
  }
}

import { html, setText } from "../dom.js";
import { CommandSender } from "../panels/command_sender.js";
import { showReason } from "../panels/disabled_reason.js";
import { Field, numberBetween } from "../panels/field.js";
import { bearing_deg, distance_m, distanceText } from "../state/earth.js";
import { actingMode } from "../state/flight_mode.js";
import { headingText } from "../state/format.js";

const TARGET = "up.navigation.target";
const HOME = "up.home.set";
const MODE = "up.flight_mode.set";
const GUIDED = "GUIDED";
const MIN_HEIGHT_M = 30;

/** What a click on the map offers: to fly there, to set home there. */
export class MapActions {
  #store;
  #sender;
  #connection;
  #onChange;
  #title = html("p.map-place", { id: "map-place" });
  #why = html("p.why", { id: "map-why" });
  #note = html("p.note", { id: "map-note", role: "status" });
  #height;
  #home;
  #isAboveHome = true;
  #aircraft = null;

  /** @type {?{latitude: number, longitude: number}} the chosen place; null: none */
  place = null;

  /** onChange: the place was chosen or dropped. */
  constructor(store, connection, onChange) {
    this.#store = store;
    this.#connection = connection;
    this.#sender = new CommandSender(store, connection);
    this.#onChange = onChange;
    const input = { type: "number", inputmode: "decimal", min: 0, max: 5000, step: "any" };
    this.#height = new Field({
      id: "map-fly",
      label: "Height above home, m",
      button: "Fly here",
      input,
      read: numberBetween(0, 5000, "m"),
      send: (value) => this.#fly(value),
    });
    const home = { type: "button", id: "map-home-set", text: "Set home here", on: { click: () => this.#setHome() } };
    this.#home = html("button", home);
    const close = html("button", { type: "button", id: "map-close", text: "Close", on: { click: () => this.close() } });
    this.element = html(
      "div.map-actions",
      { role: "group", "aria-label": "A place on the map", hidden: true },
      this.#title,
      this.#why,
      this.#height.element,
      html("div.buttons", {}, this.#home, close),
      this.#note,
    );
    this.element.addEventListener("keydown", (event) => {
      if (event.key === "Escape") {
        this.close();
      }
    });
  }

  open(place) {
    if (this.#connection.welcome?.is_replay !== false) {
      return;
    }
    if (this.place === null) {
      this.#offerHeight();
    }
    this.place = place;
    this.#aircraft = this.#store.aircraft;
    setText(this.#note, "");
    this.#onChange();
  }

  // A typed number keeps its reference: the label does not change under it.
  #offerHeight() {
    const height_m = this.#store.number("navigation.height");
    const altitude_m = this.#store.number("navigation.altitude");
    this.#isAboveHome = this.#store.number("home.altitude") !== null;
    const offered_m = this.#isAboveHome ? Math.max(MIN_HEIGHT_M, height_m ?? 0) : altitude_m;
    setText(this.#height.label, `Height above ${this.#isAboveHome ? "home" : "sea level"}, m`);
    this.#height.clear();
    this.#height.input.value = offered_m === null ? "" : String(Math.round(offered_m));
  }

  close() {
    this.place = null;
    this.#onChange();
  }

  /** picture: of the map. */
  update({ aircraft, home }) {
    if (this.#store.aircraft !== this.#aircraft) {
      // Its height counts from the home of the aircraft selected before.
      this.place = null;
    }
    this.element.hidden = this.place === null;
    if (this.place === null) {
      return;
    }
    setText(this.#title, placeText(this.place, home, aircraft));
    showReason(this.#why, this.#sender.disabledReason(TARGET));
    this.#height.offer(this.#sender.disabledReason(TARGET) === null);
    this.#home.disabled = this.#sender.disabledReason(HOME) !== null;
  }

  async #fly(value) {
    const { latitude, longitude } = this.place;
    const { aircraft } = this.#store;
    const where = this.#isAboveHome ? { height: value } : { altitude: value };
    const reference = this.#isAboveHome ? "above home" : "above sea level";
    const question = {
      title: "Fly here?",
      text: `${this.#title.textContent}, ${value} m ${reference}. Now it flies ${actingMode(this.#store) ?? "an unknown mode"}. In ${GUIDED} it flies there and circles. The pilot's switch decides: leaving AUTO there takes over immediately.`,
      yes: "Fly here",
      no: "Leave it",
    };
    const answer = await this.#sender.send(TARGET, { latitude, longitude, ...where }, { note: this.#note, question, aircraft });
    // A target moves an aircraft that is in GUIDED already.
    if (answer?.outcome === "ack" && this.#store.text("flight_control.selected") !== GUIDED) {
      await this.#sender.send(MODE, { mode: GUIDED }, { note: this.#note, aircraft });
    }
  }

  async #setHome() {
    const isKept = this.#store.number("home.altitude") !== null;
    const altitude = isKept ? "Home keeps its altitude." : "Its altitude is the aircraft's present one.";
    const question = {
      title: "Set home here?",
      text: `${this.#title.textContent}. RETURN flies here from now on. ${altitude}`,
      yes: "Set home here",
      no: "Leave it",
    };
    const { latitude, longitude } = this.place;
    await this.#sender.send(HOME, { latitude, longitude }, { note: this.#note, question });
  }
}

/** As `50.10000, 8.60000: 340 m from home at 090°`. */
export function placeText(place, home, aircraft) {
  const words = `${place.latitude.toFixed(5)}, ${place.longitude.toFixed(5)}`;
  const from = home ?? aircraft;
  if (from === null) {
    return words;
  }
  const at = headingText(bearing_deg(from, place));
  return `${words}: ${distanceText(distance_m(from, place))} from ${home === null ? "the aircraft" : "home"} at ${at}°`;
}

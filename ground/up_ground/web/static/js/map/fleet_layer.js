import { html, setAttribute } from "../dom.js";
import { worstLevel } from "../state/alarm_level.js";
import { AircraftSymbol, positionOf } from "./picture.js";
import { Pace } from "../readout.js";

/** The aircraft that are not selected on Leaflet's map; a click or Enter selects one. */
export class FleetLayer {
  #L;
  #map;
  #store;
  #pace = new Pace();
  #markers = new Map();
  #selected = null;

  constructor(L, map, store) {
    this.#L = L;
    this.#map = map;
    this.#store = store;
  }

  /** The shown positions. */
  get places() {
    return [...this.#markers.values()].map(({ place }) => place);
  }

  show() {
    const { aircraft, names, fleet, now_s } = this.#store;
    const isTime = this.#pace.isTime(now_s);
    if (!isTime && aircraft === this.#selected) {
      return;
    }
    this.#selected = aircraft;
    this.#map.getContainer().classList.toggle("has-fleet", names.length > 1);
    for (const name of new Set([...names, ...this.#markers.keys()])) {
      const frame = name === aircraft || !names.includes(name) ? null : fleet.get(name);
      const position = frame === null ? null : positionOf(frame);
      if (position === null || position.aircraft === null) {
        this.#markers.get(name)?.marker.remove();
        this.#markers.delete(name);
      } else {
        this.#show(name, position, frame.alarms);
      }
    }
  }

  #show(name, { aircraft: place, heading_deg, freshness, age }, alarms) {
    const known = this.#markers.get(name) ?? this.#made(name, place);
    known.symbol.show(heading_deg, freshness, age);
    setAttribute(known.button, "data-level", worstLevel(alarms));
    if (known.place.latitude !== place.latitude || known.place.longitude !== place.longitude) {
      known.place = place;
      known.marker.setLatLng([place.latitude, place.longitude]);
    }
  }

  #made(name, place) {
    const symbol = new AircraftSymbol();
    const click = () => this.#store.watch(name);
    const label = html("span.fleet-label", { text: name });
    const button = html("button.fleet-marker", { type: "button", "data-aircraft": name, on: { click } }, symbol.element, label);
    // Elsewhere a click chooses a place.
    this.#L.DomEvent.disableClickPropagation(button);
    const icon = this.#L.divIcon({ html: button, className: "aircraft-marker", iconSize: [40, 40] });
    const marker = this.#L.marker([place.latitude, place.longitude], { icon, interactive: false, keyboard: false });
    const made = { marker: marker.addTo(this.#map), symbol, button, place };
    this.#markers.set(name, made);
    return made;
  }
}

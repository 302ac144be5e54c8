import { html } from "../dom.js";
import { distance_m } from "../state/earth.js";
import { changed, edgeOf, FENCE, inserted, itemAt, legsOf, MISSION } from "./plan.js";
import { moved, placeOfItem, radiusOf, withCorner, withoutCorner } from "./plan.js";

const SIZE_PX = 44;
const STEP_PX = 8;
const STEPS = { ArrowUp: [0, -1], ArrowDown: [0, 1], ArrowLeft: [-1, 0], ArrowRight: [1, 0] };
const MIN_RADIUS_M = 30;

/** The drawn mission and fence on Leaflet's map; while drawing, their points are moved with mouse, finger or keys. */
export class PlanLayer {
  #L;
  #map;
  #editor;
  #group;
  #lines;
  #markers = new Map();
  #shown = "";
  #flown = null;
  #home = null;
  #isDragged = false;

  constructor(L, map, editor) {
    this.#L = L;
    this.#map = map;
    this.#editor = editor;
    this.#lines = L.layerGroup().addTo(map);
    this.#group = L.layerGroup().addTo(map);
  }

  /** flown: number of the item that the aircraft flies; null: none. */
  show(home, flown) {
    const shown = `${this.#editor.version} ${home?.latitude} ${home?.longitude}`;
    if (shown !== this.#shown && !this.#isDragged) {
      this.#shown = shown;
      this.#home = home;
      this.#flown = null;
      this.#draw();
    }
    if (flown !== this.#flown) {
      this.#mark(this.#flown, false);
      this.#mark(flown, true);
      this.#flown = flown;
    }
  }

  #mark(number, isFlown) {
    this.#markers.get(`${MISSION} ${number - 1}`)?.getElement()?.classList.toggle("is-flown", isFlown);
  }

  #draw() {
    const focused = document.activeElement?.dataset?.point;
    // Two clicks in a row are two points.
    this.#map.doubleClickZoom[this.#editor.isDrawing ? "disable" : "enable"]();
    this.#group.clearLayers();
    this.#markers.clear();
    const { mission, fence } = this.#editor.drawn;
    this.#drawLines({ mission, fence });
    this.#fencePoints(fence);
    this.#missionPoints(mission);
    this.#markers.get(focused)?.getElement()?.focus();
  }

  /** Lines and circles alone, of a plan that is being dragged. */
  #drawLines({ mission, fence }) {
    const L = this.#L;
    this.#lines.clearLayers();
    const add = (layer) => layer.addTo(this.#lines);
    for (const border of fence) {
      const options = { className: `plan-border${border.inside === false ? " is-outside" : ""}`, interactive: false };
      if (border.corners) {
        add(L.polygon(border.corners, options));
      } else if (placeOfItem(border) !== null) {
        add(L.circle(latLng(border), { ...options, radius: border.radius }));
      }
    }
    for (const leg of legsOf(mission, this.#home)) {
      if (leg !== null) {
        add(L.polyline([latLng(leg.from), latLng(leg.to)], { className: "plan-case", interactive: false }));
        add(L.polyline([latLng(leg.from), latLng(leg.to)], { className: "plan-leg", interactive: false }));
      }
    }
    for (const item of mission.filter((each) => radiusOf(each) > 0 && placeOfItem(each) !== null)) {
      add(L.circle(latLng(item), { className: "plan-circle", radius: radiusOf(item), interactive: false }));
    }
  }

  #missionPoints(mission) {
    const isOpen = this.#editor.name === MISSION && this.#editor.isDrawing;
    const bad = this.#badOf(MISSION);
    if (isOpen) {
      legsOf(mission, this.#home).forEach((leg, index) => leg !== null && leg.start >= 0 && this.#insertPoint(leg, index));
    }
    mission.forEach((item, index) => {
      const place = placeOfItem(item);
      if (place !== null) {
        const classes = [`is-${item.kind}`, ...this.#states(MISSION, index, bad)];
        this.#point(place, String(index + 1), classes, `Item ${index + 1}, ${item.kind.replaceAll("_", " ")}`, {
          key: `${MISSION} ${index}`,
          index,
          isOpen,
          select: () => this.#select(MISSION, index),
          moved: (to) => moved(mission, index, to),
          remove: () => this.#editor.remove(index),
        });
      }
    });
  }

  #insertPoint({ from, to }, index) {
    const { mission } = this.#editor.drawn;
    const added = (place) => inserted(mission, index, itemAt(mission, index, "waypoint", place));
    this.#handle(from, to, `Insert before item ${index + 1}`, { key: `${MISSION} + ${index}`, index, moved: added });
  }

  // Clicked, the new point is in the middle; dragged, elsewhere.
  #handle(from, to, title, { key, index, moved: added }) {
    const select = (place) => this.#editor.put(added(place), index);
    this.#point(between(from, to), "+", ["is-handle"], title, { key, index, isOpen: true, select, moved: added });
  }

  #fencePoints(fence) {
    const bad = this.#badOf(FENCE);
    fence.forEach((border, index) => {
      const isOpen = this.#editor.name === FENCE && this.#editor.isDrawing;
      const classes = ["is-border", ...this.#states(FENCE, index, bad)];
      const select = () => this.#select(FENCE, index);
      const has = { isOpen, select, index };
      const title = `Border ${index + 1}`;
      if (border.corners) {
        border.corners.forEach(([latitude, longitude], corner) => {
          const remove = () => this.#editor.put(withoutCorner(fence, index, corner));
          const at = { latitude, longitude };
          const set = (to) => withCorner(fence, index, corner, to);
          this.#point(at, "", classes, `${title}, corner ${corner + 1}`, { ...has, key: `${FENCE} ${index} ${corner}`, moved: set, remove });
          if (isOpen && border.corners.length > 1) {
            this.#cornerHandle(fence, index, corner, at);
          }
        });
      } else if (placeOfItem(border) !== null) {
        const remove = () => this.#editor.remove(index);
        this.#point(border, "", classes, `${title}, middle`, { ...has, key: `${FENCE} ${index}`, moved: (to) => moved(fence, index, to), remove });
        if (isOpen) {
          const set = (to) => changed(fence, index, { radius: Math.max(MIN_RADIUS_M, Math.round(distance_m(border, to))) });
          this.#point(edgeOf(border), "", [...classes, "is-edge"], `${title}, radius`, { ...has, key: `${FENCE} ${index} r`, moved: set });
        }
      }
    });
  }

  #cornerHandle(fence, index, corner, at) {
    const { corners } = fence[index];
    const [latitude, longitude] = corners[(corner + 1) % corners.length];
    const added = (place) => withCorner(fence, index, corner + 1, place, true);
    const title = `Insert a corner after corner ${corner + 1}`;
    this.#handle(at, { latitude, longitude }, title, { key: `${FENCE} ${index} + ${corner}`, index, moved: added });
  }

  /** moved: the list with the point at a place; isOpen: it can be moved. */
  #point(place, text, classes, title, { key, isOpen, select, moved: listAt, remove, index }) {
    const L = this.#L;
    const dot = html("span.plan-dot", { text });
    const icon = L.divIcon({ html: dot, className: ["plan-point", ...classes].join(" "), iconSize: [SIZE_PX, SIZE_PX] });
    const marker = L.marker(latLng(place), { icon, title, alt: title, draggable: isOpen, keyboard: isOpen });
    const { name } = this.#editor;
    marker.on("click", () => select(place));
    marker.on("dragstart", () => (this.#isDragged = true));
    marker.on("drag", () => this.#drawLines({ ...this.#editor.drawn, [name]: listAt(placeOfMarker(marker)) }));
    marker.on("dragend", () => {
      this.#isDragged = false;
      this.#editor.put(listAt(placeOfMarker(marker)), index);
    });
    marker.addTo(this.#group);
    this.#markers.set(key, marker);
    const element = marker.getElement();
    element.dataset.point = key;
    element.setAttribute("aria-label", title);
    element.addEventListener("keydown", (event) => {
      const step = STEPS[event.key];
      if (step !== undefined && isOpen) {
        const at = this.#map.latLngToContainerPoint(marker.getLatLng()).add(L.point(step).multiplyBy(STEP_PX));
        const { lat, lng } = this.#map.containerPointToLatLng(at);
        this.#editor.put(listAt({ latitude: lat, longitude: lng }));
      } else if (event.key === "Delete" && isOpen) {
        remove?.();
      } else if (event.key === "Enter") {
        select(place);
      } else {
        return;
      }
      event.preventDefault();
      event.stopPropagation();
    });
  }

  #select(name, index) {
    this.#editor.show(name);
    this.#editor.select(index);
  }

  #badOf(name) {
    return this.#editor.name === name ? new Set(this.#editor.problems.map(({ item }) => item)) : new Set();
  }

  #states(name, index, bad) {
    const isSelected = this.#editor.name === name && this.#editor.selected === index;
    return [...(isSelected ? ["is-selected"] : []), ...(bad.has(index + 1) ? ["is-bad"] : [])];
  }
}

function between(from, to) {
  return { latitude: (from.latitude + to.latitude) / 2, longitude: (from.longitude + to.longitude) / 2 };
}

function latLng({ latitude, longitude }) {
  return [latitude, longitude];
}

function placeOfMarker(marker) {
  const { lat, lng } = marker.getLatLng().wrap();
  return { latitude: lat, longitude: lng };
}

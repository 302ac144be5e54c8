import { svg } from "../dom.js";
import { metreGrid } from "./metre_grid.js";
import { AircraftSymbol } from "./picture.js";
import { placesOf } from "../mission/plan.js";
import { Overlay } from "./overlay.js";
import { TrackLine } from "./track_line.js";

const INITIAL_ZOOM = 16;
const MAX_ZOOM = 21;
const MAX_TILE_ZOOM = 19;
/** Room for the buttons above, the text below and the labels beside aircraft, pixels. */
const MARGINS = { paddingTopLeft: [30, 76], paddingBottomRight: [60, 50] };

/** The map by Leaflet. It follows the aircraft, or it stays where the user put it. */
export class LeafletMap {
  #L;
  #map;
  #tiles = null;
  #grid = null;
  #symbol = new AircraftSymbol();
  #aircraft = null;
  #home = null;
  #overlay;
  #wayHome;
  #track;
  #hasView = false;
  #name = null;
  #onFree;

  isFollowing = true;

  /** L: Leaflet; onFree: the user moved the map; onTiles: map tiles became unavailable, or available; onChoose: a place was clicked. */
  constructor(L, place, { tiles, onFree, onTiles, onChoose }) {
    this.#L = L;
    this.#onFree = onFree;
    const isCalm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.#map = L.map(place, {
      zoomAnimation: !isCalm,
      fadeAnimation: !isCalm,
      zoomControl: false,
      attributionControl: tiles !== null,
      maxZoom: MAX_ZOOM,
      minZoom: 2,
      worldCopyJump: true,
      zoomSnap: 0.5,
    });
    this.#map.attributionControl?.setPrefix(false);
    L.control.scale({ imperial: false, position: "bottomleft" }).addTo(this.#map);
    if (tiles !== null) {
      const options = { maxZoom: MAX_ZOOM, maxNativeZoom: MAX_TILE_ZOOM, attribution: escaped(tiles.attribution) };
      this.#tiles = L.tileLayer(tiles.url, options).addTo(this.#map);
      this.#tiles.on("tileload", () => onTiles(true));
      this.#tiles.on("tileerror", () => {
        this.#useGrid();
        onTiles(false);
      });
    }
    place.classList.toggle("has-tiles", tiles !== null);
    this.#wayHome = L.polyline([], { className: "way-home", interactive: false });
    this.#track = new TrackLine(L, this.#map, tiles !== null);
    this.#overlay = new Overlay(L, this.#map);
    this.#map.on("click", ({ latlng }) => onChoose(placeOfLatLng(latlng)));
    this.#map.on("dragstart", () => this.free());
    this.#map.getContainer().addEventListener("keydown", (event) => {
      if (event.key.startsWith("Arrow")) {
        this.free();
      }
    });
    document.addEventListener("up-theme", () => this.#grid?.redraw());
    new ResizeObserver(() => this.#map.invalidateSize({ pan: false })).observe(place);
    this.follow();
  }

  /** Leaflet's own map, for other layers. */
  get leaflet() {
    return this.#map;
  }

  /** Keep the aircraft in the middle from now on. */
  follow() {
    this.isFollowing = true;
    // Zooming around the pointer would move the aircraft out of the middle.
    this.#zoomAround("center");
    if (this.#aircraft !== null) {
      this.#map.panTo(this.#aircraft.getLatLng(), { animate: false });
    }
  }

  /** Leave the map where it is from now on. */
  free() {
    if (this.isFollowing) {
      this.isFollowing = false;
      this.#zoomAround(true);
      this.#onFree();
    }
  }

  /** The place in the middle; null: nothing is shown yet. */
  get middle() {
    return this.#hasView ? placeOfLatLng(this.#map.getCenter()) : null;
  }

  /** by: levels closer; negative: farther. */
  zoom(by) {
    if (this.#hasView) {
      this.#map.setZoom(this.#map.getZoom() + by);
    }
  }

  /** The track, and these places. */
  showAll(places) {
    const bounds = this.#track.bounds() ?? this.#L.latLngBounds([]);
    places.forEach((each) => bounds.extend(latLng(each)));
    if (bounds.isValid()) {
      this.free();
      this.#map.fitBounds(bounds, { ...MARGINS, maxZoom: 18 });
    }
  }

  show(picture) {
    const { aircraft, home } = picture;
    if (picture.name !== this.#name) {
      this.#name = picture.name;
      this.#clear(picture);
    }
    if (!this.#hasView) {
      const first = aircraft ?? home ?? placesOf(picture.plans)[0] ?? null;
      if (first === null) {
        return;
      }
      this.#map.setView([first.latitude, first.longitude], INITIAL_ZOOM);
      this.#hasView = true;
    }
    this.#showGround(home ?? aircraft, home !== null);
    this.#showHome(home);
    this.#overlay.show(picture);
    this.#showAircraft(picture);
    const ends = home === null || aircraft === null ? [] : [latLng(home), latLng(aircraft)];
    this.#wayHome.setLatLngs(ends).addTo(this.#map);
    this.#track.show(picture.track);
  }

  // Another aircraft flies elsewhere: reset everything, including the origin of the grid.
  #clear(picture) {
    this.#showAircraft({ ...picture, aircraft: null });
    this.#showHome(null);
    this.#overlay.show({});
    this.#wayHome.setLatLngs([]);
    this.#track.show({ points: [], version: -1 });
    this.#grid?.remove();
    this.#grid = null;
    if (this.#hasView) {
      this.#hasView = false;
      this.follow();
    }
  }

  #showAircraft({ aircraft, heading_deg, freshness, age }) {
    if (aircraft === null) {
      this.#aircraft?.remove();
      this.#aircraft = null;
      return;
    }
    if (this.#aircraft === null) {
      const icon = this.#L.divIcon({
        html: this.#symbol.element,
        className: "aircraft-marker",
        iconSize: [40, 40],
      });
      const options = { icon, interactive: false, keyboard: false, zIndexOffset: 1000 };
      this.#aircraft = this.#L.marker(latLng(aircraft), options).addTo(this.#map);
    }
    this.#symbol.show(heading_deg, freshness, age);
    this.#aircraft.setLatLng(latLng(aircraft));
    if (this.isFollowing) {
      this.#map.panTo(latLng(aircraft), { animate: false });
    }
  }

  #showHome(home) {
    if (home === null) {
      this.#home?.remove();
      this.#home = null;
      return;
    }
    if (this.#home === null) {
      const icon = this.#L.divIcon({ html: homeSymbol(), className: "home-marker", iconSize: [24, 24] });
      this.#home = this.#L.marker(latLng(home), { icon, interactive: false, keyboard: false });
      this.#home.addTo(this.#map);
    }
    this.#home.setLatLng(latLng(home));
  }

  // The grid counts its metres from home, or from where the aircraft was first seen.
  #showGround(place, isHome) {
    if (place === null) {
      return;
    }
    if (this.#grid === null && this.#tiles === null) {
      this.#useGrid(place);
    }
    const origin = this.#grid?.origin;
    const isElsewhere =
      origin && (origin.latitude !== place.latitude || origin.longitude !== place.longitude);
    if (isHome && isElsewhere) {
      this.#grid.setOrigin(place);
    }
  }

  #useGrid(place = null) {
    const origin = place ?? this.middle;
    if (this.#grid === null && origin !== null) {
      this.#grid = metreGrid(this.#L, origin).addTo(this.#map);
      this.#grid.bringToBack();
    }
  }

  #zoomAround(what) {
    for (const way of ["scrollWheelZoom", "touchZoom", "doubleClickZoom"]) {
      this.#map.options[way] = what;
    }
  }
}

function latLng({ latitude, longitude }) {
  return [latitude, longitude];
}

function placeOfLatLng(latLng) {
  const { lat, lng } = latLng.wrap();
  return { latitude: lat, longitude: lng };
}

function homeSymbol() {
  return svg(
    "svg.home-symbol",
    { viewBox: "-12 -12 24 24", width: 24, height: 24, "aria-hidden": "true" },
    svg("path", { d: "M0 -9 L9 0 H6 V8 H-6 V0 H-9 Z" }),
  );
}

// Leaflet writes an attribution as HTML.
function escaped(text) {
  const plain = document.createElement("span");
  plain.textContent = String(text ?? "");
  return plain.innerHTML;
}

import { html, showMissing, setAttribute, setText, styleSheet, svg } from "../dom.js";
import { homeText, pictureOf } from "./picture.js";
import { PlainMap } from "./plain_map.js";

/** The wind beside the map, if the aircraft reports it: an arrow along the wind, and text. */
export class Wind {
  #arrow = svg("path", { d: "M0 -7 V7 M-4 3 L0 7 L4 3" });
  #words = html("span");

  constructor() {
    const arrow = svg("svg", { viewBox: "-8 -8 16 16", width: 16, height: 16 }, this.#arrow);
    setAttribute(arrow, "aria-hidden", "true");
    this.element = html("p.map-wind", { hidden: true }, arrow, this.#words);
  }

  show(store) {
    const from_deg = store.number("wind.from");
    const speed_m_s = store.number("wind.speed");
    this.element.hidden =
      from_deg === null || speed_m_s === null || store.freshness(null) !== "live";
    if (!this.element.hidden) {
      setAttribute(this.#arrow, "transform", `rotate(${from_deg.toFixed(0)})`);
      setText(this.#words, `wind ${speed_m_s.toFixed(1)} m/s from ${from_deg.toFixed(0)}°`);
    }
  }
}

const MISSING =
  "Leaflet is not installed, so the map is a plain one: run tools/web_assets (it needs npm) and reload this page.";

const NO_TILES = "Map tiles are unavailable: the map shows a grid of metres.";

/** The map: Leaflet where it is installed, a plain one of our own elsewhere. */
export function mount(place, store, connection) {
  const canvas = html("div.map-canvas", { role: "region", "aria-label": "Map; arrow keys move it" });
  const follow = button("Follow", "Follow: keep the aircraft in the middle", () => setFollow(!map?.isFollowing));
  follow.id = "map-follow";
  const closer = button("+", "Closer", () => map?.zoom(1));
  const farther = button("−", "Farther", () => map?.zoom(-1));
  const whole = button("All", "All of the track", () => map?.showAll());
  const tools = html("div.map-tools", {}, follow, whole, closer, farther);
  const words = html("p.map-words", { id: "map-home" });
  const wind = new Wind();
  const notice = html("p.map-notice", { id: "map-notice", hidden: true });
  place.append(canvas, tools, html("div.map-foot", {}, words, wind.element), notice);
  let map = null;
  place.addEventListener("keydown", onKey);

  function button(text, label, click) {
    return html("button", { type: "button", text, title: label, "aria-label": label, on: { click } });
  }

  function notify(text) {
    setText(notice, text);
    notice.hidden = text === "";
  }

  function setFollow(isWanted) {
    if (isWanted) {
      map?.follow();
    } else {
      map?.free?.();
    }
    showFollow();
  }

  function showFollow() {
    setAttribute(follow, "aria-pressed", String(map?.isFollowing ?? false));
    const isPlain = map instanceof PlainMap;
    [follow, closer, farther, whole].forEach((each) => (each.hidden = isPlain));
  }

  function onKey(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) {
      return;
    }
    const keys = {
      "+": () => map?.zoom(1),
      "=": () => map?.zoom(1),
      "-": () => map?.zoom(-1),
      f: () => setFollow(!map?.isFollowing),
    };
    // Leaflet itself handles + and - while it has the focus.
    const isLeaflets = event.target === canvas && event.key !== "f";
    if (Object.hasOwn(keys, event.key) && !isLeaflets) {
      keys[event.key]();
    }
  }

  async function begin() {
    try {
      const { LeafletMap } = await import("./leaflet_map.js");
      const L = await import("../../vendor/leaflet/leaflet-src.esm.js");
      await styleSheet("vendor/leaflet/leaflet.css");
      const tiles = connection.welcome?.tiles ?? null;
      const onTiles = (areThere) => notify(areThere ? "" : NO_TILES);
      map = new LeafletMap(L, canvas, { tiles, onFree: showFollow, onTiles });
    } catch (error) {
      console.warn(error);
      map = new PlainMap(canvas);
      notify(MISSING);
      showMissing("leaflet", MISSING);
    }
    showFollow();
  }

  // The welcome message names the available tiles.
  if (connection.isOpen) {
    begin();
  } else {
    const off = connection.on("open", () => {
      off();
      begin();
    });
  }

  return {
    update() {
      const picture = pictureOf(store);
      map?.show(picture);
      const isShown = map !== null && picture.aircraft !== null;
      setAttribute(place, "data-latitude", isShown ? String(picture.aircraft.latitude) : "");
      setAttribute(place, "data-longitude", isShown ? String(picture.aircraft.longitude) : "");
      setAttribute(place, "data-heading", isShown ? String(picture.heading_deg ?? "") : "");
      setAttribute(words, "data-freshness", picture.freshness);
      setText(words, homeText(picture));
      wind.show(store);
    },
  };
}

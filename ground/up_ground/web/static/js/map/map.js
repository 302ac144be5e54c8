import { element } from "../panels/element.js";
import { sayMissing, styleSheet } from "../panels/vendor.js";
import { setAttribute, setText } from "../readout.js";
import { homeWords, pictureOf } from "./picture.js";
import { PlainMap } from "./plain_map.js";
import { Wind } from "./wind.js";

const MISSING =
  "The map is a plain one, as Leaflet is not installed: run tools/web_assets (it needs npm) and load this page again.";

const NO_TILES = "No pictures of the ground come: a grid of metres stands in for them.";

/** The map: Leaflet where it is installed, a plain one of our own elsewhere. */
export function mount(place, store, connection) {
  const canvas = element("div.map-canvas", { role: "region", "aria-label": "Map; arrow keys move it" });
  const follow = button("Follow", "Follow: keep the aircraft in the middle", () => setFollow(!map?.isFollowing));
  follow.id = "map-follow";
  const closer = button("+", "Closer", () => map?.zoom(1));
  const farther = button("−", "Farther", () => map?.zoom(-1));
  const whole = button("All", "All of the track", () => map?.showAll());
  const tools = element("div.map-tools", {}, follow, whole, closer, farther);
  const words = element("p.map-words", { id: "map-home" });
  const wind = new Wind();
  const notice = element("p.map-notice", { id: "map-notice", hidden: true });
  place.append(canvas, tools, element("div.map-foot", {}, words, wind.element), notice);
  let map = null;
  place.addEventListener("keydown", onKey);

  function button(text, label, click) {
    return element("button", { type: "button", text, title: label, "aria-label": label, on: { click } });
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
      sayMissing(MISSING);
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
      setText(words, homeWords(picture));
      wind.show(store);
    },
  };
}

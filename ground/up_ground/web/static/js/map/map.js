import { html, showMissing, setAttribute, setText, styleSheet } from "../dom.js";
import { DrawingBar } from "../mission/drawing_bar.js";
import { editorOf } from "../mission/editor.js";
import { MISSION, placesOf } from "../mission/plan.js";
import { PlanLayer } from "../mission/plan_layer.js";
import { usedState } from "../mission/progress.js";
import { FleetLayer } from "./fleet_layer.js";
import { MapActions } from "./map_actions.js";
import { limitOf } from "./overlay.js";
import { homeText, pictureOf } from "./picture.js";
import { PlainMap } from "./plain_map.js";
import { Wind } from "./wind.js";

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
  const whole = button("All", "All aircraft, the track, the mission and the fence", () => showAll());
  const tools = html("div.map-tools", {}, follow, whole, closer, farther);
  const words = html("p.map-words", { id: "map-home" });
  const wind = new Wind();
  const notice = html("p.map-notice", { id: "map-notice", hidden: true });
  const actions = new MapActions(store, connection, show);
  const editor = editorOf(store);
  const bar = new DrawingBar(editor);
  tools.prepend(bar.toggle);
  place.append(canvas, tools, html("div.map-foot", {}, words), wind.element, notice, actions.element, bar.element);
  let map = null;
  let plans = null;
  let fleet = null;
  editor.middle = () => map?.middle ?? null;
  editor.subscribe(show);
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

  function showAll() {
    const others = fleet?.places ?? [];
    map?.showAll([...placesOf(editor.drawn), ...limitOf(pictureOf(store)), ...others]);
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
      Enter: () => choose(map?.middle ?? null),
    };
    // Leaflet itself handles + and - while it has the focus.
    const isLeaflets = event.target === canvas && ["+", "=", "-"].includes(event.key);
    const isTyped = event.target !== canvas && (event.key === "Enter" || event.target.matches("input, select"));
    if (Object.hasOwn(keys, event.key) && !isLeaflets && !isTyped) {
      keys[event.key]();
    }
  }

  function choose(chosen) {
    if (chosen !== null && editor.isDrawing && plans !== null) {
      editor.add(chosen);
    } else if (chosen !== null) {
      actions.open(chosen);
    }
  }

  function show() {
    if (editor.isDrawing && plans !== null) {
      actions.place = null;
      // A map that follows would move under the pointer.
      setFollow(false);
    }
    const picture = { ...pictureOf(store), chosen: actions.place, plans: editor.drawn };
    map?.show(picture);
    fleet?.show();
    if (map?.middle) {
      const isUsed = usedState(editor, store, MISSION) === "same";
      plans?.show(picture.home, isUsed ? store.number("mission.item") : null);
    }
    bar.update(plans !== null);
    actions.update(picture);
    return picture;
  }

  async function begin() {
    try {
      const { LeafletMap } = await import("./leaflet_map.js");
      const L = await import("../../vendor/leaflet/leaflet-src.esm.js");
      await styleSheet("vendor/leaflet/leaflet.css");
      const tiles = connection.welcome?.tiles ?? null;
      const onTiles = (areThere) => notify(areThere ? "" : NO_TILES);
      map = new LeafletMap(L, canvas, { tiles, onFree: showFollow, onTiles, onChoose: choose });
      plans = new PlanLayer(L, map.leaflet, editor);
      fleet = new FleetLayer(L, map.leaflet, store);
    } catch (error) {
      console.warn(error);
      map = new PlainMap(canvas, choose);
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
      const picture = show();
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

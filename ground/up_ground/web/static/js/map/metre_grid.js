import { coloursOf } from "../dom.js";
import { linesBetween, offsetOf, placeAt, stepOf, stepText } from "../state/earth.js";

const METRES_AROUND = 40075016.7;

/** A layer of Leaflet (L) for a field without a network: squares of round metres around a place. */
export function metreGrid(L, origin) {
  const Grid = L.GridLayer.extend({
    origin,

    setOrigin(place) {
      this.origin = place;
      this.redraw();
    },

    step_m(zoom) {
      const around_px = 256 * 2 ** zoom;
      const latitude = (this.origin.latitude * Math.PI) / 180;
      return stepOf((METRES_AROUND * Math.cos(latitude)) / around_px);
    },

    createTile(coords) {
      const size = this.getTileSize();
      const sharp = Math.min(2, globalThis.devicePixelRatio || 1);
      const tile = L.DomUtil.create("canvas", "metre-grid");
      tile.width = size.x * sharp;
      tile.height = size.y * sharp;
      const pen = tile.getContext("2d");
      pen.scale(sharp, sharp);
      this.draw(pen, coords, size);
      return tile;
    },

    draw(pen, coords, size) {
      const corner = coords.scaleBy(size);
      const place = (point) => {
        const { lat, lng } = this._map.unproject(point, coords.z);
        return offsetOf(this.origin, { latitude: lat, longitude: lng });
      };
      const pixel = (offset) => {
        const { latitude, longitude } = placeAt(this.origin, offset);
        return this._map.project([latitude, longitude], coords.z).subtract(corner);
      };
      const [northWest, southEast] = [place(corner), place(corner.add(size))];
      const step = this.step_m(coords.z);
      const [lines, axis, text] = coloursOf(document.documentElement, ["--line", "--line-strong", "--dim"]);
      const ink = { line: lines, axis, text };
      pen.font = "11px system-ui, sans-serif";
      for (const east_m of linesBetween(northWest.east_m, southEast.east_m, step)) {
        const x = Math.round(pixel({ east_m, north_m: 0 }).x) + 0.5;
        line(pen, ink, [x, 0, x, size.y], east_m === 0);
      }
      for (const north_m of linesBetween(southEast.north_m, northWest.north_m, step)) {
        const y = Math.round(pixel({ east_m: 0, north_m }).y) + 0.5;
        line(pen, ink, [0, y, size.x, y], north_m === 0);
      }
      this.label(pen, ink, { northWest, southEast, step, pixel, size });
    },

    // Distances stand along the two lines through the origin only.
    label(pen, ink, { northWest, southEast, step, pixel, size }) {
      pen.fillStyle = ink.text;
      const axis = pixel({ east_m: 0, north_m: 0 });
      // A text may begin in the tile beside: each tile draws its part of it.
      const [west_m, south_m] = [northWest.east_m - step, southEast.north_m - step];
      if (axis.y >= -14 && axis.y < size.y) {
        for (const east_m of linesBetween(west_m, southEast.east_m, step)) {
          if (east_m !== 0) {
            const { x } = pixel({ east_m, north_m: 0 });
            pen.fillText(`${stepText(Math.abs(east_m))} ${east_m > 0 ? "E" : "W"}`, x + 3, axis.y + 12);
          }
        }
      }
      if (axis.x >= -60 && axis.x < size.x) {
        for (const north_m of linesBetween(south_m, northWest.north_m, step)) {
          if (north_m !== 0) {
            const { y } = pixel({ east_m: 0, north_m });
            pen.fillText(`${stepText(Math.abs(north_m))} ${north_m > 0 ? "N" : "S"}`, axis.x + 3, y - 3);
          }
        }
      }
    },
  });
  return new Grid({ className: "metre-grid-layer", updateWhenZooming: false });
}

function line(pen, ink, [x0, y0, x1, y1], isAxis) {
  pen.strokeStyle = isAxis ? ink.axis : ink.line;
  pen.lineWidth = 1;
  pen.beginPath();
  pen.moveTo(x0, y0);
  pen.lineTo(x1, y1);
  pen.stroke();
}

const NAMESPACE = "http://www.w3.org/2000/svg";

/**
 * Makes an element of a drawing.
 * @param {string} tag
 * @param {Record<string, string|number>} [attributes]
 * @param {...(Node|string)} children
 * @returns {SVGElement}
 */
export function svg(tag, attributes = {}, ...children) {
  const element = document.createElementNS(NAMESPACE, tag);
  for (const [name, value] of Object.entries(attributes)) {
    element.setAttribute(name, String(value));
  }
  element.append(...children);
  return element;
}

/**
 * A drawing that fills its place; its figures are read, scales within are hidden from readers.
 * @param {string} viewBox
 * @param {string} label
 * @param {...Node} children
 * @returns {SVGElement}
 */
export function drawing(viewBox, label, ...children) {
  return svg("svg", { viewBox, role: "group", "aria-label": label }, ...children);
}

/**
 * Hatch over stale values; shown by the style sheet.
 * @param {string} id of the pattern, one for the whole page
 * @param {{x: number, y: number, width: number, height: number}} place
 * @returns {SVGElement}
 */
export function hatch(id, place) {
  const line = svg("path", { d: "M-2 10 10 -2M-2 20 20 -2M8 20 20 8", class: "hatch-line" });
  const box = { id, width: 18, height: 18, patternUnits: "userSpaceOnUse" };
  return svg(
    "g",
    { class: "hatch" },
    svg("defs", {}, svg("pattern", box, line)),
    svg("rect", { ...place, fill: `url(#${id})` }),
  );
}

/**
 * @param {number} value
 * @returns {string} for a transform: short, and never in the form 1e-7
 */
export function short(value) {
  return value.toFixed(2);
}

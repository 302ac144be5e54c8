const NAMESPACE = "http://www.w3.org/2000/svg";

/** Makes an element of a drawing. */
export function svg(tag, attributes = {}, ...children) {
  const element = document.createElementNS(NAMESPACE, tag);
  for (const [name, value] of Object.entries(attributes)) {
    element.setAttribute(name, String(value));
  }
  element.append(...children);
  return element;
}

/** A drawing that fills its place; its figures are read, scales within are hidden from readers. */
export function drawing(viewBox, label, ...children) {
  return svg("svg", { viewBox, role: "group", "aria-label": label }, ...children);
}

/**
 * Hatch over stale values; shown by the style sheet. id: of the pattern, one for the whole page.
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

/** For a transform: short, and never in the form 1e-7. */
export function short(value) {
  return value.toFixed(2);
}

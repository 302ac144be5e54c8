const SVG = "http://www.w3.org/2000/svg";

/** Sets the text of an element without children, only when it changed. */
export function setText(element, text) {
  if (element.shownText !== text) {
    // An existing text changes in place: a new node would compute styles and the layout again.
    if (text !== "" && element.firstChild?.nodeName === "#text" && element.childNodes.length === 1) {
      element.firstChild.data = text;
    } else {
      element.textContent = text;
    }
    element.shownText = text;
  }
}

/** Sets an attribute, only when it changed. */
export function setAttribute(element, name, value) {
  const shown = (element.shownAttributes ??= {});
  if (shown[name] !== value) {
    element.setAttribute(name, value);
    shown[name] = value;
  }
}

/**
 * An HTML element; texts go through textContent alone. tag: with classes behind dots, as `p.note`;
 * has: attributes; `text` is its text, `on` is {event: call}; false and null: not set.
 */
export function html(tag, has = {}, ...children) {
  const [name, ...classes] = tag.split(".");
  return filled(document.createElement(name), classes, has, children);
}

/** An element of a drawing; parameters as for html(). */
export function svg(tag, has = {}, ...children) {
  const [name, ...classes] = tag.split(".");
  return filled(document.createElementNS(SVG, name), classes, has, children);
}

function filled(node, classes, has, children) {
  node.classList.add(...classes);
  for (const [name, value] of Object.entries(has)) {
    if (name === "text") {
      node.textContent = value;
    } else if (name === "on") {
      for (const [event, call] of Object.entries(value)) {
        node.addEventListener(event, call);
      }
    } else if (value !== false && value !== null && value !== undefined) {
      node.setAttribute(name, value === true ? "" : value);
    }
  }
  node.append(...children);
  return node;
}

/** A drawing that fills its place; its figures are read, scales within are hidden from readers. */
export function drawing(viewBox, label, ...children) {
  return svg("svg", { viewBox, role: "group", "aria-label": label }, ...children);
}

/** Hatch over stale values, shown by the style sheet. id: of the pattern, one for the whole page. */
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

/** A number for a transform: short, and never in the form 1e-7. */
export function short(value) {
  return value.toFixed(2);
}

/** A point on a circle around the middle, clockwise from above. */
export function onCircle(angle_deg, radius) {
  const angle = (angle_deg * Math.PI) / 180;
  return [radius * Math.sin(angle), -radius * Math.cos(angle)];
}

/** Shows why the content of an input is wrong; problem: empty: it is right. */
export function showProblem(input, note, problem) {
  input.setAttribute("aria-invalid", String(problem !== ""));
  note.setAttribute("data-look", problem ? "bad" : "plain");
  setText(note, problem);
}

/** The present colours of the style sheet's variables: a canvas does not support light-dark(). */
export function coloursOf(place, names) {
  const probe = html("span");
  place.append(probe);
  const colours = names.map((name) => {
    probe.style.setProperty("color", `var(${name})`);
    return getComputedStyle(probe).color;
  });
  probe.remove();
  return colours;
}

/** Show once on the page that a library is not installed. */
export function showMissing(code, text) {
  const place = document.getElementById("missing");
  if (place !== null && place.querySelector(`[data-code="${code}"]`) === null) {
    place.append(html("span", { "data-code": code, text }));
    place.hidden = false;
  }
}

/** address: of a style sheet of an npm package. Returns fails when it is missing. */
export function styleSheet(address) {
  return new Promise((resolve, reject) => {
    const link = document.createElement("link");
    link.rel = "stylesheet";
    link.href = address;
    link.addEventListener("load", () => resolve());
    link.addEventListener("error", () => reject(new Error(`${address} is not there`)));
    // Before the page's own, which have the last word.
    document.head.prepend(link);
  });
}

const SVG = "http://www.w3.org/2000/svg";

/**
 * An element of the page; texts go through textContent alone. tag: with classes behind dots, as
 * `p.note`; has: attributes; `text` is its text, `on` is {event: call}; false and null: not set.
 */
export function element(tag, has = {}, ...children) {
  const [name, ...classes] = tag.split(".");
  return filled(document.createElement(name), classes, has, children);
}

/** An element of a drawing. tag: with classes behind dots; has: as for element(). */
export function drawn(tag, has = {}, ...children) {
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

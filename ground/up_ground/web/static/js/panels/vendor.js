/** Show once on the page that a library is not installed. */
export function sayMissing(sentence) {
  const place = document.getElementById("missing");
  const known = [...(place?.children ?? [])].some((each) => each.textContent === sentence);
  if (place === null || known) {
    return;
  }
  const line = document.createElement("span");
  line.textContent = sentence;
  place.append(line);
  place.hidden = false;
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

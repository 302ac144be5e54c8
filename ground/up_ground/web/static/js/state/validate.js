const MAX_GAIN = 1e12;
const MAX_TEXT = 400;
const MAX_TEXTS = 32;

/** A finite number of sane size; null: any other value. */
export function number(found) {
  return typeof found === "number" && Number.isFinite(found) && Math.abs(found) < MAX_GAIN
    ? found
    : null;
}

export function flag(found) {
  return typeof found === "boolean" ? found : null;
}

export function text(found) {
  return typeof found === "string" ? found.slice(0, MAX_TEXT) : null;
}

/** The texts of a list, bounded; null: no list. */
export function texts(found, limit = MAX_TEXTS) {
  if (!Array.isArray(found)) {
    return null;
  }
  return found
    .slice(0, limit)
    .map(text)
    .filter((each) => each !== null);
}

/** The objects of a list; none: no list. */
export function objects(found) {
  const all = Array.isArray(found) ? found : [];
  return all.filter((each) => each !== null && typeof each === "object");
}

/** The value at a path with dots among own properties; undefined: missing. */
export function at(tree, path) {
  return atKeys(tree, path.split("."));
}

/** keys: which may have dots in them. Returns as at(). */
export function atKeys(tree, keys) {
  let found = tree;
  for (const key of keys) {
    if (found === null || typeof found !== "object" || !Object.hasOwn(found, key)) {
      return undefined;
    }
    found = found[key];
  }
  return found;
}

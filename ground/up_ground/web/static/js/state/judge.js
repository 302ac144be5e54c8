const GREATEST = 1e12;
const LONGEST_TEXT = 400;
const MOST_TEXTS = 32;

/**
 * @param {unknown} found
 * @returns {number|null} a finite number of sane size; null: any other value
 */
export function number(found) {
  return typeof found === "number" && Number.isFinite(found) && Math.abs(found) < GREATEST
    ? found
    : null;
}

/**
 * @param {unknown} found
 * @returns {boolean|null}
 */
export function flag(found) {
  return typeof found === "boolean" ? found : null;
}

/**
 * @param {unknown} found
 * @returns {string|null} a text, bounded
 */
export function text(found) {
  return typeof found === "string" ? found.slice(0, LONGEST_TEXT) : null;
}

/**
 * @param {unknown} found
 * @returns {string[]|null} the texts of a list, bounded; null: no list
 */
export function texts(found) {
  if (!Array.isArray(found)) {
    return null;
  }
  return found
    .slice(0, MOST_TEXTS)
    .map(text)
    .filter((each) => each !== null);
}

/**
 * @param {unknown} tree
 * @param {string} path keys with dots between
 * @returns {unknown} the value at the path among own properties, undefined if missing
 */
export function at(tree, path) {
  return atKeys(tree, path.split("."));
}

/**
 * @param {unknown} tree
 * @param {string[]} keys which may have dots in them
 * @returns {unknown} as at()
 */
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

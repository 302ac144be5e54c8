import { plainNumber } from "../state/format.js";

/** How many values are listed. */
export const MOST_LEAVES = 1000;
const DEEPEST = 24;
const LONGEST_TEXT = 160;
const LONGEST_PATH = 200;
// Invisible characters and those that change the text direction: shown by their number.
const UNSEEN = /[\p{Cc}\p{Cf}\p{Cs}\p{Co}\p{Zl}\p{Zp}]/gu;

/**
 * Every value of a tree of telemetry, in its order; an empty object or list is a value. tree: as
 * received.
 */
export function leavesOf(tree, most = MOST_LEAVES) {
  const leaves = [];
  let isCut = false;

  function walk(value, keys) {
    if (leaves.length >= most) {
      isCut = true;
      return;
    }
    const isBranch = value !== null && typeof value === "object" && keys.length < DEEPEST;
    const names = isBranch ? Object.keys(value) : [];
    if (names.length === 0) {
      leaves.push({ path: keys.join("."), keys, value });
      return;
    }
    for (const name of names) {
      if (isCut) {
        return;
      }
      walk(value[name], [...keys, name]);
    }
  }

  if (tree !== null && typeof tree === "object" && Object.keys(tree).length > 0) {
    walk(tree, []);
  }
  return { leaves, isCut };
}

/** value: of any JSON type. Returns short, on one line, without anything that is not seen. */
export function valueWords(value) {
  if (typeof value === "number") {
    return plainNumber(value);
  }
  if (typeof value === "string") {
    return `"${shown(value, LONGEST_TEXT)}"`;
  }
  return shown(JSON.stringify(value) ?? "", LONGEST_TEXT);
}

/** Short, without anything that is not seen. */
export function pathWords(path) {
  return shown(path, LONGEST_PATH);
}

/** filter: words; each must be in the path, whatever its case. */
export function matches(path, filter) {
  const low = path.toLowerCase();
  return filter
    .toLowerCase()
    .split(/\s+/)
    .every((word) => low.includes(word));
}

function shown(text, longest) {
  const cut = text.length > longest ? `${text.slice(0, longest)}...` : text;
  return cut.replace(UNSEEN, (each) => `\\u{${each.codePointAt(0).toString(16)}}`);
}

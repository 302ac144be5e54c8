const NAME = /^[A-Za-z0-9_.-]{1,128}$/;

/** The input for a field of a Command: {value}, {isLeftOut} or {problem}. Choices and booleans are JSON. */
export function fieldValue(field, text, isNull = false) {
  if (isNull && field.isNullable) {
    return { problem: "", value: null };
  }
  const written = field.type === "text" ? text : text.trim();
  if (written === "") {
    return field.isRequired ? { problem: wanted(field) } : { problem: "", isLeftOut: true };
  }
  const value = valueOf(field, written);
  if (value === undefined || !fits(field, value)) {
    return { problem: wanted(field) };
  }
  return { problem: "", value };
}

/** field: of Catalogue.get(). Returns its type and bounds, as in `up-ground commands`. */
export function wanted(field) {
  return field.text === "" ? "is missing or not what it must be" : `must be ${field.text}`;
}

/** The fields of an unknown Command, written as JSON. empty: none. */
export function jsonFields(text) {
  if (text.trim() === "") {
    return { problem: "", value: {} };
  }
  let value;
  try {
    value = JSON.parse(text);
  } catch (error) {
    return { problem: `invalid JSON: ${error.message}` };
  }
  return isObject(value)
    ? { problem: "", value }
    : { problem: 'write an object: {"field": value}' };
}

/** Why no Command can have that name; empty: one can. */
export function nameProblem(name) {
  return NAME.test(name) ? "" : "a name has letters, digits, dots, _ and - alone, 128 at most";
}

function valueOf(field, text) {
  if (field.choices === null) {
    if (field.type === "text") {
      return text;
    }
    if (field.type === "number" || field.type === "integer") {
      return Number(text);
    }
  }
  try {
    return JSON.parse(text);
  } catch {
    return undefined;
  }
}

function fits(field, value) {
  if (field.choices !== null) {
    return field.choices.includes(value);
  }
  switch (field.type) {
    case "boolean":
      return typeof value === "boolean";
    case "integer":
      return Number.isSafeInteger(value) && isWithin(field, value);
    case "number":
      return Number.isFinite(value) && isWithin(field, value);
    case "text":
      // Counted as the aircraft counts: characters, not halves of them.
      return isShort(field, [...value].length);
    case "object":
      return isObject(value) && isShort(field, Object.keys(value).length);
    case "list":
      return Array.isArray(value) && isShort(field, value.length);
    default:
      return true;
  }
}

function isWithin(field, value) {
  return value >= (field.minimum ?? -Infinity) && value <= (field.maximum ?? Infinity);
}

function isShort(field, length) {
  return length <= (field.longest ?? Infinity);
}

function isObject(value) {
  return value !== null && typeof value === "object" && !Array.isArray(value);
}

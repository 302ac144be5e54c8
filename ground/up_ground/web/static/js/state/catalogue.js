import * as validate from "./validate.js";

const MAX_COMMANDS = 500;
const MAX_FIELDS = 64;
const TYPES = ["boolean", "integer", "number", "text", "object", "list"];

/** The Commands that the ground server knows, its own and those of the cogs that it has. */
export class Catalogue {
  #byName = new Map();

  /** commands: of the server's `catalogue`; malformed entries are dropped. */
  constructor(commands = []) {
    const all = Array.isArray(commands) ? commands.slice(0, MAX_COMMANDS) : [];
    this.commands = all.map(commandOf).filter((each) => each !== null);
    for (const command of this.commands) {
      for (const name of [command.name, ...command.aliases]) {
        if (!this.#byName.has(name)) {
          this.#byName.set(name, command);
        }
      }
    }
  }

  /**
   * name: or alias. Returns {name, aliases, title, role, roleWhere: [{field, value, role}], text,
   * fields: [{name, type, unit, choices, minimum, maximum, longest, isNullable, isRequired, text}]}.
   */
  get(name) {
    return this.#byName.get(name) ?? null;
  }

  /** The least role that may send a Command with these fields; empty: no ground may; null: unknown. */
  role(name, data = {}) {
    const command = this.get(name);
    const isGiven = ({ field, value }) => Object.hasOwn(data, field) && data[field] === value;
    return (command?.roleWhere.find(isGiven) ?? command)?.role ?? null;
  }
}

function commandOf(found) {
  const name = validate.text(validate.at(found, "name"));
  if (!name) {
    return null;
  }
  const fields = validate.at(found, "fields");
  const read = (Array.isArray(fields) ? fields.slice(0, MAX_FIELDS) : []).map(fieldOf);
  return {
    name,
    aliases: validate.texts(found.aliases) ?? [],
    title: validate.text(found.title) || name,
    role: validate.text(found.role) ?? "",
    roleWhere: roleWhereOf(found.role_where),
    text: validate.text(found.text) ?? "",
    fields: read.filter((each) => each !== null),
  };
}

function roleWhereOf(found) {
  return (Array.isArray(found) ? found.slice(0, MAX_FIELDS) : [])
    .filter((each) => each !== null && typeof each === "object")
    .map(({ field, value, role }) => ({ field: validate.text(field) ?? "", value, role: validate.text(role) ?? "" }));
}

function fieldOf(found) {
  const name = validate.text(validate.at(found, "name"));
  if (!name) {
    return null;
  }
  return {
    name,
    // A type of a later server is written as JSON: that server judges it.
    type: TYPES.includes(found.type) ? found.type : "json",
    unit: validate.text(found.unit) ?? "",
    // Bounds may be as large as numbers are.
    minimum: Number.isFinite(found.minimum) ? found.minimum : null,
    maximum: Number.isFinite(found.maximum) ? found.maximum : null,
    choices: Array.isArray(found.choices) ? found.choices : null,
    longest: validate.number(found.max_length),
    isNullable: found.nullable === true,
    isRequired: found.required === true,
    text: validate.text(found.text) ?? "",
  };
}

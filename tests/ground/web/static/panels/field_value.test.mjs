import assert from "node:assert/strict";
import { test } from "node:test";

import { fieldValue, jsonFields, nameProblem } from "../../../../../ground/up_ground/web/static/js/panels/field_value.js";
import { Catalogue } from "../../../../../ground/up_ground/web/static/js/state/catalogue.js";

const COMMANDS = [
  {
    name: "tow.let_out",
    aliases: ["banner"],
    role: "pilot",
    text: "Lets the banner out.",
    needs_beacon: true,
    fields: [
      { name: "length", type: "number", unit: "m", minimum: 0, maximum: 40, required: true, text: "a number between 0 and 40 m" },
      { name: "side", type: "text", choices: ["left", "right"], required: false, text: 'one of "left", "right"' },
      { name: "lamps", type: "integer", minimum: 0, nullable: true, required: false, text: "a whole number of at least 0 or null" },
      { name: "text", type: "text", max_length: 3, required: true, text: "text of at most 3 characters" },
      { name: "lit", type: "boolean", required: true, text: "true or false" },
      { name: "map", type: "object", max_length: 1, required: true, text: "a map of at most 1 keys" },
      { name: "list", type: "list", required: true, text: "a list" },
      { name: "later", type: "colour", required: true, text: "a colour" },
    ],
  },
];

const [command] = new Catalogue(COMMANDS).commands;
const [length, side, lamps, text, lit, map, list, later] = command.fields;

function value(field, written, isNull) {
  const { problem, ...rest } = fieldValue(field, written, isNull);
  assert.equal(problem, "", `${field.name} ${written}`);
  return rest.isLeftOut ? "left out" : rest.value;
}

function problem(field, written, isNull) {
  return fieldValue(field, written, isNull).problem;
}

test("a number is taken within its bounds, and refused in the words of the aircraft", () => {
  assert.equal(value(length, " 12.5 "), 12.5);
  assert.equal(value(length, "0"), 0);
  assert.equal(value(length, "40"), 40);
  for (const wrong of ["", "40.01", "-1", "x", "NaN", "Infinity", "1e999"]) {
    assert.equal(problem(length, wrong), `must be ${length.text}`, wrong);
  }
});

test("a whole number is whole", () => {
  assert.equal(value(lamps, "7"), 7);
  assert.notEqual(problem(lamps, "7.5"), "");
  assert.notEqual(problem(lamps, "90071992547409920"), "");
});

test("optional fields are left out, and null is allowed only for nullable ones", () => {
  assert.equal(value(side, ""), "left out");
  assert.equal(value(lamps, ""), "left out");
  assert.equal(value(lamps, "7", true), null);
  assert.notEqual(problem(length, "", true), "");
});

test("choices, texts, flags, maps and lists", () => {
  assert.equal(value(side, '"right"'), "right");
  assert.notEqual(problem(side, '"up"'), "");
  assert.equal(value(text, " a "), " a ");
  assert.equal(value(text, "\u{1f6e9}\u{1f6e9}\u{1f6e9}"), "\u{1f6e9}\u{1f6e9}\u{1f6e9}");
  assert.equal(problem(text, "abcd"), "must be text of at most 3 characters");
  assert.equal(value(lit, "false"), false);
  assert.notEqual(problem(lit, "0"), "");
  assert.deepEqual(value(map, '{"a": [1]}'), { a: [1] });
  assert.notEqual(problem(map, '{"a": 1, "b": 2}'), "");
  assert.notEqual(problem(map, "[1]"), "");
  assert.notEqual(problem(map, "{"), "");
  assert.deepEqual(value(list, "[1]"), [1]);
  assert.notEqual(problem(list, "null"), "");
  // A type that only a later server knows: JSON, and that server judges.
  assert.equal(value(later, '"red"'), "red");
});

test("the fields of an unknown Command are an object of JSON", () => {
  assert.deepEqual(jsonFields(" "), { problem: "", value: {} });
  assert.deepEqual(jsonFields('{"a": 1}').value, { a: 1 });
  for (const wrong of ["[1]", "null", "{a: 1}"]) {
    assert.notEqual(jsonFields(wrong).problem, "");
  }
  assert.equal(nameProblem("plane.release"), "");
  assert.notEqual(nameProblem("a name"), "");
  assert.notEqual(nameProblem("x".repeat(129)), "");
});

test("a Command is found by its name and its aliases, with its role", () => {
  const catalogue = new Catalogue([
    ...COMMANDS,
    { name: "up.x", role: "pilot", role_where: [{ field: "request", value: true, role: "observer" }, 7] },
  ]);
  assert.equal(catalogue.get("banner").name, "tow.let_out");
  assert.equal(catalogue.role("banner"), "pilot");
  assert.equal(catalogue.role("up.x"), "pilot");
  assert.equal(catalogue.role("up.x", { request: true }), "observer");
  assert.equal(catalogue.role("up.x", { request: 1 }), "pilot");
  assert.equal(catalogue.get("constructor"), null);
  assert.equal(catalogue.role("other"), null);
});

test("a catalogue of nonsense is an empty one", () => {
  for (const nonsense of [undefined, null, 7, "x", {}, [null, 7, [], {}, { name: 7 }, { name: "" }]]) {
    assert.deepEqual(new Catalogue(nonsense).commands, []);
  }
  const odd = new Catalogue([{ name: "a", aliases: 7, role: [], fields: [null, {}, { name: "f", type: 7, choices: 7, minimum: "x" }] }]);
  assert.equal(odd.get("a").fields.length, 1);
  assert.equal(odd.get("a").fields[0].type, "json");
  assert.equal(new Catalogue(Array.from({ length: 900 }, (_, n) => ({ name: `n${n}` }))).commands.length, 500);
});

"""Converts a tree of nodes to the values that a schema declares, with every problem's place."""

from collections.abc import Iterable
from typing import Any, Protocol, runtime_checkable

from up.config.nodes import ListNode, MapNode, Node, Report, ScalarNode
from up.config.scalars import is_null, read_scalar
from up.config.schema import ListOf, MapOf, Schema, Spec
from up.fields import Constraint, ConstraintError, printable, show, suggestion

_VALUE_LIMIT = 1000  # characters of a wrong value in a problem


@runtime_checkable
class ChecksItself(Protocol):
    """A configuration dataclass with constraints between its keys."""

    def problems(self) -> Iterable[tuple[str, str] | tuple[str, str, str]]:
        """Yield (attribute, sentence) for each violation, and its code if not inconsistent."""


class _Refused:
    """Placeholder for a refused value; the problem is already reported."""


_REFUSED = _Refused()


class Validator:
    """Reads nodes according to a schema.

    With `whole` the file must have all its sections, and every map in it all its keys.

    With `valued` every key in the file needs a value; null does not count as one.

    `removed` maps the dotted name of an old key to the sentence that names its replacement; a key
    with an empty one is ignored.
    """

    def __init__(
        self, report: Report, removed: dict[str, str], whole: bool = False, valued: bool = False
    ) -> None:
        self._report = report
        self._head = ""
        self._removed = removed
        self._whole = whole
        self._valued = valued
        self._refused = 0

    def read(self, spec: Spec, node: Node, head: str = "") -> Any:
        """Return the value; after a reported problem it is unspecified.

        `head` is the dotted name of the node if it is part of another file.
        """
        self._head = head
        return self._value(spec, node, "")

    def _value(self, spec: Spec, node: Node, path: str) -> Any:
        if isinstance(spec, Schema):
            return self._schema(spec, node, path)
        if isinstance(spec, MapOf):
            return self._map(spec, node, path)
        if isinstance(spec, ListOf):
            return self._list(spec, node, path)
        if not isinstance(node, ScalarNode):
            found = "a list" if isinstance(node, ListNode) else "a map"
            return self._refuse(node, path, f"must be {spec.describe()}, not {found}", "wrong_type")
        try:
            return read_scalar(node, spec)
        except ConstraintError as error:
            return self._refuse(node, path, str(error), error.code)

    def _schema(self, schema: Schema, node: Node, path: str) -> Any:
        if not isinstance(node, MapNode):
            what = f"must be a map of keys, not {_found(node)}"
            return self._refuse(node, path, what, "wrong_type")
        before = self._refused
        entries = {entry.name: entry for entry in schema.entries}
        places: dict[str, Node] = {}
        values: dict[str, Any] = {}
        for name, key_node, value_node in self._pairs(node, path):
            entry = entries.get(name)
            if entry is None:
                self._unknown(schema, name, key_node, path)
                continue
            places[entry.attribute] = value_node
            inner = _join(path, name)
            if not is_null(value_node):
                values[entry.attribute] = self._value(entry.spec, value_node, inner)
            elif isinstance(entry.spec, Constraint) and entry.spec.nullable:
                values[entry.attribute] = None
            elif self._whole or (self._valued and isinstance(entry.spec, Constraint)):
                self._refuse(value_node, inner, "must have a value", "value_missing")
        if self._whole:
            self._check_whole(schema, node, places, path)
        if self._refused > before:
            return _REFUSED
        value = schema.cls(**values)
        return value if self._fits(schema, value, node, places, path) else _REFUSED

    def _check_whole(
        self, schema: Schema, node: MapNode, places: dict[str, Node], path: str
    ) -> None:
        for entry in schema.entries:
            # A nested section (an axis) may be absent as a whole, a top-level section may not.
            is_part = isinstance(entry.spec, Constraint) or (not path and entry.default is not None)
            if is_part and entry.attribute not in places:
                what = f"the key {show(entry.name)} is missing"
                self._refuse(node, path, what, "key_missing", entry.name)

    def _fits(
        self, schema: Schema, value: Any, node: MapNode, places: dict[str, Node], path: str
    ) -> bool:
        before = self._refused
        if isinstance(value, ChecksItself):
            names = {entry.attribute: entry.name for entry in schema.entries}
            for attribute, what, *code in value.problems():
                inner = _join(path, names[attribute])
                self._refuse(places.get(attribute, node), inner, what, *code)
        return self._refused == before

    def _map(self, spec: MapOf, node: Node, path: str) -> Any:
        if not isinstance(node, MapNode):
            return self._refuse(node, path, f"must be a map, not {_found(node)}", "wrong_type")
        if spec.max_length is not None and len(node.pairs) > spec.max_length:
            return self._refuse(node, path, f"must have at most {spec.max_length} keys", "too_long")
        values: dict[str, Any] = {}
        for name, key_node, value_node in self._pairs(node, path):
            inner = _join(path, name)
            try:
                checked_name = str(read_scalar(key_node, spec.key))
            except ConstraintError as error:
                self._refuse(key_node, inner, f"as a key {error}", error.code)
                continue
            if is_null(value_node) and isinstance(spec.value, Schema) and not self._whole:
                values[checked_name] = spec.value.defaults()
            else:
                values[checked_name] = self._value(spec.value, value_node, inner)
        return values

    def _list(self, spec: ListOf, node: Node, path: str) -> Any:
        if not isinstance(node, ListNode):
            return self._refuse(node, path, f"must be a list, not {_found(node)}", "wrong_type")
        if spec.max_length is not None and len(node.items) > spec.max_length:
            what = f"must have at most {spec.max_length} items"
            return self._refuse(node, path, what, "too_long")
        return tuple(
            self._value(spec.item, item, f"{path}[{index}]")
            for index, item in enumerate(node.items)
        )

    def _pairs(self, node: MapNode, path: str) -> Iterable[tuple[str, ScalarNode, Node]]:
        """Yield name, key and value of each pair, once for each name."""
        lines: dict[str, int] = {}
        for key_node, value_node in node.pairs:
            if not isinstance(key_node, ScalarNode):
                what = f"a key must be one word or text, not {_found(key_node)}"
                self._refuse(key_node, path, what, "wrong_type")
                continue
            name = key_node.text
            if name in lines:
                what = f"the key {show(name)} is repeated, first in line {lines[name]}"
                self._refuse(key_node, path, what, "key_repeated", name)
                continue
            lines[name] = key_node.line
            yield name, key_node, value_node

    def _unknown(self, schema: Schema, name: str, node: Node, path: str) -> None:
        sentence = self._removed.get(_join(path, name))
        if sentence == "":
            return
        if sentence is not None:
            what = f"the key {show(name)} was removed: {sentence}"
            self._refuse(node, path, what, "key_removed", name)
            return
        for entry in schema.entries:
            if name in entry.replaced:
                what = f"the key {show(name)} is now called {show(entry.name)}"
                self._refuse(node, path, what, "key_renamed", name)
                return
        guess = suggestion(name, (entry.name for entry in schema.entries))
        self._refuse(node, path, f"unknown key {show(name)}{guess}", "unknown_key", name)

    def _refuse(
        self, node: Node, path: str, what: str, code: str = "inconsistent", name: str = ""
    ) -> _Refused:
        """Report a problem of the value at `path`, or of its key `name`."""
        self._refused += 1
        head = _join(self._head, show(path)[1:-1])
        text = f"{head}: {what}" if head else what
        value = node.text[:_VALUE_LIMIT] if isinstance(node, ScalarNode) and not name else ""
        key = _join(printable(_join(self._head, path)), printable(name))
        self._report(node.line, node.column, text, code, key, value)
        return _REFUSED


def _found(node: Node) -> str:
    if isinstance(node, MapNode):
        return "a map"
    if isinstance(node, ListNode):
        return "a list"
    return "nothing" if is_null(node) else show(node.text)


def _join(path: str, name: str) -> str:
    return f"{path}.{name}" if path and name else path or name

"""Changes one value in the text of a configuration file and keeps everything else in it."""

from collections.abc import Sequence

from up.config.nodes import MapNode, Node, ScalarNode, compose
from up.config.schema import Schema, Spec
from up.fields import Constraint


def leaves(schema: Schema, prefix: tuple[str, ...] = ()) -> dict[tuple[str, ...], Constraint]:
    """Return the keys with one value, by their path; those of maps with free keys are left out."""
    found: dict[tuple[str, ...], Constraint] = {}
    for entry in schema.entries:
        path, spec = (*prefix, entry.name), entry.spec
        if isinstance(spec, Schema):
            found |= leaves(spec, path)
        elif isinstance(spec, Constraint):
            found[path] = spec
    return found


def value_of(schema: Spec, values: object, path: Sequence[str]) -> object:
    """Return the value at the path of a leaf; None in a section that is absent."""
    for name in path:
        assert isinstance(schema, Schema)
        entry = next(each for each in schema.entries if each.name == name)
        values, schema = getattr(values, entry.attribute, None), entry.spec
    return values


def with_value(text: str, path: Sequence[str], value: str) -> str:
    """Return the text with another value at a path of keys, written there or added.

    It must be valid YAML. Values over several lines are not understood: the caller has to read the
    result, and to compare it.
    """
    lines = text.split("\n")
    node: Node | None = compose(text, lambda *_: None)
    key: Node | None = None
    for place, name in enumerate(path):
        pairs = node.pairs if isinstance(node, MapNode) else []
        found = next((each for each in pairs if getattr(each[0], "text", None) == name), None)
        if found is None:
            return "\n".join(_added(lines, node, key, path[place:], value))
        key, node = found
    if isinstance(node, ScalarNode):
        line, start = lines[node.line - 1], node.column - 1
        written = node.text if node.plain else line[start] + node.text + line[start]
        before, after = line[:start], line[start + len(written) :]
        gap = " " if before.endswith(":") else ""
        lines[node.line - 1] = f"{before}{gap}{value}{after}"
    return "\n".join(lines)


def _added(
    lines: list[str], parent: Node | None, key: Node | None, names: Sequence[str], value: str
) -> list[str]:
    if isinstance(parent, MapNode) and lines[parent.line - 1][parent.column - 1 :][:1] == "{":
        flow = ", ".join(["{".join(f"{name}: " for name in names) + value + "}" * (len(names) - 1)])
        line, at = lines[parent.line - 1], parent.column
        lines[parent.line - 1] = f"{line[:at]}{flow}, {line[at:]}"
        return lines
    if isinstance(parent, MapNode):
        indent = parent.column - 1
    else:
        indent = 0 if key is None else key.column + 1
    block = [f"{'':{indent + 2 * depth}}{name}:" for depth, name in enumerate(names)]
    block[-1] += f" {value}"
    # Behind the line of the section: the comment of its first key stays with that key.
    at = key.line if key is not None else len(lines) - (not lines[-1])
    return lines[:at] + block + lines[at:]

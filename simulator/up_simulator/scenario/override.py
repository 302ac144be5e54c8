"""Values of options that replace keys of a scenario file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from up.config.nodes import ListNode, MapNode, Node, Report, ScalarNode, compose
from up.config.problems import ConfigProblem, Problems
from up.fields import printable


@dataclass(frozen=True, slots=True)
class Override:
    """A value for a dotted key: ``weather.wind_m_s``, ``sticks.0.throttle``.

    ``source`` names it in problems, as ``--set seed=x``.
    """

    source: str
    key: str
    value: str


class _OverrideProblem(ConfigProblem):
    """A problem of an option, which has no line."""

    def __str__(self) -> str:
        return f"{printable(str(self.path))}: {self.what}"


class OverriddenProblems(Problems):
    """Problems of a file in which overrides replace some values: those name the option.

    A node of override N has the line -N - 1, which identifies its problems.
    """

    def __init__(self, path: Path, overrides: Sequence[Override]) -> None:
        super().__init__(path)
        self._overrides = overrides

    def report(self, line: int, column: int, what: str, *more: str) -> None:
        """Add a problem; `line` and `column` count from 1."""
        if line >= 0:
            super().report(line, column, what, *more)
            return
        source = self._overrides[-line - 1].source
        self.found.append(_OverrideProblem(Path(source), 1, 1, what, *more))


def apply(overrides: Sequence[Override], root: MapNode, report: Report) -> None:
    """Put the values into the tree of a file; values with a wrong key are reported."""
    for number, override in enumerate(overrides):
        line = -number - 1

        def refuse(_line: int, _column: int, what: str, *more: str) -> None:
            report(line, 1, what, *more)  # noqa: B023 - called before the next turn

        value = compose(override.value, refuse) or ScalarNode(line, 1, "", True)
        _set_position(value, line)
        _put(root, override.key.split("."), value, line, report)


def _put(node: Node, path: list[str], value: Node, line: int, report: Report) -> None:
    name, rest = path[0], path[1:]
    if isinstance(node, ListNode):
        if not (name.isascii() and name.isdigit()) or int(name[:9]) >= len(node.items):
            report(line, 1, f"unknown item {name[:40]!r}: the list has {len(node.items)}")
        elif rest:
            _put(node.items[int(name)], rest, value, line, report)
        else:
            node.items[int(name)] = value
        return
    if not isinstance(node, MapNode):
        report(line, 1, f"{name[:40]!r} has no keys below it")
        return
    for at, (key, old) in enumerate(node.pairs):
        if isinstance(key, ScalarNode) and key.text == name:
            if rest and not isinstance(old, ScalarNode):
                _put(old, rest, value, line, report)
            else:
                node.pairs[at] = (key, _nested(rest, value, line))
            return
    node.pairs.append((ScalarNode(line, 1, name, True), _nested(rest, value, line)))


def _nested(path: list[str], value: Node, line: int) -> Node:
    """Return the maps that a path needs which the file does not have."""
    for name in reversed(path):
        value = MapNode(line, 1, [(ScalarNode(line, 1, name, True), value)])
    return value


def _set_position(node: Node, line: int) -> None:
    node.line, node.column = line, 1
    if isinstance(node, ListNode):
        for item in node.items:
            _set_position(item, line)
    elif isinstance(node, MapNode):
        for key, value in node.pairs:
            _set_position(key, line)
            _set_position(value, line)

"""A scenario's file: YAML to a Scenario, with every mistake at its place."""

from __future__ import annotations

import difflib
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from up.config.nodes import ListNode, MapNode, Node, Report, ScalarNode, compose
from up.config.problems import Problems
from up.config.reading import decode, read_text
from up.config.shape import shape_of
from up.config.validator import Validator
from up_simulator.scenario.event import Event
from up_simulator.scenario.override import OverriddenProblems, Override, apply
from up_simulator.scenario.plain import plain_of
from up_simulator.scenario.scenario import Scenario

SHAPE = shape_of(Scenario)
_FREE_TEXT = ("is", "is_not", "becomes")


def read_scenario(path: Path | str, overrides: Sequence[Override] = ()) -> Scenario:
    """Return the scenario in a file, with other values for some of its keys.

    Raises ConfigErrors with every mistake and its place.
    """
    path = Path(path)
    problems = OverriddenProblems(path, overrides)
    text = read_text(path, problems.report)
    if text is None and not problems.found:
        problems.report(1, 1, "there is no such file")
    return _parse(text or "", problems, overrides)


def parse_scenario(
    text: str | bytes, path: Path | str = "scenario", overrides: Sequence[Override] = ()
) -> Scenario:
    """Return the scenario in a text; ``path`` is only named. Raises ConfigErrors."""
    problems = OverriddenProblems(Path(path), overrides)
    if isinstance(text, bytes):
        text = decode(text, problems.report) or ""
    return _parse(text, problems, overrides)


def _parse(text: str, problems: Problems, overrides: Sequence[Override]) -> Scenario:
    root = compose(text, problems.report) if not problems.found else None
    if root is None or not isinstance(root, MapNode):
        if not problems.found:
            problems.report(1, 1, "must be a map of keys that begins with 'title: ...'")
        problems.raise_if_any()
        raise AssertionError("a problem has been reported")
    apply(overrides, root, problems.report)
    free = _Free(root, problems.report)
    scenario: Scenario = Validator(problems.report, {}).read(SHAPE, root)
    problems.raise_if_any()
    scenario = free.fill(scenario)
    for node, what in _cross_problems(scenario, root):
        problems.report(node.line, node.column, what)
    problems.raise_if_any()
    return scenario


class _Free:
    """The parts that may hold anything: taken out before the rest is checked, put back after.

    Values of expectations are read as text here: what they mean depends on the signal.
    """

    def __init__(self, root: MapNode, report: Report) -> None:
        self._report = report
        self.profile = self._take(root, "profile")
        self.gains = self._take(root, "gains")
        self.config = self._take(_child(root, "raspilot"), "config")
        self.commands = [
            self._take(_child(event, "command"), "data") for event in _items(root, "events")
        ]
        for expectation in _items(root, "expect"):
            for name in _FREE_TEXT:
                value = _child(expectation, name)
                if isinstance(value, ScalarNode):
                    value.plain = False

    def fill(self, scenario: Scenario) -> Scenario:
        """Return the scenario with what had been taken out of its file."""
        events = tuple(map(_with_data, scenario.events, self.commands))
        raspilot = replace(scenario.raspilot, config=self.config)
        return replace(
            scenario, raspilot=raspilot, events=events, profile=self.profile, gains=self.gains
        )

    def _take(self, parent: Node | None, name: str) -> dict[str, Any]:
        node = _child(parent, name)
        if node is None:
            return {}
        value = plain_of(node, self._report)
        if value is not None and not isinstance(value, dict):
            self._report(node.line, node.column, f"{name}: must be a map of keys")
        assert isinstance(parent, MapNode)
        parent.pairs = [pair for pair in parent.pairs if pair[1] is not node]
        return value if isinstance(value, dict) else {}


def _with_data(event: Event, data: dict[str, Any]) -> Event:
    return (
        event
        if event.command is None
        else replace(event, command=replace(event.command, data=data))
    )


def _cross_problems(scenario: Scenario, root: MapNode) -> Iterator[tuple[Node, str]]:
    """Yield what does not fit together although each part is right by itself."""
    events = {event.title for event in scenario.events}
    for at, expectation in enumerate(scenario.expect):
        node = _items(root, "expect")[at]
        if expectation.after and expectation.after not in events:
            what = f"no event is called {expectation.after!r}{_guess(expectation.after, events)}"
            yield _child(node, "after") or node, what
    yield from _same_names(scenario, root)
    if scenario.control is not None:
        names = {expectation.name for expectation in scenario.expect}
        fails = _items(_child(root, "control"), "fails")
        for at, name in enumerate(scenario.control.fails):
            if name not in names:
                yield fails[at], f"no expectation is called {name!r}{_guess(name, names)}"


def _same_names(scenario: Scenario, root: MapNode) -> Iterator[tuple[Node, str]]:
    seen: set[str] = set()
    for at, expectation in enumerate(scenario.expect):
        if expectation.name in seen:
            node = _items(root, "expect")[at]
            yield _child(node, "name") or node, "two expectations have this name"
        seen.add(expectation.name)


def _guess(name: str, known: set[str]) -> str:
    near = difflib.get_close_matches(name[:100], sorted(known), n=1, cutoff=0.5)
    return f", did you mean {near[0]!r}?" if near else ""


def _child(node: Node | None, name: str) -> Node | None:
    """Return the first value of a key, where there is a map that has it."""
    if isinstance(node, MapNode):
        for key, value in node.pairs:
            if isinstance(key, ScalarNode) and key.text == name:
                return value
    return None


def _items(node: Node | None, name: str) -> list[Node]:
    found = _child(node, name)
    return found.items if isinstance(found, ListNode) else []

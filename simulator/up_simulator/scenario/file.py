"""Reads a scenario file: YAML to a Scenario; problems name file, line and key."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

from up.builtin_modules import BUILTIN_MODULES
from up.cli.verbs import cog_files, program_files
from up.config import ConfigErrors, ConfigFile
from up.config.loader import decode, read_text
from up.config.nodes import ListNode, MapNode, Node, Report, ScalarNode, compose
from up.config.problems import Problems
from up.config.scalars import is_null, needs_quotes
from up.config.schema import schema_of
from up.config.validator import Validator
from up.fields import printable, show, suggestion
from up.loading.application import Application, NoApplicationError
from up.loading.checking import config_files
from up.loading.discovery import survey
from up.loading.plan import BootError
from up_simulator.aircraft import airframe_names
from up_simulator.scenario.crosscheck import cross_problems, exists
from up_simulator.scenario.event import Event
from up_simulator.scenario.locator import child, items_of, path_of
from up_simulator.scenario.override import OverriddenProblems, Override, apply
from up_simulator.scenario.scenario import Scenario

SCHEMA = schema_of(Scenario)
_HERE = Path()
_FREE_TEXT = ("is", "is_not", "becomes")


@cache
def daemon_files() -> dict[str, ConfigFile[Any]]:
    """Return the files that the daemon reads; none without a daemon beside the simulator.

    The daemon itself validates all other files when it starts.
    """
    try:
        application = Application.installed("raspilot")
        found = survey(application)
    except (NoApplicationError, ConfigErrors, BootError):
        return {}
    files = [*config_files((*BUILTIN_MODULES, *found.modules)), *cog_files(application)]
    return {file.filename: file for file in (*program_files(), *files)}


def read_scenario(path: Path | str, overrides: Sequence[Override] = ()) -> Scenario:
    """Return the scenario in a file, with other values for some of its keys.

    Raises ConfigErrors with every mistake and its place.
    """
    path = Path(path)
    problems = OverriddenProblems(path, overrides)
    text = read_text(path, problems.report)
    if text is None and not problems.found:
        problems.report(1, 1, "file not found")
    return _parse(text or "", problems, overrides, path.parent)


def parse_scenario(
    text: str | bytes, path: Path | str = "scenario", overrides: Sequence[Override] = ()
) -> Scenario:
    """Return the scenario in a text; ``path`` is for messages. Raises ConfigErrors."""
    problems = OverriddenProblems(Path(path), overrides)
    if isinstance(text, bytes):
        text = decode(text, problems.report) or ""
    return _parse(text, problems, overrides)


def _parse(
    text: str, problems: Problems, overrides: Sequence[Override], folder: Path = _HERE
) -> Scenario:
    root = compose(text, problems.report) if not problems.found else None
    if root is None or not isinstance(root, MapNode):
        if not problems.found:
            problems.report(1, 1, "must be a map of keys that begins with 'title: ...'")
        problems.raise_if_any()
        raise AssertionError("a problem has been reported")
    # Invalid YAML cannot be checked as a scenario: report only the YAML problems.
    problems.raise_if_any()
    apply(overrides, root, problems.report)
    free = _FreeContent(root, problems.report)
    _check_times(root, problems.report)
    scenario: Scenario = Validator(problems.report, {}, valued=True).read(SCHEMA, root)
    problems.raise_if_any()
    scenario = _with_airframe_beside(free.fill(scenario), folder)
    for node, what in cross_problems(scenario, root):
        path = path_of(root, node)
        problems.report(node.line, node.column, f"{path}: {what}" if path else what)
    problems.raise_if_any()
    return scenario


def _check_times(root: MapNode, report: Report) -> None:
    """Reject an event without a time: the default 0 s is hardly ever intended."""
    for parent, name in ((root, "sticks"), (child(root, "weather"), "gusts"), (root, "events")):
        for at, item in enumerate(items_of(parent, name)):
            if isinstance(item, MapNode) and child(item, "at_s") is None:
                path = f"weather.{name}" if name == "gusts" else name
                report(item.line, item.column, f"{path}[{at}]: needs 'at_s', the time")


def _with_airframe_beside(scenario: Scenario, folder: Path) -> Scenario:
    """Look for an airframe beside the file too, if its path does not exist from here."""
    beside = folder / scenario.airframe
    if scenario.airframe in airframe_names() or exists(Path(scenario.airframe)):
        return scenario
    return replace(scenario, airframe=str(beside)) if exists(beside) else scenario


class _FreeContent:
    """The parts with free content: taken out before the rest is checked, put back after.

    Values of expectations are read as text here: their meaning depends on the signal.
    """

    def __init__(self, root: MapNode, report: Report) -> None:
        self._report = report
        self._check_config(child(root, "profile"), "airframe.yml", "profile")
        self._check_config(child(root, "gains"), "pids.yml", "gains")
        config = child(child(root, "raspilot"), "config")
        for name, node in config.pairs if isinstance(config, MapNode) else ():
            if isinstance(name, ScalarNode):
                self._check_file_name(name)
                self._check_config(node, name.text, f"raspilot.config.{printable(name.text[:60])}")
        self.profile = self._cut(root, "profile")
        self.gains = self._cut(root, "gains")
        self.config = self._cut(child(root, "raspilot"), "config", "raspilot.")
        self.commands = [
            self._cut(child(event, "command"), "data", f"events[{at}].command.")
            for at, event in enumerate(items_of(root, "events"))
        ]
        for expectation in items_of(root, "expect"):
            for key in _FREE_TEXT:
                value = child(expectation, key)
                if isinstance(value, ScalarNode):
                    value.plain = False

    def fill(self, scenario: Scenario) -> Scenario:
        """Return the scenario with the parts that were cut from its file."""
        events = tuple(map(_with_data, scenario.events, self.commands))
        raspilot = replace(scenario.raspilot, config=self.config)
        return replace(
            scenario, raspilot=raspilot, events=events, profile=self.profile, gains=self.gains
        )

    def _check_file_name(self, name: ScalarNode) -> None:
        known = daemon_files()
        if known and name.text not in known:
            what = f"unknown file {name.text[:60]!r}{suggestion(name.text, known)}"
            self._report(name.line, name.column, f"raspilot.config: {what}")

    def _check_config(self, node: Node | None, filename: str, head: str) -> None:
        """Validate part of a configuration file as the daemon would."""
        file = daemon_files().get(filename) if node is not None else None
        if file is not None and node is not None and not is_null(node):
            Validator(self._report, dict(file.removed)).read(file.schema, node, head)

    def _cut(self, parent: Node | None, name: str, above: str = "") -> dict[str, Any]:
        node = child(parent, name)
        if node is None:
            return {}
        value = plain_of(node, f"{above}{name}", self._report)
        if value is not None and not isinstance(value, dict):
            self._report(node.line, node.column, f"{above}{name}: must be a map of keys")
        assert isinstance(parent, MapNode)
        parent.pairs = [pair for pair in parent.pairs if pair[1] is not node]
        return value if isinstance(value, dict) else {}


def _with_data(event: Event, data: dict[str, Any]) -> Event:
    return (
        event
        if event.command is None
        else replace(event, command=replace(event.command, data=data))
    )


_INT = re.compile(r"[-+]?(0|[1-9][0-9]{0,17})", re.ASCII)
_FLOAT = re.compile(r"[-+]?((0|[1-9][0-9]*)(\.[0-9]*)?|\.[0-9]+)([eE][-+]?[0-9]{1,3})?", re.ASCII)
_BOOLS = {"true": True, "false": False}


def plain_of(node: Node, path: str, report: Report) -> Any:
    """Return maps, lists, numbers, true, false, None and texts; ambiguous scalars are reported.

    Readers of YAML disagree on some scalars (``no``, ``12:30``, ``010``): these must be in quotes.
    ``path`` is the key of the node, for problems.
    """
    if isinstance(node, ListNode):
        return [plain_of(item, f"{path}[{at}]", report) for at, item in enumerate(node.items)]
    if isinstance(node, ScalarNode):
        return _scalar(node, path, report)
    values: dict[str, Any] = {}
    for key, value in node.pairs:
        if not isinstance(key, ScalarNode):
            report(key.line, key.column, f"{path}: a key must be one word or text")
        elif key.text in values:
            report(key.line, key.column, f"{path}: duplicate key {show(key.text)}")
        else:
            values[key.text] = plain_of(value, f"{path}.{printable(key.text[:60])}", report)
    return values


def _scalar(node: ScalarNode, path: str, report: Report) -> Any:
    text = node.text
    if not node.plain:
        return text
    if is_null(node):
        return None
    if text in _BOOLS:
        return _BOOLS[text]
    if _INT.fullmatch(text):
        return int(text)
    if len(text) < 400 and _FLOAT.fullmatch(text):
        number = float(text)
        if abs(number) < float("inf"):
            return number
    if needs_quotes(text):
        what = f"{path}: {show(text)} is ambiguous: write true or false, a plain number, or quotes"
        report(node.line, node.column, what)
    return text

"""YAML text to a tree of nodes with positions; it interprets no value.

Accepts only a simple subset of YAML: one document, maps, lists and scalars. It refuses anchors,
aliases, tags and deep nesting, so that a file can neither expand on reading nor create objects.
"""

from __future__ import annotations

import re
from contextlib import suppress
from dataclasses import field
from typing import Any, Protocol

import yaml

from up.fields import printable, show
from up.quick_dataclass import dataclass

MAX_DEPTH = 20
MAX_NODES = 50_000
# libyaml needs a twentieth of the time: seconds of a start on a Raspberry Pi Zero. Some builds of
# PyYAML are without it.
_LIBYAML: Any = getattr(yaml, "CSafeLoader", None)
_ONLY_PYYAML = re.compile(
    r"[\t\x85\u2028\u2029]|---|[|>][-+0-9]*#|:\s*[,}\]]|^(?!\s*#).*\?", re.MULTILINE
)
"""Texts that libyaml may accept where PyYAML does not, or places elsewhere."""


class Report(Protocol):
    """Takes a problem: line and column from 1, text, code (of
    `up.config.problems.CODES`), dotted key and value."""

    def __call__(
        self,
        line: int,
        column: int,
        what: str,
        code: str = "inconsistent",
        key: str = "",
        value: str = "",
        /,
    ) -> None: ...


@dataclass(slots=True)
class ScalarNode:
    """A single value as written; `plain` if it had no quotes."""

    line: int
    column: int
    text: str
    plain: bool


@dataclass(slots=True)
class ListNode:
    """A list of nodes."""

    line: int
    column: int
    items: list[Node] = field(default_factory=list)


@dataclass(slots=True)
class MapNode:
    """Pairs of nodes in the order of the file, duplicates included."""

    line: int
    column: int
    pairs: list[tuple[Node, Node]] = field(default_factory=list)


Node = ScalarNode | ListNode | MapNode


def compose(text: str, report: Report) -> Node | None:
    """Return the root of the one document; None if it is absent or cannot be parsed.

    Errors are reported as problems; no text makes it raise.
    """
    if _LIBYAML is not None and not _ONLY_PYYAML.search(text):
        problems: list[object] = []
        builder = _Builder(lambda *problem: problems.append(problem))
        with suppress(yaml.YAMLError, ValueError, OverflowError):
            if all(map(builder.process, yaml.parse(text, Loader=_LIBYAML))) and not problems:
                return builder.root
    # The same problems everywhere, in PyYAML's words.
    builder = _Builder(report)
    try:
        for event in yaml.parse(text, Loader=yaml.SafeLoader):
            if not builder.process(event):
                return None
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        line, column = (mark.line + 1, mark.column + 1) if mark else (1, 1)
        report(line, column, _syntax_sentence(error), "not_yaml")
    except yaml.reader.ReaderError as error:
        line, column = place_of(text, int(error.position))
        what = f"the character {show(text[error.position])} is not allowed here"
        report(line, column, what, "not_yaml")
    except (ValueError, OverflowError):
        # PyYAML converts the digits of \U escapes and of %YAML to numbers without a size limit.
        what = "an escape or directive after this place is not valid"
        report(builder.line, builder.column, what, "not_yaml")
    else:
        return builder.root
    return None


def place_of(text: str, position: int) -> tuple[int, int]:
    """Return line and column, from 1, of a position in a text."""
    before = text[:position]
    return before.count("\n") + 1, position - (before.rfind("\n") + 1) + 1


def _syntax_sentence(error: yaml.MarkedYAMLError) -> str:
    problem = printable(str(error.problem or error.context or "cannot be understood"))
    if "'\\t'" in problem:
        return "a tab cannot indent here, use spaces"
    if "mapping values are not allowed" in problem:
        advice = "a text with ': ' in it needs quotes; or the indentation is wrong"
        return f"is not valid YAML: {problem} ({advice})"
    if error.context and error.problem and error.context_mark:
        context, line = printable(str(error.context)), error.context_mark.line + 1
        return f"is not valid YAML: {problem} ({context}, line {line}){_advice(error)}"
    advice = ": is the indentation right?" if "<document start>" in problem else ""
    return f"is not valid YAML: {problem}{advice}"


def _advice(error: yaml.MarkedYAMLError) -> str:
    context = str(error.context)
    if "block" in context:
        return ": is the indentation right?"
    if "simple key" in context:
        return ": a key needs ': ' behind it, and a text of several lines quotes or '>'"
    return ""


class _Builder:
    """Builds the tree from events with its own stack, so that depth cannot exhaust Python's."""

    def __init__(self, report: Report) -> None:
        self.root: Node | None = None
        self.line = self.column = 1
        self._report = report
        self._open: list[ListNode | MapNode] = []
        self._keys: list[Node | None] = []
        self._count = 0
        self._documents = 0

    def process(self, event: yaml.Event) -> bool:
        """Process the next event; return False if the rest of the file is unusable."""
        mark = event.start_mark
        if mark is not None:
            self.line, self.column = mark.line + 1, mark.column + 1
        if isinstance(event, yaml.DocumentStartEvent):
            self._documents += 1
            if self._documents > 1:
                self._refuse("a second document begins here, a file may hold only one")
                return False
        elif isinstance(event, yaml.CollectionEndEvent):
            self._open.pop()
            self._keys.pop()
        elif isinstance(event, yaml.NodeEvent):
            return self._process_node(event)
        return True

    def _process_node(self, event: yaml.NodeEvent) -> bool:
        self._count += 1
        if self._count > MAX_NODES:
            self._refuse(f"the file has more than {MAX_NODES} values", "file_too_large")
            return False
        if isinstance(event, yaml.AliasEvent):
            name = printable(str(event.anchor))
            self._refuse(f"aliases (*{name}) are not allowed, write the value itself")
            self._place(ScalarNode(self.line, self.column, "", True))
            return True
        if event.anchor is not None:
            self._refuse(f"anchors (&{printable(event.anchor)}) are not allowed")
        if isinstance(event, yaml.ScalarEvent | yaml.CollectionStartEvent) and event.tag:
            tag = printable(event.tag).replace("tag:yaml.org,2002:", "!!")
            self._refuse(f"tags ({tag}) are not allowed, write the plain value")
        node: Node
        if isinstance(event, yaml.ScalarEvent):
            node = ScalarNode(self.line, self.column, event.value, not event.style)
        elif isinstance(event, yaml.MappingStartEvent):
            node = MapNode(self.line, self.column)
        else:
            node = ListNode(self.line, self.column)
        self._place(node)
        if not isinstance(node, ScalarNode):
            if len(self._open) >= MAX_DEPTH:
                self._refuse(f"is nested more than {MAX_DEPTH} deep", "file_too_large")
                return False
            self._open.append(node)
            self._keys.append(None)
        return True

    def _place(self, node: Node) -> None:
        if not self._open:
            self.root = node
            return
        parent = self._open[-1]
        if isinstance(parent, ListNode):
            parent.items.append(node)
            return
        key, self._keys[-1] = self._keys[-1], None
        if key is None:
            self._keys[-1] = node
        else:
            parent.pairs.append((key, node))

    def _refuse(self, what: str, code: str = "not_supported") -> None:
        self._report(self.line, self.column, what, code)

"""Converts a tree of nodes to plain values, where no shape defines their types."""

from __future__ import annotations

import re
from typing import Any

from up.config.nodes import ListNode, MapNode, Node, Report, ScalarNode
from up.config.scalars import is_null, needs_quotes
from up.fields import show

_INT = re.compile(r"[-+]?(0|[1-9][0-9]{0,17})", re.ASCII)
_FLOAT = re.compile(r"[-+]?((0|[1-9][0-9]*)(\.[0-9]*)?|\.[0-9]+)([eE][-+]?[0-9]{1,3})?", re.ASCII)
_BOOLS = {"true": True, "false": False}


def plain_of(node: Node, report: Report) -> Any:
    """Return maps, lists, numbers, true, false, None and texts; ambiguous scalars are reported.

    Readers of YAML disagree on some scalars (``no``, ``12:30``, ``010``): these must be in quotes.
    """
    if isinstance(node, MapNode):
        return _map(node, report)
    if isinstance(node, ListNode):
        return [plain_of(item, report) for item in node.items]
    return _scalar(node, report)


def _map(node: MapNode, report: Report) -> dict[str, Any]:
    values: dict[str, Any] = {}
    for key, value in node.pairs:
        if not isinstance(key, ScalarNode):
            report(key.line, key.column, "a key must be one word or text")
        elif key.text in values:
            report(key.line, key.column, f"the key {show(key.text)} stands here twice")
        else:
            values[key.text] = plain_of(value, report)
    return values


def _scalar(node: ScalarNode, report: Report) -> Any:
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
        what = (
            f"{show(text)} can be read in two ways: write true or false, a plain number, or quotes"
        )
        report(node.line, node.column, what)
    return text

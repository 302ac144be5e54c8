"""What became of a Command, in the words of an event."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from up_ground.web.answers import Answer

GAINS = "arduino.pids.tunings"
MARK = "black_box.mark"
_LOOPS = {"ratePIDs": "rate", "stabPIDs": "stabilize", "navPIDs": "navigation"}
_SHOWN = 4


def in_words(
    who: str, name: str, data: Mapping[str, Any], before: Any, answer: Answer
) -> tuple[str, str]:
    """Return kind and text; ``before`` are the gains that flew before, None: not known."""
    is_set = name == GAINS and data.get("request") is not True
    kind, what = "command", name
    if is_set:
        kind, what = "gains", f"the gains ({_changes(before, data.get('pids'))})"
    elif name == MARK and answer.outcome == "ack":
        return "mark", f"mark of {who}: {data.get('text')}"
    if answer.outcome == "ack":
        done = f"{who} changed {what}" if is_set else f"{who}: {what} carried out"
        return kind, done
    if answer.outcome == "nack":
        return kind, f"{who}: {what} refused: {answer.reason} ({answer.code})"
    return kind, f"{who}: {what}: {answer.reason}"


def _changes(before: Any, after: Any) -> str:
    if not isinstance(before, dict) or not isinstance(after, dict):
        return "it is not known what flew before"
    found = list(_differences(before, after))
    more = f" and {len(found) - _SHOWN} more" if len(found) > _SHOWN else ""
    return ", ".join(found[:_SHOWN]) + more if found else "nothing differs"


def _differences(before: Mapping[str, Any], after: Mapping[str, Any]) -> Iterator[str]:
    for loop, axes in after.items():
        for axis, gains in _items(axes):
            for letter, value in _items(gains):
                was = before.get(loop)
                for key in (axis, letter):
                    was = was.get(key) if isinstance(was, dict) else None
                if was != value:
                    words = f"{_LOOPS.get(loop, loop)} {axis} {letter.upper()}"
                    yield f"{words} {was if was is not None else '--'} to {value}"


def _items(found: Any) -> list[tuple[str, Any]]:
    return list(found.items()) if isinstance(found, dict) else []

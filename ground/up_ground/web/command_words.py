"""What became of a Command, in the words of an event."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from up.flight_log.gain_changes import changes_text
from up_ground.web.answers import Answer

GAINS = "arduino.pids.tunings"
MARK = "black_box.mark"
_SHOWN = 4


def in_words(
    who: str, name: str, data: Mapping[str, Any], before: Any, answer: Answer
) -> tuple[str, str]:
    """Return kind and text; ``before`` are the gains that flew before, None: not known."""
    kind, what, done = "command", name, f"{name} carried out"
    if name == GAINS and data.get("request") is not True:
        after = data.get("pids")
        changes = changes_text(before, after, _SHOWN) or "nothing differs"
        kind, what, done = "gains", f"gains ({changes})", f"changed gains: {changes}"
    elif name == MARK:
        kind, what, done = "mark", f"the mark {data.get('text')}", f"marks: {data.get('text')}"
    if answer.outcome == "ack":
        return kind, f"{who}: {done}" if kind == "command" else f"{who} {done}"
    if answer.outcome == "nack":
        return kind, f"{who}: {what} refused: {answer.reason} ({answer.code})"
    return kind, f"{who}: {what}: {answer.reason}"

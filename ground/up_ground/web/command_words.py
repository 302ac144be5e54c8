"""Outcomes of Commands as event texts."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from up.flight_log.gain_changes import changes_text
from up_ground.web.answers import Answer

GAINS = "arduino.pids.tunings"
MARK = "black_box.mark"
CALIBRATE = "arduino.calibrate"
_SHOWN = 4
_OF_BOARD = "the Arduino refused: "
# The same names as in static/js/panels/words.js; the braces stand for the field.
_WORDS = {
    "up.flight_mode.set": ("Flight mode {}", "mode"),
    "up.arm": ("Arm", ""),
    "up.disarm": ("Disarm", ""),
    "up.telemetry.frequency": ("Telemetry every {} ms", "frequency"),
    "android.speak": ('Say "{}"', "text"),
    "arduino.profile.request": ("Ask for the profile", ""),
    CALIBRATE: ("Calibrate {}", "what"),
}


def in_words(
    who: str, name: str, data: Mapping[str, Any], before: Any, answer: Answer
) -> tuple[str, str]:
    """Return kind and text; ``before`` are the gains that flew before, None: not known."""
    words = _words(name, data)
    kind, what, done = "command", words, f"{words} carried out"
    if name == GAINS and data.get("request") is not True:
        after = data.get("pids")
        changes = changes_text(before, after, _SHOWN) or "nothing differs"
        kind, what, done = "gains", f"gains ({changes})", f"changed gains: {changes}"
    elif name == MARK:
        kind, what, done = "mark", f"the mark {data.get('text')}", f"marks: {data.get('text')}"
    if answer.outcome == "ack":
        return kind, f"{who}: {done}" if kind == "command" else f"{who} {done}"
    if answer.outcome == "nack":
        by, reason = _refusal(answer)
        return kind, f"{who}: {what} refused by {by}: {reason}"
    return kind, f"{who}: {what}: {answer.reason}"


def _words(name: str, data: Mapping[str, Any]) -> str:
    """Return a Command as the page calls it; one that the page does not know by its name."""
    if name == GAINS:
        return "Ask for the gains"
    words = _WORDS.get(name)
    if words is None:
        return name
    text, field = words
    shown = str(data.get(field)).replace("_", " ") if name == CALIBRATE else data.get(field)
    return text.format(shown)


def _refusal(answer: Answer) -> tuple[str, str]:
    """Return who refused and why: the board's own refusal includes its name."""
    reason = answer.reason.rstrip(". ")
    if reason.startswith(_OF_BOARD) and reason != _OF_BOARD:
        return "the Arduino", reason.removeprefix(_OF_BOARD)
    return "the aircraft", reason or answer.code or "no reason given"

"""The gains that differ between two sets, in the ground station's terms."""

from collections.abc import Iterator, Mapping
from math import isclose
from typing import Any

from up.flight_log.json_message import number_at

LOOPS = {
    "ratePIDs": "rate",
    "stabPIDs": "stabilize",
    "stabilizePIDs": "stabilize",
    "navPIDs": "navigation",
}
AXES = {"ailerons": "roll", "elevator": "pitch", "rudder": "yaw"}
TERMS = ("p", "i", "d")
_SINGLE = 1e-6
Key = tuple[str, str, str]
"""Loop, axis and term, in words: rate, roll, p."""


def gains_of(data: Any) -> dict[Key, float]:
    """Return the gains in a set in the form of the wire (``{ratePIDs: {ailerons: {p: 3}}}``)."""
    return dict(_cells(data)) if isinstance(data, dict) else {}


def changes_text(before: Any, after: Any, limit: int = 27) -> str:
    """Return ``rate roll P 3 to 2.4, ...``; empty if nothing differs.

    A gain missing in ``before`` is listed with its new value only; differences beyond ``limit`` are
    only counted.
    """
    known = gains_of(before)
    found = [
        f"{loop} {axis} {term.upper()} {_from(known.get((loop, axis, term)))}{value:g}"
        for (loop, axis, term), value in gains_of(after).items()
        if not _is_same(known.get((loop, axis, term)), value)
    ]
    more = f" and {len(found) - limit} more" if len(found) > limit else ""
    return ", ".join(found[:limit]) + more


def _is_same(before: float | None, after: float) -> bool:
    """Return whether two gains are equal: the board holds them in single precision."""
    return before is not None and isclose(before, after, rel_tol=_SINGLE, abs_tol=1e-9)


def _from(value: float | None) -> str:
    return "" if value is None else f"{value:g} to "


def _cells(data: Mapping[str, Any]) -> Iterator[tuple[Key, float]]:
    for loop, loop_word in LOOPS.items():
        for axis, axis_word in AXES.items():
            for term in TERMS:
                value = number_at(data, (loop, axis, term))
                if value is not None:
                    yield (loop_word, axis_word, term), value

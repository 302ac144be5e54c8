"""A fault in a flight."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Literal

from up.flight_log.facts import Facts

Level = Literal["info", "warning", "alarm"]


@dataclass(frozen=True, slots=True)
class Wrong:
    """A fault in plain words; ``time_s`` counts from the log's first message.

    ``length_s``: its duration, if it lasted. ``code`` and ``values``: the same for programs, for
    kinds that have a code.
    """

    time_s: float
    level: Level
    text: str
    length_s: float = field(default=0.0, compare=False)
    code: str = field(default="", compare=False)
    values: Mapping[str, float | str] = field(default_factory=dict, compare=False)


Judge = Callable[[Facts], Iterator[Wrong]]
"""Searches a flight for one kind of fault; a new kind is a function and an entry in a table."""

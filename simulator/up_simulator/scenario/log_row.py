"""One row of a flight's log, read by the names of signals."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from up_simulator.scenario.log import Value

Data = dict[str, Any]
Message = tuple[str, Data]
"""A topic, and the data of one message."""


class LogRow:
    """The value of every signal at one time; None if unknown."""

    def __init__(self, values: Mapping[str, Value]) -> None:
        self._values = values
        self.time_s = self.number("time_s") or 0.0

    def number(self, name: str) -> float | None:
        """Return a number that is one."""
        value = self._values.get(name)
        return value if isinstance(value, float) and math.isfinite(value) else None

    def whole(self, name: str) -> int | None:
        """Return a number as a whole one."""
        value = self.number(name)
        return None if value is None else round(value)

    def flag(self, name: str) -> bool | None:
        """Return a flag."""
        value = self.number(name)
        return None if value is None else bool(value)

    def word(self, name: str) -> str | None:
        """Return a word that is not empty."""
        value = self._values.get(name)
        return value if isinstance(value, str) and value else None

    def known(self) -> Iterator[tuple[str, float | str]]:
        """Yield every signal that is known."""
        for name, value in self._values.items():
            if math.isfinite(value) if isinstance(value, float) else value:
                yield name, value

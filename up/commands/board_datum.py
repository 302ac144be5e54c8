"""Rows of the tables in ``board_schema``."""

from __future__ import annotations

from typing import Literal, NamedTuple


class Datum(NamedTuple):
    """A field of the board's status, or a bit of one; ``signal`` is its name in scenarios."""

    name: str
    field: str
    bit: int | None
    kind: Literal["flag", "number", "text"]
    unit: str
    about: str
    in_telemetry: bool
    signal: str


class Alarm(NamedTuple):
    """A condition of the board's part of telemetry that is an event, an alarm or a finding."""

    name: str
    field: str
    bit: int | None
    kind: str
    when: bool | None
    above: float | None
    level: str
    level_armed: str
    code: str
    text: str
    end_code: str
    end: str
    event: str
    unless: str
    lasts: bool
    hold_s: float | None
    finding: str

    def holds(self, value: float | bool | None) -> bool | None:
        """Return whether a value fulfils the condition; None if it is unknown."""
        if value is None:
            return None
        return value is self.when if self.above is None else value > self.above

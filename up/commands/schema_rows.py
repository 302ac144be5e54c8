"""Rows of the tables in ``board_schema`` and ``telemetry_schema``."""

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


class Reading(NamedTuple):
    """Greatest age of a reading that is not stale, and of a source that is followed."""

    stale_s: float
    source_s: float


class Field(NamedTuple):
    """A field of telemetry; ``reading``: whose age it has ("": its frame's).

    ``key`` is the field of the ``command`` that carries the value ("": none does); ``decimals`` is
    the resolution of a number.
    """

    path: str
    type: Literal["number", "flag", "text", "texts", "object"]
    unit: str = ""
    reading: str = ""
    command: str = ""
    key: str = ""
    decimals: int = 3


class Rule(NamedTuple):
    """A field of telemetry whose change is an event, or whose condition is an alarm or a finding.

    ``event`` and ``alarm`` are their kinds ("": none). A condition has ``when``, ``above`` or
    ``below``; without one each change of the value counts. ``awaits``: without any of these
    readings the part was never there, so it is not lost.
    """

    code: str
    level: str
    path: str = ""
    type: Literal["number", "flag", "text", "texts"] = "flag"
    text: str = ""
    end_code: str = ""
    end: str = ""
    event: str = ""
    first: bool = False
    alarm: str = ""
    level_armed: str = ""
    unless: str = ""
    when: bool | None = None
    above: float | None = None
    below: float | None = None
    back: float = 0.0
    awaits: tuple[str, ...] = ()
    awaited_code: str = ""
    awaited_text: str = ""
    awaited_level: str = ""
    finding: str = ""

    def holds(self, value: float | bool | None, before: bool = False) -> bool | None:
        """Return whether a value fulfils the condition, which it did before; None if unknown."""
        if value is None:
            return None
        margin = self.back if before else 0.0
        if self.above is not None:
            return value > self.above - margin
        return value is self.when if self.below is None else value < self.below + margin

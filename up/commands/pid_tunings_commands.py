"""The gains: requested, set and reported (thesis 4.2.4)."""

from __future__ import annotations

from typing import Any

from up.commands.command import BaseCommand, value
from up.commands.gains import GainSet, gain_set_from_data, gain_set_to_data
from up.commands.roles import Role
from up.quick_dataclass import dataclass


@dataclass(frozen=True, slots=True)
class PIDTuningsCommand(BaseCommand):
    """Asks for the gains (``request``) or sets all of them (``pids``); a request wins."""

    NAME = "arduino.pids.tunings"
    TITLE = "Gains"
    ROLES = frozenset({Role.PILOT})
    ROLES_WHERE = {"request": {True: frozenset({Role.OBSERVER})}}
    request: bool | None = value(None)
    pids: dict[str, Any] | None = value(None)

    def __post_init__(self) -> None:
        if self.request:
            return
        if self.pids is None:
            raise ValueError("either request or pids is needed")
        gain_set_from_data(self.pids)

    @property
    def gains(self) -> GainSet | None:
        if self.request or self.pids is None:
            return None
        return gain_set_from_data(self.pids)


@dataclass(frozen=True, slots=True)
class PIDTuningsValuesCommand(BaseCommand):
    """The gains in use now, in full precision, in the form that PIDTuningsCommand takes."""

    NAME = "arduino.pids.values"
    pids: dict[str, Any] = value()

    @classmethod
    def of(cls, gains: GainSet) -> PIDTuningsValuesCommand:
        return cls(gain_set_to_data(gains))

    @property
    def data(self) -> dict[str, Any]:
        """Return the set itself, without an outer key."""
        return self.pids

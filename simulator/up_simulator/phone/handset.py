"""The common interface of every phone aboard."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

from up_simulator.aircraft.flight import FlightState

Record = Callable[[FlightState], dict[str, Any]]
"""The phone's data for the black box: the data of ``black_box.record``."""


class Handset(Protocol):
    """A phone with its links; ``tick`` must be called every few milliseconds after ``start``."""

    def start(self) -> None:
        """Switch it on: it connects, and connects again after every loss."""

    def tick(self) -> None:
        """Do the work that is due."""

    async def stop(self) -> None:
        """Switch it off permanently."""

"""The common interface of every phone aboard."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from typing import Any, Protocol

from up_simulator.aircraft.flight import FlightSource, FlightState
from up_simulator.harness.user_log import Log
from up_simulator.phone.address import RaspberryPi
from up_simulator.phone.link import OrientationBy, PhoneLink
from up_simulator.phone.phone import Phone

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


class PythonHandset:
    """The stub in Python: for scenarios, and for machines without Java."""

    def __init__(
        self,
        reactor: Any,
        flight: FlightSource,
        find: Callable[[], Awaitable[RaspberryPi]],
        orientation: OrientationBy,
        log: Log,
        *,
        seed: int = 1,
        identity: str = "",
        record: Record | None = None,
    ) -> None:
        self._phone = Phone(flight, reactor, seed=seed, identity=identity, log=log, record=record)
        self._link = PhoneLink(reactor, self._phone, find, orientation, log)
        self.sensors = self._phone.sensors
        self.tick = self._phone.tick
        self.set_battery = self._phone.set_battery

    def start(self) -> None:
        self._link.start()

    async def stop(self) -> None:
        await self._link.stop()

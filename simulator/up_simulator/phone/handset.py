"""The common interface of every phone aboard."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from typing import Any, Protocol

from up_simulator.aircraft.flight import Flight, FlightState
from up_simulator.phone.address import RaspberryPi
from up_simulator.phone.link import OrientationBy, PhoneLink
from up_simulator.phone.phone import Phone
from up_simulator.phone.sensors import PhoneSensors

Record = Callable[[FlightState], dict[str, Any]]
"""The phone's data for the black box: the data of ``black_box.record``."""


class Handset(Protocol):
    """A phone with its links; ``tick`` must be called every few milliseconds after ``start``.

    ``loss`` is a sentence about its unexpected end; None if it runs.
    """

    loss: str | None
    sensors: PhoneSensors

    def start(self) -> None:
        """Switch it on: it connects, and connects again after every loss."""

    def tick(self) -> None:
        """Do the work that is due."""

    def set_battery(self, percent: float) -> None:
        """Set the level of its battery."""

    async def stop(self) -> None:
        """Switch it off permanently."""


class PythonHandset:
    """The stand-in in Python: for machines without Java."""

    loss: str | None = None

    def __init__(
        self,
        reactor: Any,
        flight: Flight,
        find: Callable[[], Awaitable[RaspberryPi]],
        orientation: OrientationBy,
        say: Callable[[str], None],
        *,
        seed: int = 1,
        identity: str = "",
        record: Record | None = None,
    ) -> None:
        self._phone = Phone(flight, reactor, seed=seed, identity=identity, say=say, record=record)
        self._link = PhoneLink(reactor, self._phone, find, orientation, say)
        self.sensors = self._phone.sensors
        self.tick = self._phone.tick
        self.set_battery = self._phone.set_battery

    def start(self) -> None:
        """Begin to connect."""
        self._link.start()

    async def stop(self) -> None:
        """Close every link."""
        await self._link.stop()

"""The interface of a scenario to the aircraft's companions, in process or as real programs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Protocol


class Raspilot(Protocol):
    """The daemon aboard: started, stopped, killed and started again in flight."""

    @property
    def is_running(self) -> bool:
        """Return whether it runs now."""

    @property
    def log(self) -> Sequence[str]:
        """Return the newest lines that it logged, the oldest first."""

    def start(self) -> None:
        """Start it, or start it again; raises ParticipantError with the daemon's own sentences."""

    def stop(self) -> None:
        """Send it the signal to end, as a service manager does; ``is_running`` has the result."""

    def kill(self) -> None:
        """Kill it immediately in any state, as ``kill -9`` does."""


class Ground(Protocol):
    """A ground station: its received data and its requests."""

    @property
    def telemetry(self) -> Mapping[str, Any]:
        """Return the newest frame, empty before the first."""

    @property
    def frames(self) -> int:
        """Return the number of frames received."""

    @property
    def newest_s(self) -> float | None:
        """Return the participants' time of the newest frame; None before the first."""

    def take_latency_s(self) -> float | None:
        """Return the maximum age of the data since the last call, s; None if unknown.

        Without new data it is the age of the newest earlier frame.
        """

    @property
    def is_connected(self) -> bool:
        """Return whether there is a connection, as far as this end knows."""

    def start(self) -> None:
        """Connect, and connect again after every loss."""

    def stop(self) -> None:
        """Disconnect permanently."""

    def send(self, name: str, **data: Any) -> str:
        """Send a Command and return the id that its answer will carry."""

    def answer(self, command_id: str) -> str | None:
        """Return None without an answer, an empty text for an ack, a nack's reason."""


class Phone(Protocol):
    """The phone aboard, by USB or by the network."""

    @property
    def is_plugged(self) -> bool:
        """Return whether its cable is plugged in."""

    def plug(self) -> None:
        """Plug it in: it connects within its own retry time."""

    def unplug(self) -> None:
        """Pull the cable: nothing passes, and neither side is notified."""


class ParticipantError(Exception):
    """A participant cannot start or has ended: the text is for the user, in lines."""

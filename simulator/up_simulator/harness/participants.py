"""The daemon of a flight, in process or as a real program."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol


class ParticipantError(Exception):
    """A participant cannot start or has ended: the text is for the user, in lines."""


class Raspilot(Protocol):
    """The daemon aboard: started, stopped, suspended, killed and started again in flight."""

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

    def freeze(self) -> None:
        """Suspend it: it holds its ports and does nothing, as a hung one."""

    def thaw(self) -> None:
        """Resume it."""

"""The interfaces between an instance and the runner, and the common requirements."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from twisted.internet.defer import Deferred

from up_runner.backoff import RestartPolicy
from up_runner.notification import Notification
from up_runner.process import Identity
from up_runner.record import Record
from up_runner.request import Request


@dataclass(frozen=True, slots=True)
class Policy:
    """The requirements for every instance; times in seconds.

    `exit_delay_s` None: a lost phone never stops it. `always_restart`: it may be in flight, so it
    restarts after any exit status. It is not ready before it has announced its `needed_ports`.
    """

    start_limit_s: float
    watchdog_s: float | None
    exit_delay_s: float | None
    kill_delay_s: float
    restarts: RestartPolicy
    always_restart: bool
    needed_ports: tuple[str, ...] = ()


class Child(Protocol):
    """The process of an instance."""

    pid: int
    identity: Identity
    on_end: Callable[[int | None], None]

    def terminate(self) -> None:
        """Request its end."""

    def kill(self) -> None:
        """Kill it."""

    def close(self) -> None:
        """Stop watching it."""


class Ear(Protocol):
    """Receives the instance's notifications."""

    def drain(self) -> None:
        """Process the waiting notifications now."""

    def close(self, *, remove: bool) -> None:
        """Stop receiving."""


class House(Protocol):
    """The services of the runner for an instance."""

    def prepare(self, request: Request) -> Deferred[tuple[Path, int]]:
        """Return the configuration folder and a descriptor for the log.

        Fails with ConfigurationRefused or OSError.
        """

    def listen(self, name: str, on_notification: Callable[[int, Notification], None]) -> Ear:
        """Receive the instance's notifications; raises OSError."""

    def spawn(self, name: str, config: Path, log: int) -> Child:
        """Start the process and close the log's descriptor; raises OSError."""

    def open_ports(self, pid: int) -> Deferred[frozenset[int] | None]:
        """Return the ports that a process has open, None if they cannot be determined."""

    def last_words(self, name: str) -> Deferred[str | None]:
        """Return the reason for the instance's end, from its log."""

    def save(self, record: Record) -> None:
        """Save the record for the next runner; never raises."""

    def forget(self, name: str) -> None:
        """Remove the record for the next runner; never raises."""

    def on_change(self, name: str) -> None:
        """Handle a new state of an instance."""

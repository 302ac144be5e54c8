"""What an instance asks of those around it, and what is asked of every instance."""

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
    """What is asked of every instance; times in seconds.

    `exit_delay_s` of None: a phone that is gone never stops it. `always_restart`: it may be
    flying, so whatever its exit status it comes back. It is not ready before it has announced its
    `needed_ports`.
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
        """Ask it to end."""

    def kill(self) -> None:
        """End it."""

    def close(self) -> None:
        """Watch it no more."""


class Ear(Protocol):
    """What hears the instance."""

    def drain(self) -> None:
        """Hear now what was said."""

    def close(self, *, remove: bool) -> None:
        """Hear no more."""


class House(Protocol):
    """What an instance asks of the runner."""

    def prepare(self, request: Request) -> Deferred[tuple[Path, int]]:
        """Give the configuration folder and a descriptor for the log.

        Fails with ConfigurationRefused or OSError.
        """

    def listen(self, name: str, on_notification: Callable[[int, Notification], None]) -> Ear:
        """Hear what the instance says; raises OSError."""

    def spawn(self, name: str, config: Path, log: int) -> Child:
        """Start the process and close the log's descriptor; raises OSError."""

    def open_ports(self, pid: int) -> Deferred[frozenset[int] | None]:
        """Give the ports that a process has open, None when they cannot be known."""

    def last_words(self, name: str) -> Deferred[str | None]:
        """Give what the instance's log says of its end."""

    def save(self, record: Record) -> None:
        """Keep what the next runner must know; raises nothing."""

    def forget(self, name: str) -> None:
        """Let the next runner know nothing; raises nothing."""

    def on_change(self, name: str) -> None:
        """Take note that an instance has a new state."""

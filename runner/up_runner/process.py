"""A process that is known by more than its number, whoever its parent is."""

from __future__ import annotations

import contextlib
import os
import select
import signal
import subprocess
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

BOOT_ID = Path("/proc/sys/kernel/random/boot_id")


@dataclass(frozen=True, slots=True)
class Identity:
    """A process of this boot: its number and when it began, in clock ticks since boot.

    Numbers are used again; number and beginning together are not.
    """

    pid: int
    start_ticks: int
    boot_id: str


class ProcessGone(Exception):  # noqa: N818 - an ordinary outcome
    """The process that was asked for does not live any more."""


def identity_of(pid: int) -> Identity:
    """Return who a living process is; raises ProcessGone for a number that nobody lives under."""
    state, ticks, _ = _stat(pid)
    if state in "ZX":
        raise ProcessGone(f"process {pid} has ended")
    return Identity(pid, ticks, boot_id())


def boot_id() -> str:
    """Return the kernel's name for this boot."""
    return BOOT_ID.read_text("ascii").strip()


def sessions_with(variable: str, prefix: str) -> Iterator[tuple[int, str]]:
    """Yield number and value of each session leader whose environment begins `variable` so.

    Only processes that this user may look into are seen.
    """
    wanted = f"{variable}={prefix}".encode()
    for entry in Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        with contextlib.suppress(OSError, ProcessGone):
            pid = int(entry.name)
            for word in (entry / "environ").read_bytes().split(b"\0"):
                if word.startswith(wanted) and _stat(pid)[2] == pid:
                    yield pid, os.fsdecode(word[len(variable) + 1 :])


def _stat(pid: int) -> tuple[str, int, int]:
    """Return state, start in ticks and session of a process. Source: proc_pid_stat(5)."""
    try:
        text = Path(f"/proc/{pid}/stat").read_text("utf-8", "replace")
    except OSError:
        raise ProcessGone(f"there is no process {pid}") from None
    # The name in parentheses may hold anything, parentheses too.
    fields = text[text.rindex(")") + 2 :].split()
    return fields[0], int(fields[19]), int(fields[3])


class Process:
    """One running instance, held by a descriptor that no other process can come to have.

    `on_end` is called once from the reactor with the exit status as `subprocess` counts it, None
    when it is unknown: an earlier runner's child has none for us.
    """

    def __init__(
        self, reactor: Any, identity: Identity, child: subprocess.Popen[bytes] | None
    ) -> None:
        self.identity = identity
        self.pid = identity.pid
        self.on_end: Callable[[int | None], None] = lambda status: None
        self._reactor = reactor
        self._child = child
        try:
            self._descriptor = os.pidfd_open(self.pid)
        except ProcessLookupError:
            raise ProcessGone(f"there is no process {self.pid}") from None
        self._open = True
        reactor.addReader(self)

    @classmethod
    def spawn(
        cls,
        reactor: Any,
        arguments: Sequence[str],
        *,
        cwd: Path,
        environ: Mapping[str, str],
        log: int,
    ) -> Process:
        """Start a program in a session of its own with `log` as output; raises OSError.

        Nothing else is inherited. The call returns when the program was found and begun.
        """
        child = subprocess.Popen(
            arguments,
            cwd=cwd,
            env=environ,
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=log,
            close_fds=True,
            start_new_session=True,
        )
        # Until it is waited for, even a child that ended at once keeps its number.
        return cls(reactor, Identity(child.pid, _stat(child.pid)[1], boot_id()), child)

    @classmethod
    def adopt(cls, reactor: Any, identity: Identity) -> Process:
        """Watch a process that an earlier runner began; raises ProcessGone when it is not there."""
        process = cls(reactor, identity, None)
        # Asked again now that the descriptor holds it: the number may have been used anew.
        try:
            if identity_of(identity.pid) != identity:
                raise ProcessGone(f"process {identity.pid} is another one now")
        except ProcessGone:
            process.close()
            raise
        return process

    def terminate(self) -> None:
        """Ask it to end."""
        self._signal(signal.SIGTERM)

    def kill(self) -> None:
        """End it and everything that it started, without asking."""
        if self._alive():
            self._kill_group()
        self._signal(signal.SIGKILL)

    def close(self) -> None:
        """Watch it no more; it goes on."""
        if self._open:
            self._open = False
            self._reactor.removeReader(self)
            os.close(self._descriptor)

    def fileno(self) -> int:
        """Return the descriptor that becomes readable when the process ends."""
        return self._descriptor if self._open else -1

    def logPrefix(self) -> str:  # noqa: N802 - Twisted's name
        """Return how Twisted calls it."""
        return f"process {self.pid}"

    def doRead(self) -> None:  # noqa: N802 - Twisted's name
        """Note the end of the process."""
        status = None
        if self._child is not None:
            # What it started must not keep its ports; its number is ours until it is waited for.
            self._kill_group()
            status = self._child.wait()
        self.close()
        self.on_end(status)

    def connectionLost(self, reason: object) -> None:  # noqa: N802 - Twisted's name
        """Do nothing: the reactor that stops does not end what it watches."""

    def _alive(self) -> bool:
        if not self._open:
            return False
        poll = select.poll()
        poll.register(self._descriptor, select.POLLIN)
        return not poll.poll(0)

    def _kill_group(self) -> None:
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(self.pid, signal.SIGKILL)

    def _signal(self, number: signal.Signals) -> None:
        if self._open:
            with contextlib.suppress(ProcessLookupError):
                signal.pidfd_send_signal(self._descriptor, number)


def describe_status(status: int | None) -> str:
    """Return in words how a process ended, from what `on_end` was told."""
    if status is None:
        return "ended, unknown how: it was the child of an earlier runner"
    if status >= 0:
        return f"ended with exit status {status}"
    try:
        return f"was ended by {signal.Signals(-status).name}"
    except ValueError:
        return f"was ended by signal {-status}"

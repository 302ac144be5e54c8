"""A process identified by more than its number, whichever process is its parent."""

from __future__ import annotations

import contextlib
import os
import select
import signal
import socket
import subprocess
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import psutil

from up.quick_dataclass import dataclass

BOOT_ID = Path("/proc/sys/kernel/random/boot_id")


@dataclass(frozen=True, slots=True)
class Identity:
    """A process of this boot: its number and start time, in clock ticks since boot.

    Numbers are reused; the pair of number and start time is unique.
    """

    pid: int
    start_ticks: int
    boot_id: str


class ProcessGone(Exception):  # noqa: N818 - a normal outcome
    """The process does not exist any longer."""


def identity_of(pid: int) -> Identity:
    """Return the identity of a living process; raises ProcessGone for an unused number."""
    state, ticks = _stat(pid)
    if state in "ZX":
        raise ProcessGone(f"process {pid} has ended")
    return Identity(pid, ticks, boot_id())


def boot_id() -> str:
    """Return the kernel's id of this boot."""
    return BOOT_ID.read_text("ascii").strip()


def sessions_with(variable: str, prefix: str) -> Iterator[tuple[int, str]]:
    """Yield number and value of each session leader whose `variable` has this prefix.

    Sees only processes that this user may inspect.
    """
    for process in psutil.process_iter():
        with contextlib.suppress(OSError, psutil.Error):
            value = process.environ().get(variable, "")
            if value.startswith(prefix) and os.getsid(process.pid) == process.pid:
                yield process.pid, value


def listening_ports(pid: int) -> frozenset[int] | None:
    """Return the TCP ports that a process listens on and the UDP ports that it has bound.

    None if this user may not inspect the process.
    """
    try:
        process = psutil.Process(pid)
        # The name before psutil 6.
        find = getattr(process, "net_connections", None) or process.connections
        found = find("inet")
    except psutil.Error:
        return None
    is_open = (socket.SOCK_DGRAM, psutil.CONN_NONE), (socket.SOCK_STREAM, psutil.CONN_LISTEN)
    return frozenset(each.laddr.port for each in found if (each.type, each.status) in is_open)


def _stat(pid: int) -> tuple[str, int]:
    """Return state and start in ticks of a process. Source: proc_pid_stat(5)."""
    try:
        text = Path(f"/proc/{pid}/stat").read_text("utf-8", "replace")
    except OSError:
        raise ProcessGone(f"there is no process {pid}") from None
    # The name in parentheses may hold any character, parentheses too.
    fields = text[text.rindex(")") + 2 :].split()
    return fields[0], int(fields[19])


class Process:
    """One running instance, held by a descriptor that cannot refer to another process.

    `on_end` is called once from the reactor with the exit status as `subprocess` counts it, or None
    if it is unknown, as for the child of an earlier runner.
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
        """Start a program in its own session with `log` as output; raises OSError.

        It inherits nothing else. Returns when the program was found and started.
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
        # Until it is reaped, even a child that ended immediately keeps its number.
        return cls(reactor, Identity(child.pid, _stat(child.pid)[1], boot_id()), child)

    @classmethod
    def adopt(cls, reactor: Any, identity: Identity) -> Process:
        """Watch a process of an earlier runner; raises ProcessGone if it does not exist."""
        process = cls(reactor, identity, None)
        # Checked again while the descriptor holds it: the number may have been reused.
        try:
            if identity_of(identity.pid) != identity:
                raise ProcessGone(f"process {identity.pid} is another one now")
        except ProcessGone:
            process.close()
            raise
        return process

    def terminate(self) -> None:
        self._signal(signal.SIGTERM)

    def kill(self) -> None:
        """Kill it and all processes that it started."""
        if self._alive():
            self._kill_group()
        self._signal(signal.SIGKILL)

    def close(self) -> None:
        if self._open:
            self._open = False
            self._reactor.removeReader(self)
            os.close(self._descriptor)

    def fileno(self) -> int:
        return self._descriptor if self._open else -1

    def logPrefix(self) -> str:  # noqa: N802 - Twisted's name
        return f"process {self.pid}"

    def doRead(self) -> None:  # noqa: N802 - Twisted's name
        status = None
        if self._child is not None:
            # Its children must not keep its ports; its number stays ours until it is reaped.
            self._kill_group()
            status = self._child.wait()
        self.close()
        self.on_end(status)

    def connectionLost(self, reason: object) -> None:  # noqa: N802 - Twisted's name
        """Do nothing: a stopping reactor does not end the watched process."""

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
    """Return in words how a process ended, from the status of `on_end`."""
    if status is None:
        return "ended, unknown how: it was the child of an earlier runner"
    if status >= 0:
        return f"ended with exit status {status}"
    try:
        return f"was ended by {signal.Signals(-status).name}"
    except ValueError:
        return f"was ended by signal {-status}"

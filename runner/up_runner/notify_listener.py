"""The notifications of one instance: sd_notify datagrams with two fields of our own."""

from __future__ import annotations

import array
import contextlib
import os
import re
import socket
import struct
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from up.quick_dataclass import dataclass

_CREDENTIALS = struct.Struct("3i")
_MAX_BATCH = 100
MAX_BYTES = 4096
_PORT = re.compile(r"([a-z][a-z0-9_]{0,31}):([1-9][0-9]{0,4})", re.ASCII)
_MAX_PORTS = 16
_FLAGS = {"1": True, "0": False}


@dataclass(frozen=True, slots=True)
class Notification:
    """One datagram; a missing field is None or False.

    `ports` are TCP or UDP ports by purpose, `phone`: the phone is connected, `armed`: the aircraft
    is armed or may be in flight.
    """

    ready: bool = False
    alive: bool = False
    stopping: bool = False
    ports: Mapping[str, int] | None = None
    phone: bool | None = None
    armed: bool | None = None


def parse(datagram: bytes) -> Notification:
    """Parse a datagram; unknown or malformed fields are left out.

    Source: sd_notify(3) for READY, WATCHDOG and STOPPING; X_UP_ begins our additions. Never raises.
    """
    fields: dict[str, str] = {}
    for line in datagram[:MAX_BYTES].decode("utf-8", "replace").split("\n"):
        name, equals, value = line.partition("=")
        if equals:
            fields[name] = value
    return Notification(
        ready=fields.get("READY") == "1",
        alive=fields.get("WATCHDOG") == "1",
        stopping=fields.get("STOPPING") == "1",
        ports=_ports(fields.get("X_UP_PORTS")),
        phone=_FLAGS.get(fields.get("X_UP_PHONE", "")),
        armed=_FLAGS.get(fields.get("X_UP_ARMED", "")),
    )


def _ports(text: str | None) -> dict[str, int] | None:
    if text is None:
        return None
    ports: dict[str, int] = {}
    for word in text.split():
        match = _PORT.fullmatch(word)
        if match is None or int(match[2]) > 65535 or len(ports) == _MAX_PORTS:
            return None
        ports[match[1]] = int(match[2])
    return ports


class NotifyListener:
    """Receives an instance's datagrams and passes them to `on_notification` with the sender's pid.

    The kernel authenticates the sender. A new socket at the same path takes over: an instance sends
    to the path and does not notice a restarted runner.
    """

    def __init__(
        self, reactor: Any, path: Path, on_notification: Callable[[int, Notification], None]
    ) -> None:
        self.path = path
        self._reactor = reactor
        self._on_notification = on_notification
        self._socket: socket.socket | None = None

    def open(self) -> None:
        """Bind the path, replacing an old socket; raises OSError."""
        line = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM | socket.SOCK_NONBLOCK)
        try:
            # Set before the bind, so that every datagram has its sender.
            line.setsockopt(socket.SOL_SOCKET, socket.SO_PASSCRED, 1)
            self.path.unlink(missing_ok=True)
            line.bind(str(self.path))
            self.path.chmod(0o600)
        except OSError:
            line.close()
            raise
        self._socket = line
        self._reactor.addReader(self)

    def close(self, *, remove: bool) -> None:
        """Stop receiving; the path stays for the next runner unless `remove`."""
        line, self._socket = self._socket, None
        if line is None:
            return
        self._reactor.removeReader(self)
        line.close()
        if remove:
            with contextlib.suppress(OSError):
                self.path.unlink()

    def drain(self) -> None:
        """Process the waiting datagrams; called before an instance counts as silent."""
        for _ in range(_MAX_BATCH):
            if self._socket is None or not self._receive(self._socket):
                return

    def fileno(self) -> int:
        return -1 if self._socket is None else self._socket.fileno()

    def logPrefix(self) -> str:  # noqa: N802 - Twisted's name
        return f"notify {self.path.parent.name}"

    def doRead(self) -> None:  # noqa: N802 - Twisted's name
        self.drain()

    def connectionLost(self, reason: object) -> None:  # noqa: N802 - Twisted's name
        """Do nothing: a datagram socket has no connection; `close` ends it."""

    def _receive(self, line: socket.socket) -> bool:
        room = socket.CMSG_SPACE(_CREDENTIALS.size) + socket.CMSG_SPACE(64)
        try:
            data, extra, flags, _ = line.recvmsg(MAX_BYTES, room, socket.MSG_CMSG_CLOEXEC)
        except OSError:
            return False
        pid = _sender(extra)
        if pid is not None and not flags & socket.MSG_TRUNC:
            self._on_notification(pid, parse(data))
        return True


def _sender(extra: list[tuple[int, int, bytes]]) -> int | None:
    pid: int | None = None
    for level, kind, data in extra:
        if level != socket.SOL_SOCKET:
            continue
        if kind == socket.SCM_CREDENTIALS:
            pid = _CREDENTIALS.unpack(data)[0]
        elif kind == socket.SCM_RIGHTS:
            # Received descriptors are unwanted; kept, they would use up ours.
            descriptors = array.array("i")
            descriptors.frombytes(data[: len(data) // 4 * 4])
            for descriptor in descriptors:
                os.close(descriptor)
    return pid

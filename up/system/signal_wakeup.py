"""Wakes the reactor on a signal, wherever the process was when it arrived."""

import signal
import socket
from typing import Any

from twisted.internet.interfaces import IReadDescriptor
from zope.interface import implementer

_AT_ONCE = 4096


@implementer(IReadDescriptor)
class SignalWakeup:
    """Ends the reactor's wait when a signal arrives.

    Python runs a handler only between two instructions: without this, a signal that another thread
    receives, or that arrives just before the wait, would be handled only at the next timer.
    """

    def __init__(self, reactor: Any) -> None:
        self._reactor = reactor
        self._reader, self._writer = socket.socketpair()
        self._reader.setblocking(False)
        self._writer.setblocking(False)

    def start(self) -> None:
        signal.set_wakeup_fd(self._writer.fileno(), warn_on_full_buffer=False)
        self._reactor.addReader(self)

    def fileno(self) -> int:
        return self._reader.fileno()

    def doRead(self) -> None:  # noqa: N802 - Twisted's name
        self._reader.recv(_AT_ONCE)

    def connectionLost(self, reason: object) -> None:  # noqa: N802 - Twisted's name
        signal.set_wakeup_fd(-1)
        self._reader.close()
        self._writer.close()

    def logPrefix(self) -> str:  # noqa: N802 - Twisted's name
        return "signals"

"""One ground station's connection to the aircraft itself."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from up.protocols.general_message_link import GeneralMessageProtocol
from up.protocols.proxy_lines import (
    HELLO_MAX_BYTES,
    PREFIX,
    Accepted,
    Hello,
    HelloError,
    Refused,
    Side,
    parse_hello,
)
from up.system.clock import Clock

SILENCE_S = 1.0
"""A station that sends nothing for this long is a legacy client: it sends no hello."""


class GroundConnection(GeneralMessageProtocol):
    """General Messages; a hello, as to a proxy, gets the answer of a proxy.

    ``on_hello`` gets the connection and its hello and returns the answer. Later lines that begin
    with ``UP1`` are control lines of a proxy and are ignored.
    """

    def __init__(
        self,
        clock: Clock,
        *,
        on_hello: Callable[[GroundConnection, Hello], Accepted],
        **callbacks: Any,
    ) -> None:
        super().__init__(clock, **callbacks)
        self.token: str | None = None
        self._on_hello = on_hello
        self._first: bytes | None = b""
        self._made_s = clock.seconds()

    @property
    def is_known(self) -> bool:
        """Return whether the handshake is over: before, nothing may be sent to the station.

        A station expects the answer to its hello first, as from a proxy.
        """
        return self._first is None or self._clock.seconds() - self._made_s >= SILENCE_S

    @property
    def last_rx_s(self) -> float:
        """The clock's time of the station's newest byte."""
        return self.heard_s

    def dataReceived(self, data: bytes) -> None:  # noqa: N802 - Twisted's name
        """Take a hello if the first line is one, then messages."""
        if self._first is None:
            super().dataReceived(data)
            return
        first = self._first + data
        line, ended, rest = first.partition(b"\n")
        if line[: len(PREFIX)] != PREFIX[: len(line)] or len(line) > HELLO_MAX_BYTES:
            self._first = None
            super().dataReceived(first)
            return
        self._heard_s = self._clock.seconds()
        self._first = None if ended else first
        if not ended:
            return
        try:
            self.send(self._on_hello(self, parse_hello(line, Side.GROUND)).encode())
        except HelloError as error:
            self.send(Refused(error.code, error.reason).encode())
            self.close()
        else:
            if rest:
                super().dataReceived(rest)

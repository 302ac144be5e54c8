"""One ground station's connection to the aircraft itself."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

from mission_control_cog.hello import HELLO_MAX_BYTES, PREFIX
from up.protocols.general_message_link import GeneralMessageProtocol
from up.system.clock import Clock

SILENT_S = 1.0
"""A station that sends nothing for this long sends no hello."""
_WORD = re.compile(rb" (seat|token)=([a-z0-9]{1,64})(?= |$)")


class GroundConnection(GeneralMessageProtocol):
    """General Messages; a hello, as to a proxy, gets the answer of a proxy.

    ``on_hello`` gets the connection, whether it requests control, and its token, and returns the
    answer. Later lines that begin with ``UP1`` are control lines of a proxy and are ignored.
    """

    def __init__(
        self,
        clock: Clock,
        *,
        on_hello: Callable[[GroundConnection, bool, str], bytes],
        **callbacks: Any,
    ) -> None:
        super().__init__(clock, **callbacks)
        self.token = ""
        self._on_hello = on_hello
        self._first: bytes | None = b""
        self._made_s = clock.seconds()

    @property
    def is_known(self) -> bool:
        """Return whether the handshake is over: before, nothing may be sent to the station.

        A station expects the answer to its hello first, as from a proxy.
        """
        return self._first is None or self._clock.seconds() - self._made_s >= SILENT_S

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
        elif not ended:
            self._heard_s = self._clock.seconds()
            self._first = first
        else:
            self._first = None
            self._heard_s = self._clock.seconds()
            words = dict(_WORD.findall(line.removesuffix(b"\r")))
            wants_seat = words.get(b"seat") != b"listen"
            self.send(self._on_hello(self, wants_seat, words.get(b"token", b"").decode("ascii")))
            if rest:
                super().dataReceived(rest)

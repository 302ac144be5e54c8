"""The socket options that decide when a simulated connection counts as lost."""

from __future__ import annotations

import socket
import struct

_RTT_OFFSET = 68
_TCP = socket.IPPROTO_TCP


class SocketOptions:
    """Takes socket options from programs; unknown options have no effect."""

    def __init__(self) -> None:
        self.keeps_alive = False
        self.has_no_delay = False
        self.round_trip_s = 0.0
        self._values: dict[tuple[int, int], int] = {}

    @property
    def user_timeout_s(self) -> float:
        """Return how long bytes may stay unacknowledged; 0: as long as TCP tries."""
        return self._values.get((_TCP, socket.TCP_USER_TIMEOUT), 0) / 1000

    @property
    def keepalive(self) -> tuple[float, float, int]:
        """Return the idle time before a probe, the probe interval, and the number of probes."""
        values = self._values
        return (
            float(values.get((_TCP, socket.TCP_KEEPIDLE), 7200)),
            float(values.get((_TCP, socket.TCP_KEEPINTVL), 75)),
            values.get((_TCP, socket.TCP_KEEPCNT), 9),
        )

    def setsockopt(self, level: int, option: int, value: int | bytes) -> None:
        """Set an option, as of a socket."""
        number = value if isinstance(value, int) else int.from_bytes(value[:4], "little")
        self._values[level, option] = number
        if (level, option) == (socket.SOL_SOCKET, socket.SO_KEEPALIVE):
            self.keeps_alive = bool(number)

    def getsockopt(self, level: int, option: int, size: int = 0) -> int | bytes:
        """Return an option, as of a socket: of TCP_INFO the round trip is known."""
        if (level, option) == (_TCP, socket.TCP_INFO):
            info = bytearray(max(size, _RTT_OFFSET + 4))
            struct.pack_into("=I", info, _RTT_OFFSET, round(self.round_trip_s * 1e6))
            return bytes(info[:size])
        value = self._values.get((level, option), 0)
        return value.to_bytes(size, "little") if size else value

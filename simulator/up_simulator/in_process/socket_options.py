"""The options of a socket in memory: keepalive, user timeout, and the measured round trip."""

import socket
import struct

GIVE_UP_S = 924.0
"""Without a user timeout (Linux: 15 retries)."""
_RTT_OFFSET = 68
_TCP = socket.IPPROTO_TCP


class SocketOptions:
    """Takes socket options from programs; unknown options have no effect."""

    def __init__(self) -> None:
        self.round_trip_s = 0.0
        self._values: dict[tuple[int, int], int] = {}

    @property
    def give_up_s(self) -> float:
        """Return how long bytes may stay unacknowledged."""
        return self.user_timeout_s or GIVE_UP_S

    @property
    def user_timeout_s(self) -> float:
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

    def setsockopt(self, level: int, option: int, value: int) -> None:
        self._values[level, option] = value

    def getsockopt(self, level: int, option: int, size: int = 0) -> int | bytes:
        """Return an option, as of a socket: of TCP_INFO the round trip is known."""
        if (level, option) == (_TCP, socket.TCP_INFO):
            info = bytearray(max(size, _RTT_OFFSET + 4))
            struct.pack_into("=I", info, _RTT_OFFSET, round(self.round_trip_s * 1e6))
            return bytes(info[:size])
        return self._values.get((level, option), 0)

"""The options of a socket in memory: the user timeout is the one that acts."""

import socket

GIVE_UP_S = 924.0
"""Without a user timeout (Linux: 15 retries)."""


class SocketOptions:
    """Takes socket options from programs; unknown options have no effect."""

    def __init__(self) -> None:
        self._values: dict[tuple[int, int], int] = {}

    @property
    def give_up_s(self) -> float:
        """Return how long bytes may stay unacknowledged."""
        user_timeout_ms = self._values.get((socket.IPPROTO_TCP, socket.TCP_USER_TIMEOUT), 0)
        return user_timeout_ms / 1000 or GIVE_UP_S

    def setsockopt(self, level: int, option: int, value: int) -> None:
        self._values[level, option] = value

    def getsockopt(self, level: int, option: int, size: int = 0) -> int | bytes:
        """Return an option, as of a socket; TCP_INFO is unknown, and all zeros."""
        return bytes(size) if size else self._values.get((level, option), 0)

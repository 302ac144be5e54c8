"""Opens a TCP port and the UDP port of the same number."""

from typing import Any

from twisted.internet.defer import maybeDeferred
from twisted.internet.error import CannotListenError

from up.base_started_module import StartFailedError
from up.system.udp import listen_udp

_TRIES = 16
_BACKLOG = 16


class Ports:
    """The ports that a module opened, to be closed together."""

    def __init__(self, reactor: Any, address: str) -> None:
        self._reactor = reactor
        self._address = address
        self._open: list[Any] = []

    def open(self, number: int, key: str, factory: Any, datagrams: Any = None) -> int:
        """Listen on TCP and, if ``datagrams`` is given, on UDP; return the number.

        0 selects a number that is free for both. Raises StartFailedError naming the port and the
        configuration ``key``.
        """
        for remaining in reversed(range(_TRIES if number == 0 and datagrams else 1)):
            try:
                return self._open_pair(number, factory, datagrams)
            except CannotListenError as error:
                if not remaining:
                    reason = getattr(error.socketError, "strerror", None) or error.socketError
                    raise StartFailedError(
                        f"port {error.port} cannot be opened: {reason} ({key})"
                    ) from error
        raise AssertionError("the loop ends by return or raise")

    def _open_pair(self, number: int, factory: Any, datagrams: Any) -> int:
        listen = self._reactor.listenTCP
        stream = listen(number, factory, backlog=_BACKLOG, interface=self._address)
        bound: int = stream.getHost().port
        if datagrams is not None:
            try:
                packets = listen_udp(self._reactor, bound, datagrams, self._address)
            except CannotListenError:
                stream.stopListening()
                raise
            self._open.append(packets)
        self._open.append(stream)
        return bound

    @property
    def are_open(self) -> bool:
        return bool(self._open)

    async def close(self) -> None:
        """Close the open ports; idempotent."""
        closing, self._open = self._open, []
        for done in [maybeDeferred(port.stopListening) for port in closing]:
            await done

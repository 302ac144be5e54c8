"""The addresses of a configured host."""

import socket
import threading
from collections.abc import Callable
from ipaddress import ip_address
from typing import Any

from twisted.internet.defer import Deferred

from up.system.clock import cancel

LOOK_UP_LIMIT_S = 5.0
LookUp = Callable[[str, int], list[str]]


class HostNotFoundError(Exception):
    """No address of a host is known; the text is one sentence."""


def look_up(host: str, port: int) -> list[str]:
    """Return a name's addresses, blocking; raises OSError."""
    found = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)
    return list(dict.fromkeys(str(entry[4][0]) for entry in found))


class HostAddresses:
    """Selects the next address of a host to try.

    Resolves names again for every attempt, in a daemon thread: a resolver that does not answer
    delays neither the reactor nor the end of the program, and once an address is known no attempt
    waits for the resolver either.
    """

    def __init__(self, reactor: Any, host: str, port: int, look_up: LookUp = look_up) -> None:
        self._reactor = reactor
        self._host = host
        self._port = port
        self._look_up = look_up
        self._is_literal = _is_literal(host)
        self._known: list[str] = [host] if self._is_literal else []
        self._is_looking = False
        self._waiting: list[Deferred[None]] = []
        self._problem = ""

    async def next(self) -> str:
        """Return the address to try; raises HostNotFoundError if none is known after 5 s."""
        if not self._is_literal:
            self._begin_look_up()
            if not self._known:
                await self._found()
        if not self._known:
            raise HostNotFoundError(self._problem or "its name is not answered for")
        return self._known[0]

    def failed(self, address: str) -> None:
        if address in self._known:
            self._known.remove(address)
            self._known.append(address)

    def _begin_look_up(self) -> None:
        if self._is_looking:
            return
        self._is_looking = True
        thread = threading.Thread(
            target=self._look_up_in_thread, name=f"look up {self._host}", daemon=True
        )
        thread.start()

    def _look_up_in_thread(self) -> None:
        try:
            found, problem = self._look_up(self._host, self._port), ""
        except (OSError, UnicodeError) as error:
            found, problem = [], getattr(error, "strerror", None) or str(error)
        self._reactor.callFromThread(self._looked_up, found, problem)

    def _looked_up(self, found: list[str], problem: str) -> None:
        self._is_looking = False
        self._problem = problem
        if found:
            # A working address stays the first choice while the name resolves to it.
            known = [address for address in self._known if address in found]
            self._known = known + [address for address in found if address not in known]
        waiting, self._waiting = self._waiting, []
        for done in waiting:
            if not done.called:
                done.callback(None)

    async def _found(self) -> None:
        done: Deferred[None] = Deferred()
        self._waiting.append(done)
        limit = self._reactor.callLater(LOOK_UP_LIMIT_S, done.callback, None)
        try:
            await done
        finally:
            cancel(limit)


def _is_literal(host: str) -> bool:
    try:
        ip_address(host.partition("%")[0])
    except ValueError:
        return False
    return True

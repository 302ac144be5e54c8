"""Opens UDP ports without leaving a socket behind."""

from __future__ import annotations

import socket
from typing import Any

from twisted.internet.error import CannotListenError


def listen_udp(reactor: Any, number: int, protocol: Any, address: str = "") -> Any:
    """Listen on a UDP port and return it; raises CannotListenError.

    Twisted's own ``listenUDP`` leaves the socket of a refused bind to the garbage collector. A
    reactor that adopts no sockets has none, as a simulated one: there ``listenUDP`` does.
    """
    if not hasattr(reactor, "adoptDatagramPort"):
        return reactor.listenUDP(number, protocol, interface=address)
    family = socket.AF_INET6 if ":" in address else socket.AF_INET
    with socket.socket(family, socket.SOCK_DGRAM) as opened:
        opened.setblocking(False)
        try:
            opened.bind((address, number))
        except OSError as error:
            raise CannotListenError(address, number, error) from error
        return reactor.adoptDatagramPort(opened.fileno(), family, protocol)

"""Opens UDP ports without leaking sockets."""

import socket
from typing import Any

from twisted.internet.error import CannotListenError
from twisted.internet.udp import Port
from twisted.logger import Logger

MAX_DATAGRAMS_PER_TURN = 64


class _FairPort(Port):
    """Returns to the reactor after `MAX_DATAGRAMS_PER_TURN`.

    Twisted's port reads 256 KiB per turn: thousands of short datagrams, and an unlimited number of
    empty ones.
    """

    log = Logger()

    def doRead(self) -> None:  # noqa: N802 - Twisted's name
        for _ in range(MAX_DATAGRAMS_PER_TURN):
            try:
                datagram, address = self.socket.recvfrom(self.maxPacketSize)
            except (BlockingIOError, InterruptedError, ConnectionRefusedError):
                return
            try:
                self.protocol.datagramReceived(datagram, address[:2])
            except Exception:  # noqa: BLE001 - as in Twisted's port: a fault costs one datagram
                self.log.failure("a datagram could not be handled", code="datagram_failed")


def listen_udp(reactor: Any, number: int, protocol: Any, address: str = "") -> Any:
    """Listen on a UDP port and return it; raises CannotListenError.

    Twisted's own ``listenUDP`` leaves the socket of a refused bind to the garbage collector. For
    a reactor that cannot adopt sockets, such as a simulated one, ``listenUDP`` is used.
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
        adopt: Any = _FairPort._fromListeningDescriptor
        port = adopt(reactor, opened.fileno(), family, protocol, maxPacketSize=8192)
    port.startListening()
    return port

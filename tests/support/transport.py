"""A TCP connection without a socket, for rules about time."""

# ruff: noqa: N802 - Twisted's names

from twisted.internet.address import IPv4Address
from twisted.internet.testing import StringTransport


class Transport(StringTransport):
    """The peer is ``host``; socket options have no effect."""

    def __init__(self, host, port=5000):
        super().__init__(peerAddress=IPv4Address("TCP", host, port))

    def setTcpNoDelay(self, enabled):
        """Do nothing."""

    def setTcpKeepAlive(self, enabled):
        """Do nothing."""

    def getHandle(self):
        return self

    def setsockopt(self, *option):
        """Do nothing."""

"""Socket options that detect a lost peer quickly."""

import contextlib
import socket
import struct
from typing import Any

from twisted.internet.error import ConnectionAborted, ConnectionDone
from twisted.python.failure import Failure

from up.quick_dataclass import dataclass
from up.tls.errors import TLSError

KEEPALIVE_IDLE_S = 3
KEEPALIVE_INTERVAL_S = 1
KEEPALIVE_PROBES = 3
_TCPI_RETRANSMITS = 2
_TCPI_TRAFFIC = struct.Struct("=128x QII 56x Q")
"""Bytes received, segments sent and received, bytes sent with repetitions (Linux 4.19)."""
_TCPI_ANSWER = struct.Struct("=24x I 28x I 8x I")
"""Unacknowledged segments, ms since the newest acknowledgement, smoothed round trip in us."""
HEADER_BYTES, HEADER_BYTES_IP6 = 52, 72
"""IP and TCP headers of a segment, with the time stamps that every Linux peer sends."""
UNSENT_LIMIT = 4096
"""Bytes that the kernel takes beyond what it can send; the rest waits where it can be replaced."""


def watch_peer(transport: Any, user_timeout_ms: int) -> None:
    """Disable Nagle, probe a silent peer, buffer little, and give up on unacknowledged bytes.

    Without a user timeout (0) TCP continues for minutes after a gap and then delivers stale data.
    """
    transport.setTcpNoDelay(True)
    transport.setTcpKeepAlive(True)
    set_option(transport, "TCP_KEEPIDLE", KEEPALIVE_IDLE_S)
    set_option(transport, "TCP_KEEPINTVL", KEEPALIVE_INTERVAL_S)
    set_option(transport, "TCP_KEEPCNT", KEEPALIVE_PROBES)
    set_option(transport, "TCP_NOTSENT_LOWAT", UNSENT_LIMIT)
    set_option(transport, "TCP_USER_TIMEOUT", user_timeout_ms)


def set_option(transport: Any, name: str, value: int) -> None:
    """Set a TCP option by name if the platform has it."""
    option = getattr(socket, name, None)
    if option is not None:
        # The socket of a peer that has already gone accepts no options.
        with contextlib.suppress(OSError):
            transport.getHandle().setsockopt(socket.IPPROTO_TCP, option, value)


def is_stalled(transport: Any) -> bool:
    """Return whether the kernel is retransmitting bytes that the peer has not acknowledged."""
    # Absent: another platform, or a transport without a socket.
    with contextlib.suppress(OSError, AttributeError):
        info = transport.getHandle().getsockopt(socket.IPPROTO_TCP, socket.TCP_INFO, 3)
        return bool(info[_TCPI_RETRANSMITS])
    return False


def ip_bytes(transport: Any) -> int | None:
    """Return what a connection has cost in both directions with headers; None: not known."""
    with contextlib.suppress(OSError, AttributeError, struct.error):
        size = _TCPI_TRAFFIC.size
        info = transport.getHandle().getsockopt(socket.IPPROTO_TCP, socket.TCP_INFO, size)
        received, out, into, sent = _TCPI_TRAFFIC.unpack(info)
        is_ip6 = ":" in transport.getPeer().host
        return int(sent + received + (out + into) * (HEADER_BYTES_IP6 if is_ip6 else HEADER_BYTES))
    return None


@dataclass(frozen=True, slots=True)
class Answered:
    """What a connection's peer has acknowledged."""

    is_awaited: bool
    """Whether sent bytes are not acknowledged yet."""
    age_s: float
    """Time since the newest acknowledgement."""
    round_trip_s: float


def answered(transport: Any) -> Answered | None:
    """Return what the kernel knows of the peer's acknowledgements; None: not known."""
    with contextlib.suppress(OSError, AttributeError, struct.error):
        info = transport.getHandle().getsockopt(
            socket.IPPROTO_TCP, socket.TCP_INFO, _TCPI_ANSWER.size
        )
        waiting, age_ms, trip_us = _TCPI_ANSWER.unpack(info)
        return Answered(bool(waiting), age_ms / 1e3, trip_us / 1e6)
    return None


def why_lost(reason: Failure) -> str:
    """Return in a few words why a connection ended; Twisted's own texts are for programmers."""
    if reason.check(ConnectionDone):
        return "closed"
    if reason.check(ConnectionAborted):
        return "cut off by this side"
    if reason.check(TLSError):
        return str(reason.value)
    return "the connection broke"

"""A listening socket for many peers with short messages."""

import os
import socket

LISTEN_BACKLOG = 1024
SEND_BUFFER_BYTES = 65536
"""Small on purpose: data that the kernel buffers for a slow peer are stale on arrival."""
KEEPALIVE_IDLE_S = 5
KEEPALIVE_INTERVAL_S = 2
KEEPALIVE_PROBES = 3


class StartError(Exception):
    """The proxy cannot start: a code, one sentence and the exit status of the program."""

    def __init__(self, code: str, reason: str, status: int = 1) -> None:
        super().__init__(reason)
        self.code = code
        self.status = status


def cannot_listen(label: str, port: int, error: OSError) -> StartError:
    """Return the error of a port that cannot be opened."""
    reason = os.strerror(error.errno) if error.errno else str(error)
    return StartError("cannot_listen", f"cannot listen on {label} {port}: {reason.lower()}")


def listen(label: str, address: str, port: int, user_timeout_ms: int) -> socket.socket:
    """Return a listening, non-blocking TCP socket; accepted sockets inherit its options.

    An empty address listens on every interface, IPv4 and IPv6. `user_timeout_ms` bounds how long
    sent data may stay unacknowledged (RFC 5482). Raises StartError.
    """
    family, host = _family(address)
    listener = socket.socket(family, socket.SOCK_STREAM | socket.SOCK_NONBLOCK)
    try:
        if family == socket.AF_INET6:
            only = 0 if not address else 1
            listener.setsockopt(socket.IPPROTO_IPV6, socket.IPV6_V6ONLY, only)
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE, 1)
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, SEND_BUFFER_BYTES)
        for option, value in (
            (socket.TCP_NODELAY, 1),
            (socket.TCP_KEEPIDLE, KEEPALIVE_IDLE_S),
            (socket.TCP_KEEPINTVL, KEEPALIVE_INTERVAL_S),
            (socket.TCP_KEEPCNT, KEEPALIVE_PROBES),
            (socket.TCP_USER_TIMEOUT, user_timeout_ms),
        ):
            listener.setsockopt(socket.IPPROTO_TCP, option, value)
        listener.bind((host, port))
        listener.listen(LISTEN_BACKLOG)
    except OSError as error:
        listener.close()
        raise cannot_listen(label, port, error) from None
    return listener


def _family(address: str) -> tuple[socket.AddressFamily, str]:
    if address:
        return (socket.AF_INET6 if ":" in address else socket.AF_INET), address
    if socket.has_dualstack_ipv6():
        return socket.AF_INET6, "::"
    return socket.AF_INET, "0.0.0.0"

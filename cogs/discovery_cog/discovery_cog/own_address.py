"""The address of this machine at which a peer can reach it."""

from __future__ import annotations

import socket


def own_address_towards(host: str, port: int) -> str | None:
    """Return our IPv4 address on the route to a peer, or None without a route.

    A connected UDP socket asks the routing table; nothing is sent.
    """
    try:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            probe.connect((host, port))
            address: str = probe.getsockname()[0]
            return address
    except OSError:
        return None

"""Which of this machine's addresses a peer can reach it by."""

from __future__ import annotations

import socket


def own_address_towards(host: str, port: int) -> str | None:
    """Return our IPv4 address on the way to a peer; None: there is no way.

    A connected UDP socket asks the routing table; nothing is sent.
    """
    try:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            probe.connect((host, port))
            address: str = probe.getsockname()[0]
            return address
    except OSError:
        return None

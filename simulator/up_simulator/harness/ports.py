"""The ports of real programs that run together on this machine."""

from __future__ import annotations

import random
import socket
from dataclasses import astuple, dataclass

_TRIES = 20
_FIRST, _LAST = 20_000, 32_767
"""Below the ephemeral ports of systems (Linux: from 32768), which another program could get by
chance before the intended one."""
_random = random.SystemRandom()


@dataclass(frozen=True, slots=True)
class Ports:
    """The TCP ports of a run."""

    airborne: int = 3003
    ground: int = 3004
    orientation: int = 50000
    general: int = 50001
    discovery: int = 3001
    metrics: int = 9303
    uplink: int = 3005
    page: int = 8080
    mavlink: int = 5760


def choose_ports(any_ports: bool = False) -> Ports:
    """Return the usual ports where they are free, any free ones where not; raises OSError."""
    return _choose(1, any_ports)[0]


def choose_port_sets(count: int) -> tuple[Ports, ...]:
    """Return this many sets of free ports, all of them different; raises OSError."""
    return _choose(count, True)


def _choose(count: int, any_ports: bool) -> tuple[Ports, ...]:
    held: list[socket.socket] = []
    try:
        return tuple(
            Ports(*(_free_port(port, any_ports, held) for port in astuple(Ports())))
            for _ in range(count)
        )
    finally:
        for each in held:
            each.close()


def _free_port(wanted: int, any_port: bool, held: list[socket.socket]) -> int:
    """Return a port that is free for TCP and for UDP, and hold it until all are chosen."""
    chosen = [_random.randint(_FIRST, _LAST) for _ in range(_TRIES)]
    for port in chosen if any_port else (wanted, *chosen):
        stream, datagrams = socket.socket(), socket.socket(type=socket.SOCK_DGRAM)
        held += [stream, datagrams]
        stream.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            stream.bind(("", port))
            datagrams.bind(("", port))
        except OSError:
            continue
        return port
    raise OSError("no port is free")

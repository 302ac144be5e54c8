"""Where the server listens, and under which addresses it is found there."""

from __future__ import annotations

import socket
from dataclasses import dataclass
from ipaddress import ip_address

import psutil

from up.system.addresses import is_wildcard


@dataclass(frozen=True, slots=True)
class ListenAddress:
    """An address of this machine and a port; the address is literal, empty: every interface."""

    host: str
    port: int

    @property
    def is_loopback(self) -> bool:
        """Return whether only users of this machine reach it."""
        return not is_wildcard(self.host) and ip_address(self.host).is_loopback

    def urls(self, port: int, scheme: str) -> list[str]:
        """Return the URL for a browser; ``port`` is the one that was opened in the end."""
        hosts = _own_addresses(":" in self.host) if is_wildcard(self.host) else [self.host]
        return [f"{scheme}://{authority(host, port)}/" for host in hosts]


def authority(host: str, port: int) -> str:
    """Return host and port as an address of the web has them."""
    return f"[{host}]:{port}" if ":" in host else f"{host}:{port}"


def parse_listen(text: str) -> ListenAddress:
    """Parse ``ADDRESS:PORT``; raises ValueError with a sentence.

    ``localhost`` is the loopback address, ``*`` or nothing before the colon every interface.
    """
    host, colon, port_text = text.rpartition(":")
    is_port = port_text.isascii() and port_text.isdigit() and len(port_text) < 6
    if not colon or not is_port or int(port_text) > 65535:
        raise ValueError(f"{text!r} is not ADDRESS:PORT, such as 127.0.0.1:8080 or 0.0.0.0:8080")
    if host.startswith("[") and host.endswith("]"):
        host = host[1:-1]
    host = {"localhost": "127.0.0.1", "*": ""}.get(host, host)
    try:
        is_wildcard(host)
    except ValueError:
        raise ValueError(
            f"{host!r} is not a literal address of this machine, such as 127.0.0.1 or 0.0.0.0"
        ) from None
    return ListenAddress(host, int(port_text))


def _own_addresses(with_ipv6: bool) -> list[str]:
    """Return the addresses that others on the network reach, then the loopback one."""
    found = []
    for addresses in psutil.net_if_addrs().values():
        for each in addresses:
            if each.family == socket.AF_INET or (with_ipv6 and each.family == socket.AF_INET6):
                address = ip_address(each.address.partition("%")[0])
                if not address.is_loopback and not address.is_link_local:
                    found.append(str(address))
    return [*sorted(set(found)), "127.0.0.1"]

"""Network addresses that may be trusted with plain, unauthenticated traffic."""

from functools import lru_cache
from ipaddress import IPv4Address, IPv6Address, ip_address, ip_network

PRIVATE_NETWORKS = tuple(
    ip_network(text)
    for text in (
        "127.0.0.0/8",  # loopback
        "10.0.0.0/8",  # RFC 1918
        "172.16.0.0/12",
        "192.168.0.0/16",
        "169.254.0.0/16",  # link local, RFC 3927
        "100.64.0.0/10",  # carrier-grade NAT, RFC 6598
        "::1/128",
        "fe80::/10",  # link local
        "fc00::/7",  # unique local, RFC 4193
    )
)


def _parsed(host: str) -> IPv4Address | IPv6Address:
    address = ip_address(host.partition("%")[0])
    if isinstance(address, IPv6Address) and address.ipv4_mapped is not None:
        return address.ipv4_mapped
    return address


@lru_cache(maxsize=4096)
def is_private(host: str) -> bool:
    """Return whether a literal address is loopback, private, link local, ULA or carrier-grade NAT.

    A wildcard such as 0.0.0.0 is not private (unlike in Python's `ipaddress`): it stands for every
    address. An IPv4 address inside IPv6 is judged as IPv4; a scope (`%eth0`) is ignored. Raises
    ValueError when `host` is not a literal address.
    """
    address = _parsed(host)
    return any(
        address in network for network in PRIVATE_NETWORKS if network.version == address.version
    )


def stays_here(host: str) -> bool:
    """Return whether a host, a name or a literal address, is certainly this machine."""
    try:
        return host == "localhost" or _parsed(host).is_loopback
    except ValueError:
        return False


def is_wildcard(host: str) -> bool:
    """Return whether a listener on `host` listens on every interface: empty, 0.0.0.0 or ::.

    Raises ValueError when `host` is neither empty nor a literal address.
    """
    return not host or _parsed(host).is_unspecified


def plain(host: str) -> str:
    """Return the display form of the address: without scope, IPv4 inside IPv6 as IPv4."""
    return str(_parsed(host))


def neighbourhood(host: str) -> str:
    """Return the unit counted as one source: an IPv4 address, or the /64 network of an IPv6 one."""
    address = _parsed(host)
    if isinstance(address, IPv4Address):
        return str(address)
    return str(ip_network((int(address) >> 64 << 64, 64)))

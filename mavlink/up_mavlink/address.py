"""Where an endpoint is: the notation of MAVProxy and MAVSDK."""

from __future__ import annotations

from dataclasses import dataclass

from up.system.addresses import is_wildcard, stays_here

UDP_SERVER, UDP_CLIENT, TCP_SERVER, SERIAL = KINDS = ("udpin", "udpout", "tcpin", "serial")
DEFAULT_BAUD = 57600
FORMS = "udpin:ADDRESS:PORT, udpout:ADDRESS:PORT, tcpin:ADDRESS:PORT or serial:/dev/NAME[:BAUD]"


@dataclass(frozen=True, slots=True)
class Address:
    """One endpoint: ``host`` is a literal address or the path of a device, ``port`` its number.

    The number of a serial device is its baud rate.
    """

    kind: str
    host: str
    port: int

    @property
    def stays_here(self) -> bool:
        """Return whether only programs of this machine reach the endpoint."""
        return self.kind != SERIAL and stays_here(self.host)

    def __str__(self) -> str:
        host = f"[{self.host}]" if ":" in self.host else self.host
        return f"{self.kind}:{host}:{self.port}"


def read_address(text: str) -> Address:
    """Return the address in a text; raises ValueError with one sentence."""
    kind, _, rest = text.partition(":")
    if kind not in KINDS:
        raise ValueError(f"must be {FORMS}, not {text[:80]!r}")
    if kind == SERIAL:
        path, colon, baud = rest.rpartition(":")
        path, baud = (path, baud) if colon else (rest, str(DEFAULT_BAUD))
        if not path.startswith("/"):
            raise ValueError(f"must name a device by its absolute path, not {path[:80]!r}")
        return Address(kind, path, _number(baud, 4_000_000))
    host, _, port = rest.rpartition(":")
    host = host.removeprefix("[").removesuffix("]")
    host = "127.0.0.1" if host == "localhost" else host
    try:
        is_everywhere = is_wildcard(host)
    except ValueError:
        raise ValueError(f"must have a literal IP address, not {host[:80]!r}") from None
    if kind == UDP_CLIENT and is_everywhere:
        raise ValueError("must name the one address to send to")
    return Address(kind, host, _number(port, 65535, 1 if kind == UDP_CLIENT else 0))


def _number(text: str, greatest: int, least: int = 0) -> int:
    if not (text.isascii() and text.isdigit()) or not least <= int(text[:9]) <= greatest:
        raise ValueError(f"must end with a number from {least} to {greatest}, not {text[:20]!r}")
    return int(text)

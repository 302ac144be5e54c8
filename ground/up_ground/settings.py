"""The peer of a ground station, and the name the station uses."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from pathlib import Path

from up.protocols.pairing import Pairing

DEFAULT_HOST = "127.0.0.1"
DEFAULT_PORT = 3004
DEFAULT_AIRCRAFT = "default"


class Seat(Enum):
    """The rights of a ground at the proxy; the value is its word on the wire."""

    COMMAND = "command"
    LISTEN = "listen"


@dataclass(frozen=True, slots=True)
class Settings:
    """The peer: a proxy's ground side or, with ``direct``, a listener without a hello.

    ``tls`` is the folder with this ground's certificate; None: a plain link.
    """

    host: str = DEFAULT_HOST
    port: int = DEFAULT_PORT
    aircraft: str = DEFAULT_AIRCRAFT
    seat: Seat = Seat.LISTEN
    direct: bool = False
    tls: Path | None = None
    pairing: Pairing | None = None
    """This device's key for the aircraft; None: the link is plain."""

    @property
    def address(self) -> str:
        return f"[{self.host}]:{self.port}" if ":" in self.host else f"{self.host}:{self.port}"

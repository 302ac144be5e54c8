"""Which aircraft the server watches, as the command line names them."""

from __future__ import annotations

import re

from up.system.aircraft_name import AIRCRAFT_NAME
from up_ground.settings import Seat, Settings

AIRCRAFT_LIMIT = 16
_ONE = re.compile(
    rf"(?P<name>{AIRCRAFT_NAME.pattern})"
    r"(?:@(?P<host>\[[0-9A-Fa-f:.%a-z]+\]|[A-Za-z0-9_.%-]{1,255}):(?P<port>[0-9]{1,5})"
    r"(?P<direct>/direct)?)?",
    re.ASCII,
)


def parse_aircraft(text: str, usual: Settings) -> Settings:
    """Return whom ``NAME[@HOST:PORT[/direct]]`` means; raises ValueError with a sentence.

    Without an address it is an aircraft of ``usual``'s proxy. Two aircraft of one name are told
    apart by nothing, so a name is given once.
    """
    match = _ONE.fullmatch(text)
    port = int(match["port"] or usual.port) if match else 0
    if match is None or not 1 <= port <= 65535:
        raise ValueError(
            f"{text!r} is no NAME[@HOST:PORT[/direct]], such as glider-1@192.168.1.5:50002/direct"
        )
    host = match["host"]
    if host is None:
        return Settings(usual.host, usual.port, match["name"], Seat.LISTEN, usual.direct)
    return Settings(host.strip("[]"), port, match["name"], Seat.LISTEN, bool(match["direct"]))

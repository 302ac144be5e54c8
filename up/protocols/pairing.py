"""The text that pairs a device with an aircraft; a QR code carries it."""

import re
from dataclasses import field

from up.quick_dataclass import dataclass
from up.system.aircraft_name import AIRCRAFT_NAME

_TEXT = re.compile(
    r"upkey:1:(?P<aircraft>[^:]+):(?P<key_id>[0-9a-f]{16}):(?P<secret>[0-9a-f]{64})"
    r":(?P<role>observer|operator|pilot|admin):(?P<name>[^:]+)",
    re.ASCII,
)


@dataclass(frozen=True, slots=True)
class Pairing:
    """A device's key of one aircraft; ``role`` is that at the time of the pairing."""

    aircraft: str
    key_id: str
    secret: str = field(repr=False)
    role: str
    name: str

    def encode(self) -> str:
        return f"upkey:1:{self.aircraft}:{self.key_id}:{self.secret}:{self.role}:{self.name}"


def parse_pairing(text: str) -> Pairing | None:
    """Return the pairing in a text; None for another text."""
    found = _TEXT.fullmatch(text.strip())
    if found is None or not all(
        AIRCRAFT_NAME.fullmatch(found[each]) for each in ("aircraft", "name")
    ):
        return None
    return Pairing(**found.groupdict())

"""mavlink.yml."""

from collections.abc import Iterator
from typing import Literal

from up.commands.roles import Role
from up.config import ConfigFile, items, key
from up.quick_dataclass import dataclass
from up_mavlink.address import SERIAL, read_address
from up_mavlink.dialect import is_available


@dataclass(frozen=True, slots=True)
class EndpointConfig:
    """One place where ground stations connect."""

    url: str = key(
        "",
        "udpin:ADDRESS:PORT and tcpin:ADDRESS:PORT wait for ground stations, udpout:ADDRESS:PORT "
        "sends to one, serial:/dev/NAME:BAUD is a telemetry radio. An empty address: all.",
        max_length=255,
    )
    role: Literal["auto", "observer", "operator", "pilot"] = key(
        "auto",
        "Permissions, as in mission_control.yml. auto: operator if only this machine reaches the "
        "endpoint or signing is required, otherwise observer.",
    )
    persona: Literal["ardupilot", "px4", "generic"] = key(
        "ardupilot",
        "Which autopilot the aircraft appears to be, so that a ground station knows the names of "
        "its modes. generic: none, for watching.",
    )
    signing: Literal["off", "require"] = key(
        "off", "require: packets without the signature of the key are dropped."
    )
    key_file: str = key(
        "",
        "File with the passphrase of the signatures, relative to this file; only its owner may "
        "read it.",
        max_length=4096,
    )

    @property
    def granted(self) -> Role:
        if self.role != "auto":
            return Role(self.role)
        return Role.OPERATOR if self.is_safe else Role.OBSERVER

    @property
    def is_safe(self) -> bool:
        """Return whether strangers cannot send Commands; raises ValueError for a faulty url."""
        return self.signing == "require" or read_address(self.url).stays_here

    def problems(self) -> Iterator[tuple[str, str] | tuple[str, str, str]]:
        try:
            address = read_address(self.url)
        except ValueError as error:
            yield "url", str(error), "bad_format"
            return
        if self.signing == "require" and not self.key_file:
            yield "key_file", "signing: require needs the file of the passphrase", "value_missing"
        if self.role not in ("auto", "observer") and not self.is_safe:
            where = "a radio" if address.kind == SERIAL else "other machines"
            text = f"{where} may send Commands here: use signing: require, or role: observer"
            yield "role", text, "unsigned"
        if not is_available():
            text = "needs the Python package pymavlink: pip install 'raspilot[mavlink]'"
            yield "url", text, "package_missing"


@dataclass(frozen=True, slots=True)
class MAVLinkConfig:
    """Ground stations that speak MAVLink: QGroundControl, Mission Planner, MAVProxy, MAVSDK."""

    endpoints: tuple[EndpointConfig, ...] = items(
        EndpointConfig, "Where ground stations connect; none: MAVLink is off.", max_length=8
    )
    system_id: int = key(1, "System id of this aircraft.", minimum=1, maximum=250)
    ground_id: int | None = key(
        None,
        "The only system id that may send Commands, usually 255. Empty: any. Without signatures a "
        "system id proves nothing.",
        minimum=1,
        maximum=255,
    )


MAVLINK = ConfigFile("mavlink.yml", MAVLinkConfig)

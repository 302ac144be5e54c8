"""android.yml."""

from collections.abc import Iterator

from up.config import ConfigFile, key
from up.quick_dataclass import dataclass
from up.system.addresses import is_wildcard


@dataclass(frozen=True, slots=True)
class AndroidConfig:
    """The airborne phone: where it connects, what it receives, and what its absence means."""

    general_port: int = key(
        50001,
        "Port for General Messages, TCP and UDP. 0: any free port, said in the log.",
        name="general port",
        minimum=0,
        maximum=65535,
    )
    orientation_port: int = key(
        50000,
        "Port for orientation, TCP and UDP. 0: any free port, said in the log.",
        name="orientation port",
        minimum=0,
        maximum=65535,
    )
    address: str = key(
        "",
        "Address of the interface that the phone connects to. Empty: every one, by IPv4; '::': by "
        "IPv6 as well.",
        max_length=64,
    )
    i_accept_plain: bool = key(
        False,
        "The phone's protocol proves nothing about who speaks it. Peers with public addresses are "
        "refused until this is true; set it only where a firewall or VPN decides who reaches the "
        "ports (Black Box Mode on a server), or when you accept the risk.",
    )
    forward_interval_ms: float = key(
        500.0,
        "The shortest time between two telemetry frames to the phone.",
        name="forward interval for onboard device (ms)",
        unit="ms",
        minimum=20,
        maximum=10000,
    )
    stop_if_orientation_is_lost: bool = key(
        False,
        "Whether the program stops when the phone's orientation connection stays away. Holds in "
        "Black Box Mode only: an autopilot in flight is never stopped by a phone.",
        name="stop if orientation connection is lost",
    )
    stop_delay_s: float = key(
        10.0,
        "How long the connection may stay away before that.",
        name="stop delay (s)",
        unit="s",
        minimum=1,
        maximum=3600,
        replaced=("stop delay (in seconds)",),
    )
    low_battery_percent: float = key(
        20.0,
        "Level of the phone's battery at and below which an alarm is raised. 0: never.",
        name="low battery (percent)",
        unit="percent",
        minimum=0,
        maximum=100,
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        if self.general_port and self.general_port == self.orientation_port:
            yield "orientation_port", "must differ from the general port"
        try:
            is_wildcard(self.address)
        except ValueError:
            yield "address", f"must be a literal IP address, not {self.address!r}"


ANDROID = ConfigFile("android.yml", AndroidConfig, removed={"port": "is called 'general port' now"})

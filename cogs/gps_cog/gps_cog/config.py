"""gps.yml: the satellite receivers aboard."""

from collections.abc import Iterator

from up.commands.origin import link_name_problem
from up.config import ConfigFile, key, mapping
from up.fields import Constraint
from up.quick_dataclass import dataclass

SPEEDS = (9600, 38400, 115200, 57600, 230400)
"""Those of receivers as delivered come first."""


@dataclass(frozen=True, slots=True)
class ReceiverConfig:
    """One receiver."""

    source: str = key(
        "ubx",
        "ubx: a u-blox receiver (8 or later), which is set up. nmea: any receiver that sends NMEA"
        " 0183. gpsd: the program gpsd.",
        choices=("ubx", "nmea", "gpsd"),
    )
    port: str = key(
        "/dev/ttyACM0", "The serial port of ubx and nmea; best under /dev/serial/by-id/.",
        max_length=4096,
    )  # fmt: skip
    baud_rate: int = key(
        38400,
        "The speed that ubx is set to, and the first one that is tried.",
        unit="baud",
        choices=tuple(sorted(SPEEDS)),
    )
    rate_hz: int = key(5, "Fixes that ubx is set to.", unit="Hz", minimum=1, maximum=10)
    gpsd_port: int = key(2947, "The TCP port of gpsd.", minimum=1, maximum=65535)
    gpsd_device: str = key("", "The device of gpsd to follow. Empty: the only one.", max_length=255)
    priority: int = key(
        20,
        "The valid receiver of the highest priority is followed. The phone has 0.",
        minimum=-100,
        maximum=100,
    )
    delay_ms: float = key(
        100.0,
        "Time from the measurement of a fix to its arrival, at the least.",
        unit="ms",
        minimum=0,
        maximum=2000,
    )
    max_accuracy_m: float = key(
        20.0, "A fix that is less accurate is dropped.", unit="m", minimum=1, maximum=1000
    )


@dataclass(frozen=True, slots=True)
class GpsConfig:
    """Satellite receivers aboard. Without one the phone's GPS is used, with one it is in reserve.

    Each has a name of letters, digits and _, which telemetry and the log use as source.
    """

    receivers: dict[str, ReceiverConfig] = mapping(
        Constraint(str, max_length=24), ReceiverConfig, "The receivers by name.", max_length=8
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        ports: dict[str, str] = {}
        for name, receiver in self.receivers.items():
            if problem := link_name_problem(name):
                yield "receivers", problem
            if receiver.source == "gpsd":
                continue
            if receiver.port in ports:
                yield "receivers", f"{name} has the port of {ports[receiver.port]}"
            ports[receiver.port] = name


GPS = ConfigFile("gps.yml", GpsConfig)

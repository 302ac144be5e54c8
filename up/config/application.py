"""config.yml: what concerns the whole application."""

from typing import Literal

from up.config.file import ConfigFile
from up.config.schema import items, key
from up.fields import Constraint
from up.quick_dataclass import dataclass


@dataclass(frozen=True, slots=True)
class ApplicationConfig:
    """The application as a whole: what it logs, in which mode it runs and who controls."""

    log_level: Literal["debug", "info", "warning", "error"] = key(
        "info", "The least severe events that are logged.", name="log level", ignore_case=True
    )
    log_file: str = key(
        "",
        "A file that gets the same events, one JSON object a line, and is rotated. Empty: none.",
        name="log file",
        max_length=4096,
    )
    mode: Literal["auto", "flight controller", "black box"] = key(
        "auto",
        "Whether a board flies the aeroplane (flight controller) or the Raspberry Pi only records "
        "the flight (black box). With auto it depends on whether a board answers. The environment "
        "variable UP_MODE takes the same words and comes first.",
    )
    flight_controller: Literal["arduino", "raspberry", "msp"] = key(
        "arduino",
        "Where the control loop runs. The Raspberry Pi needs a board that sends the receiver's "
        "inputs; msp is a Betaflight board.",
        name="flight controller",
    )
    realtime_priority: int = key(
        0,
        "Real-time priority (SCHED_FIFO) of the program, where the system permits it. 0: off.",
        name="realtime priority",
        minimum=0,
        maximum=99,
    )


APPLICATION = ConfigFile("config.yml", ApplicationConfig)


@dataclass(frozen=True, slots=True)
class DisabledModulesConfig:
    """Modules that are not loaded, built-in ones included."""

    disabled_modules: tuple[str, ...] = items(
        Constraint(str, max_length=255),
        "Full names, like package.modules.altitude.AltitudeModule, one a line after a dash.",
        name="disabled modules",
    )


DISABLED_MODULES = ConfigFile("disabled_modules.yml", DisabledModulesConfig)


_SOURCE = Constraint(str, max_length=64)


def _order(reading: str) -> tuple[str, ...]:
    made: tuple[str, ...] = items(
        _SOURCE,
        f"Sources of the {reading}, the preferred first. Empty: as the links say (the board "
        "before other sensors).",
        max_length=16,
    )
    return made


@dataclass(frozen=True, slots=True)
class ProvidersConfig:
    """Which sources the providers prefer, by the names of links in ``source`` of telemetry."""

    orientation: tuple[str, ...] = _order("orientation")
    location: tuple[str, ...] = _order("location")
    altitude: tuple[str, ...] = _order("altitude")
    heading: tuple[str, ...] = _order("heading")
    rx: tuple[str, ...] = _order("receiver inputs")

    def order_of(self, reading: str) -> tuple[str, ...]:
        """Return the preferred sources of a reading; empty for a reading without a key."""
        order: tuple[str, ...] = getattr(self, reading, ())
        return order


PROVIDERS = ConfigFile("providers.yml", ProvidersConfig)

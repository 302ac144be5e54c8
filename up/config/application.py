"""config.yml: what concerns the whole application."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from up.config.file import ConfigFile
from up.config.schema import key


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
        "Whether an Arduino flies the aeroplane (flight controller) or the phone and the "
        "Raspberry Pi only record the flight (black box). With auto it depends on whether an "
        "Arduino answers. The environment variable UP_MODE takes the same words and comes first.",
    )
    flight_controller: Literal["arduino", "raspberry"] = key(
        "arduino",
        "Where the control loop runs. The Raspberry Pi needs an Arduino that sends the receiver's "
        "inputs.",
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

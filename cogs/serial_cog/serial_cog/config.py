"""arduino.yml: the serial line."""

from up.config import ConfigFile, key
from up.protocols.framing import FRAMINGS
from up.quick_dataclass import dataclass

THESIS_BAUD = 9600


@dataclass(frozen=True, slots=True)
class SerialConfig:
    """The serial line to the Arduino: where it is and how it is spoken."""

    port: str = key(
        "",
        "The port, as /dev/ttyUSB0 or /dev/ttyAMA0. Empty: the Arduino is found by its USB id.",
        max_length=4096,
    )
    baud_rate: int = key(
        115200,
        "The speed for which the firmware was built. An old firmware (framing: thesis) uses 9600.",
        unit="baud",
        choices=(9600, 19200, 38400, 57600, 115200, 230400),
    )
    framing: str = key(
        "checked",
        "The framing of messages: checked (COBS, sequence, CRC) for the firmware of this project,"
        " thesis (bare) for an old one, which takes no arming, setpoint or Output.",
        choices=FRAMINGS,
    )
    silence_s: float = key(
        1.0,
        "Without a frame for this time the Arduino counts as not connected.",
        unit="s",
        minimum=0.2,
        maximum=10,
    )


ARDUINO = ConfigFile(
    "arduino.yml",
    SerialConfig,
    removed={"wait_for_arduino": "Raspilot always starts and keeps looking for the Arduino"},
)


def odd_speed(config: SerialConfig) -> str:
    """Return a sentence for an unusual pair of speed and framing, otherwise an empty text."""
    if config.framing == "thesis" and config.baud_rate != THESIS_BAUD:
        return (
            f"arduino.yml: an old firmware (framing: thesis) speaks at {THESIS_BAUD} baud, not at"
            f" {config.baud_rate}: set baud_rate to {THESIS_BAUD} if nothing is understood"
        )
    if config.framing == "checked" and config.baud_rate == THESIS_BAUD:
        return (
            f"arduino.yml: at {THESIS_BAUD} baud messages come seldom; the firmware is built for"
            " 115200 by default, and an old firmware needs framing: thesis"
        )
    return ""

"""crsf.yml: the receiver on a UART of the Raspberry Pi."""

from collections.abc import Iterator

from up.config import ConfigFile, items, key
from up.fields import Constraint
from up.quick_dataclass import dataclass


@dataclass(frozen=True, slots=True)
class CrsfConfig:
    """A CRSF receiver (ExpressLRS, Crossfire) at the Raspberry Pi, beside the Arduino's.

    The Arduino's switch decides who flies, whatever this receiver receives.
    """

    port: str = key(
        "", "Its serial port, as /dev/serial0. Empty: no receiver.", max_length=4096
    )  # fmt: skip
    baud_rate: int = key(420000, "Its speed.", unit="baud", minimum=9600, maximum=4000000)
    telemetry: bool = key(
        True, "Whether position, battery, attitude and flight mode go to the transmitter."
    )
    mode_channel: int | None = key(
        None,
        "The channel that selects flight modes when the pilot moves it. Empty: none.",
        minimum=5,
        maximum=16,
    )
    modes: tuple[str, ...] = items(
        Constraint(str, max_length=32),
        "The flight modes of its positions from low to high; an empty name selects nothing.",
        max_length=8,
    )
    sticks: str = key(
        "",
        "Order of channels 1 to 4 (ailerons, elevator, throttle, rudder) if the channels are a "
        "source of rx in reserve of the Arduino's inputs. Empty: they are not.",
        choices=("", "AETR", "TAER"),
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        if self.mode_channel is not None and len(self.modes) < 2:
            yield "modes", "mode_channel needs at least two positions"
        if self.mode_channel is None and self.modes:
            yield "modes", "no mode_channel selects them"


CRSF = ConfigFile("crsf.yml", CrsfConfig)

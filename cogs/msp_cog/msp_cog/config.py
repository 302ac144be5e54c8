"""msp.yml: the line to a Betaflight board."""

from collections.abc import Iterator

from msp_cog.line_opener import SOCKET, socket_problem
from up.config import ConfigFile, key
from up.quick_dataclass import dataclass


@dataclass(frozen=True, slots=True)
class MspConfig:
    """The line to a Betaflight board (config.yml: flight controller: msp)."""

    port: str = key(
        "/dev/ttyACM0",
        "The board's port: its USB port, a UART with MSP as /dev/ttyAMA0, or"
        " tcp:127.0.0.1:5761, the simulated board.",
        max_length=4096,
    )
    baud_rate: int = key(
        115200,
        "The speed of the board's UART; a USB port has none.",
        unit="baud",
        choices=(57600, 115200, 230400),
    )
    rate_hz: int = key(
        50,
        "How often attitude and receiver inputs are requested, and set-points sent.",
        unit="Hz",
        minimum=20,
        maximum=100,
    )
    silence_s: float = key(
        0.5,
        "Without an answer for this time the board counts as not connected.",
        unit="s",
        minimum=0.2,
        maximum=10,
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        problem = socket_problem(self.port) if self.port.startswith(SOCKET) else ""
        if problem:
            yield "port", problem


MSP = ConfigFile("msp.yml", MspConfig)

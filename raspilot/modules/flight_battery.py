"""The voltage of the flight battery, and the limits of flight_battery.yml."""

from collections.abc import Iterator, Mapping
from typing import Any

from up.base_module import BaseModule
from up.commands.flight_state_command import FlightBatteryCommand, FlightStateCommand
from up.config import ConfigFile, key
from up.failures import FailureSource
from up.flight_controller.base_board import BaseBoard
from up.mode import WITH_BOARD
from up.providers.source_arbiter import SourceArbiter
from up.quick_dataclass import dataclass

MEASURED_S = 2.0
"""How long a measurement is used."""
UNKNOWN_S = 3.0
"""How long after the start of a board a voltage may be missing."""
_RECOVERED = 1.02
"""A voltage below a limit has to rise to this part of it: the battery recovers without load."""


@dataclass(frozen=True, slots=True)
class FlightBatteryConfig:
    """Voltages of the flight battery, measured under load, that raise an alarm."""

    low_v: float | None = key(
        None, "Below it the battery is low: land soon.", unit="V", minimum=1, maximum=65
    )
    critical_v: float | None = key(
        None, "Below it the battery is critically low: land now.", unit="V", minimum=1, maximum=65
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        if None not in (self.low_v, self.critical_v) and self.critical_v >= self.low_v:  # type: ignore[operator]
            yield "critical_v", f"must be below low_v, which is {self.low_v:g}"


FLIGHT_BATTERY = ConfigFile("flight_battery.yml", FlightBatteryConfig)


class FlightBattery(BaseModule, FailureSource):
    """Follows a sensor's voltage, otherwise the board's, and compares it with the limits.

    A limit is None in telemetry while there is no limit or no voltage. Limits without a voltage are
    logged once for each start of the board.
    """

    MODES = WITH_BOARD
    CONFIG = FLIGHT_BATTERY

    def on_init(self) -> None:
        self._measured: FlightBatteryCommand | None = None
        self._measured_s = 0.0
        self._started_s: float | None = None
        self._limits_v = {"low": self.config.low_v, "critical": self.config.critical_v}
        self._is_below: dict[str, bool | None] = dict.fromkeys(self._limits_v)
        self._seconds = self.context.reactor.seconds
        self._arbiter = SourceArbiter(MEASURED_S, lambda _before, _source: None)
        executor = self.up.command_executor
        executor.register_command(FlightBatteryCommand, self._on_measured)
        if any(self._limits_v.values()):
            executor.register_command(FlightStateCommand, self._on_state)
            for board in self.up.get_modules(BaseBoard):
                board.add_board_listener(self._on_board_started)

    @property
    def measured(self) -> FlightBatteryCommand | None:
        """Return the newest measurement of the source that is followed; None: too old."""
        if self._measured is None or self._seconds() - self._measured_s > MEASURED_S:
            return None
        return self._measured

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        measured = self.measured
        below = {
            f"flight_battery_{name}": measured and is_below
            for name, is_below in self._is_below.items()
        }
        content = {
            "flight_battery_v": measured and round(measured.voltage_v, 2),
            "flight_battery_a": measured and measured.current_a,
        }
        return {"arduino": {**content, **below}}

    @property
    def failures(self) -> Mapping[str, bool]:
        """Return which limits the voltage is below now, without hysteresis: the failsafes wait."""
        measured = self.measured
        return {
            f"flight_battery_{name}": measured is not None
            and limit_v is not None
            and measured.voltage_v < limit_v
            for name, limit_v in self._limits_v.items()
        }

    def _on_measured(self, command: FlightBatteryCommand) -> None:
        origin, now_s = self.up.command_executor.origin, self._seconds()
        if not command.voltage_v or not self._arbiter.accepts(origin.link, origin.priority, now_s):
            return
        was_below = self._is_below if self.measured else dict.fromkeys(self._limits_v)
        self._measured, self._measured_s = command, now_s
        self._is_below = {
            name: None
            if limit_v is None
            else command.voltage_v < limit_v * (_RECOVERED if was_below[name] else 1.0)
            for name, limit_v in self._limits_v.items()
        }

    def _on_board_started(self) -> None:
        self._started_s = self._seconds()

    def _on_state(self, _command: FlightStateCommand) -> None:
        if self._started_s is None or self._seconds() - self._started_s < UNKNOWN_S:
            return
        self._started_s = None
        if self.measured is None:
            self.log.warn(
                "{file} has limits, but nothing measures the flight battery: wire and calibrate pin"
                " A7 of the Arduino (docs/wiring.md), or switch the measurement of your board on",
                code="flight_battery_unknown",
                file=FLIGHT_BATTERY.filename,
            )

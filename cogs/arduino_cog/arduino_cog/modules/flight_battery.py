"""The voltage of the flight battery, as the Arduino measures it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from arduino_cog.commands.arduino_status_command import ArduinoStatusCommand
from arduino_cog.config import FLIGHT_BATTERY
from arduino_cog.modules.arduino_provider import ORIGIN, ArduinoProvider
from up.base_module import BaseModule
from up.commands.flight_state_command import FlightBatteryCommand
from up.commands.roles import Role
from up.failures import FailureSource
from up.mode import WITH_BOARD
from up.needs import needs
from up.providers.source_arbiter import SourceArbiter

SENSOR_S = 2.0
"""How long a sensor's measurement is used."""
_RECOVERED = 1.02
"""A voltage below a limit has to rise to this part of it: the battery recovers without load."""


class FlightBattery(BaseModule, FailureSource):
    """Publishes the voltage, and whether it is below the limits of flight_battery.yml.

    A limit is None in telemetry while there is no limit or no voltage. Limits without a voltage are
    logged once for each start of the board.
    """

    MODES = WITH_BOARD
    CONFIG = FLIGHT_BATTERY

    arduino = needs(ArduinoProvider)

    def on_init(self) -> None:
        self._limits_v = {"low": self.config.low_v, "critical": self.config.critical_v}
        self._is_below: dict[str, bool | None] = dict.fromkeys(self._limits_v)
        self.on_board_started()
        self.arduino.add_board_listener(self.on_board_started)
        self._seconds = self.context.reactor.seconds
        self._measured: FlightBatteryCommand | None = None
        self._measured_s = 0.0
        self._arbiter = SourceArbiter(SENSOR_S, lambda _before, _source: None)
        executor = self.up.command_executor
        executor.register_command(ArduinoStatusCommand, self.on_status)
        executor.register_command(FlightBatteryCommand, self.on_measured)

    @property
    def voltage_v(self) -> float | None:
        """Return the newest voltage, a sensor's before the Arduino's; None while it is unknown."""
        sensor = self._sensor
        if sensor is not None:
            return round(sensor.voltage_v, 2)
        status = self.arduino.status
        return round(status.battery_mv / 1000, 2) if status and status.battery_mv else None

    @property
    def _sensor(self) -> FlightBatteryCommand | None:
        """Return the newest measurement of the followed sensor, unless it is too old."""
        if self._measured is None or self._seconds() - self._measured_s > SENSOR_S:
            return None
        return self._measured

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        voltage_v = self.voltage_v
        below = {
            f"flight_battery_{name}": None if voltage_v is None else is_below
            for name, is_below in self._is_below.items()
        }
        current_a = self._sensor and self._sensor.current_a
        return {"arduino": {"flight_battery_v": voltage_v, "flight_battery_a": current_a, **below}}

    @property
    def failures(self) -> Mapping[str, bool]:
        """Return which limits the voltage is below now, without hysteresis: the failsafes wait."""
        voltage_v = self.voltage_v
        return {
            f"flight_battery_{name}": None not in (voltage_v, limit_v) and voltage_v < limit_v
            for name, limit_v in self._limits_v.items()
        }

    def on_board_started(self) -> None:
        self._is_unknown_logged = not any(self._limits_v.values())

    def on_measured(self, command: FlightBatteryCommand) -> None:
        """Follow a sensor; what this module publishes comes here, too."""
        origin, now_s = self.up.command_executor.origin, self._seconds()
        if origin.role is not Role.SENSOR:
            return
        if self._arbiter.accepts(origin.link, origin.priority, now_s):
            self._measured, self._measured_s = command, now_s

    def on_status(self, status: ArduinoStatusCommand) -> None:
        """Publish a measured voltage and compare it with the limits."""
        voltage_v = self.voltage_v or 0.0
        if voltage_v and self._sensor is None:
            self.up.command_executor.execute_command(FlightBatteryCommand(voltage_v), ORIGIN)
        if not voltage_v and not self._is_unknown_logged:
            self._is_unknown_logged = True
            self.log.warn(
                "{file} has limits, but the Arduino measures no flight battery: wire and calibrate"
                " it (docs/wiring.md), or flash the present firmware",
                code="flight_battery_unknown",
                file=FLIGHT_BATTERY.filename,
            )
        for name, limit_v in self._limits_v.items():
            if limit_v is None or not voltage_v:
                self._is_below[name] = None
            else:
                margin = _RECOVERED if self._is_below[name] else 1.0
                self._is_below[name] = voltage_v < limit_v * margin

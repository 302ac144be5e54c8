"""The battery of the airborne phone (thesis 3.3.3)."""

from collections.abc import Mapping
from typing import Any

from android_cog.commands.android_commands import (
    AndroidBatteryCommand,
    AndroidBatteryLowCommand,
)
from android_cog.config import ANDROID
from up.commands.telemetry_schema import READINGS
from up.failures import FailureSource
from up.providers.base_provider import BaseProvider, Reading

HYSTERESIS_PERCENT = 5.0


class AndroidBatteryProvider(BaseProvider[float], FailureSource):
    """Provides the level of the phone's battery, percent, and reports when it becomes low."""

    READING = "battery"
    COMMAND = AndroidBatteryCommand
    MAX_AGE_S = READINGS[READING].source_s
    is_low = False

    def on_init(self) -> None:
        super().on_init()
        self._low_percent = self.context.config(ANDROID).low_battery_percent

    @property
    def battery_level(self) -> float | None:
        """Return the newest level, percent; None before the first."""
        return self.value

    @property
    def failures(self) -> Mapping[str, bool]:
        """Return what the failsafes know."""
        return {"phone_battery": self.is_low}

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        return {"android": {"batteryLevel": self.battery_level}, **self._ages()}

    def _value_of(self, command: Any) -> float:
        level: float = command.level_percent
        return level

    def _on_changed(self, reading: Reading[float]) -> None:
        level = reading.value
        if not self.is_low and self._low_percent > 0 and level <= self._low_percent:
            self.is_low = True
            text = "the phone's battery is low: {percent:g} percent"
            self.log.error(text, percent=level, code="battery_low")
            self._publish(level)
        elif self.is_low and level >= self._low_percent + HYSTERESIS_PERCENT:
            self.is_low = False
            self.log.info("the phone's battery is at {percent:g} percent again", percent=level)
            self._publish(level)

    def _publish(self, level: float) -> None:
        self.up.command_executor.execute_command(AndroidBatteryLowCommand(level, self.is_low))

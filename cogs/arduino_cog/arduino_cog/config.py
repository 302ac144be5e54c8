"""flight_battery.yml: the limits of the flight battery's voltage."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from up.config import ConfigFile, key


@dataclass(frozen=True, slots=True)
class FlightBatteryConfig:
    """Voltages of the flight battery, measured at pin A7 under load, that raise an alarm."""

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

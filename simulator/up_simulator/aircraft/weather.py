"""The air that an aircraft flies in: wind, turbulence and single gusts."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from up.config import items, key
from up_simulator.aircraft.model import FOOT_M, FlightModel

Turbulence = Literal["none", "light", "moderate", "severe"]
TURBULENCE: tuple[Turbulence, ...] = ("none", "light", "moderate", "severe")
# What MIL-F-8785C takes turbulence from: wind at 6 m above the ground (m/s), and a severity (1 to
# 7) that JSBSim blends in towards 600 m. Measured with the glider at 75 to 130 m, seeds 1 to 10,
# 120 s each, rms m/s along, across and vertical: light 0.33 to 0.76, 0.30 to 0.60, 0.30 to 0.67;
# moderate 0.54 to 1.37, 0.50 to 1.35, 0.58 to 0.99; severe 1.31 to 3.61, 0.73 to 2.40, 0.85 to
# 1.72.
_LEVELS: dict[str, tuple[float, int]] = {
    "light": (4.0, 1),
    "moderate": (8.0, 2),
    "severe": (13.0, 3),
}
_TUSTIN = 4


@dataclass(frozen=True, slots=True)
class Gust:
    """A gust: moving air that rises and fades as (1 - cos)."""

    at_s: float = key(0.0, "Start time.", unit="s", minimum=0, maximum=3600)
    duration_s: float = key(1.0, "Duration.", unit="s", minimum=0.02, maximum=600)
    north_m_s: float = key(0.0, "Speed to the north.", unit="m/s", minimum=-30, maximum=30)
    east_m_s: float = key(0.0, "Speed to the east.", unit="m/s", minimum=-30, maximum=30)
    down_m_s: float = key(0.0, "Speed down.", unit="m/s", minimum=-30, maximum=30)


@dataclass(frozen=True, slots=True)
class Weather:
    """Wind, turbulence and gusts."""

    wind_m_s: float = key(0.0, "Wind speed.", unit="m/s", minimum=0, maximum=30)
    wind_from_deg: float = key(
        180.0, "Direction that the wind comes from: 0 is north.", unit="deg", minimum=0, maximum=360
    )
    turbulence: Turbulence = key("none", "Spectrum of MIL-F-8785C, different for every seed.")
    gusts: tuple[Gust, ...] = items(Gust, "Single gusts.", max_length=100)

    @property
    def wind_ned_m_s(self) -> tuple[float, float]:
        """Return where the wind blows: to the north and to the east."""
        angle = math.radians(self.wind_from_deg)
        return -self.wind_m_s * math.cos(angle), -self.wind_m_s * math.sin(angle)


class Air:
    """Applies the weather to the flight model."""

    def __init__(self, fdm: FlightModel, weather: Weather) -> None:
        self._gusts = weather.gusts
        self._end_s = max((gust.at_s + gust.duration_s for gust in weather.gusts), default=-1.0)
        self._is_blowing = False
        self._set = [
            fdm.writer(f"atmosphere/gust-{axis}-fps") for axis in ("north", "east", "down")
        ]
        if weather.turbulence != "none":
            fdm["atmosphere/turb-type"] = _TUSTIN
            near_ground_m_s, severity = _LEVELS[weather.turbulence]
            fdm["atmosphere/turbulence/milspec/windspeed_at_20ft_AGL-fps"] = (
                near_ground_m_s / FOOT_M
            )
            fdm["atmosphere/turbulence/milspec/severity"] = severity

    def apply(self, time_s: float) -> None:
        if time_s > self._end_s and not self._is_blowing:
            return
        totals = [0.0, 0.0, 0.0]
        self._is_blowing = False
        for gust in self._gusts:
            into_s = time_s - gust.at_s
            if 0.0 <= into_s < gust.duration_s:
                self._is_blowing = True
                share = 0.5 * (1 - math.cos(2 * math.pi * into_s / gust.duration_s))
                for index, peak in enumerate((gust.north_m_s, gust.east_m_s, gust.down_m_s)):
                    totals[index] += share * peak
        for set_gust, total in zip(self._set, totals, strict=True):
            set_gust(total / FOOT_M)

"""navigation.yml: how the aircraft navigates."""

from __future__ import annotations

from dataclasses import dataclass

from up.config import ConfigFile, key


@dataclass(frozen=True, slots=True)
class NavigationConfig:
    """How the aircraft navigates."""

    auto_mode: str = key(
        "FBW",
        "The flight mode of the Raspberry Pi that acts when the switch comes to AUTO. With"
        " 'flight controller: arduino' the Arduino keeps flying FBW itself.",
        max_length=32,
    )
    cruise_m_s: float = key(14.0, "Cruise airspeed.", unit="m/s", minimum=5, maximum=60)
    home_accuracy_m: float = key(
        10.0,
        "Home is set only while the position's standard deviation is at most this.",
        unit="m",
        minimum=1,
        maximum=100,
    )


NAVIGATION = ConfigFile("navigation.yml", NavigationConfig)

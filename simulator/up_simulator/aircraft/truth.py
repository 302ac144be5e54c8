"""The true state for a flight's log, beside the measurements."""

from __future__ import annotations

import math
from typing import Any

from up_simulator.aircraft.flight import FlightState

TOPIC = "simulator.truth"
PERIOD_S = 0.05
_FIELDS = {"ground_speed_m_s": "speed_m_s", "vertical_speed_m_s": "climb_m_s"}
NAMES = {
    name: _FIELDS.get(name, name)
    for name in (
        "time_s", "roll_deg", "pitch_deg", "yaw_deg", "roll_rate_deg_s", "pitch_rate_deg_s",
        "yaw_rate_deg_s", "latitude_deg", "longitude_deg", "altitude_m", "height_m", "north_m",
        "east_m", "airspeed_m_s", "ground_speed_m_s", "track_deg", "vertical_speed_m_s",
        "wind_north_m_s", "wind_east_m_s", "wind_down_m_s", "alpha_deg", "sideslip_deg",
        "load_factor_g", "motor_rpm", "motor_w", "battery_v", "battery_percent",
    )
}  # fmt: skip
"""The name of each value in the log, and in a ``FlightState``."""
_DIGITS = {"latitude_deg": 8, "longitude_deg": 8}


def truth_of(state: FlightState) -> dict[str, float]:
    """Return the values by their names in the log; omits values that are not numbers."""
    values = {name: getattr(state, field) for name, field in NAMES.items()}
    return {
        name: round(value, _DIGITS.get(name, 4))
        for name, value in values.items()
        if math.isfinite(value)
    }


def record_of(state: FlightState) -> dict[str, Any]:
    """Return the data of ``black_box.record``, by which a companion on board logs something."""
    return {"topic": TOPIC, "content": truth_of(state)}

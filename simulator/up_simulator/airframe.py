"""The aircraft of JSBSim that the simulator knows how to launch in the air."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Airframe:
    """How to start one shipped model in the air and how far its surfaces move.

    ``throw`` is the part of the model's full surface travel that 500 us of pulse give; the trims
    are normalized commands of the model (positive elevator is nose down), set so that neutral
    pulses hold the airspeed. ``slope_lift_m_s`` is the rising air that a glider soars in.
    """

    model: str
    airspeed_m_s: float
    path_deg: float
    has_motor: bool
    throw: float = 1.0
    elevator_trim: float = 0.0
    aileron_trim: float = 0.0
    slope_lift_m_s: float = 0.0


AIRFRAMES = {
    "minisgs": Airframe(
        "minisgs", 8.3, -4.0, has_motor=False, elevator_trim=0.1, slope_lift_m_s=1.2
    ),
    "c172x": Airframe(
        "c172x", 46.0, 0.0, has_motor=True, throw=0.4, elevator_trim=0.1, aileron_trim=-0.08
    ),
}
DEFAULT_AIRFRAME = "minisgs"

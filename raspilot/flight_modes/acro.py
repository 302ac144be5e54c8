"""ACRO: the sticks move the surfaces."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from up.flight_modes.demand import Demand, SurfacesDemand
from up.flight_modes.flight_mode import FlightMode, FlightSituation


class Acro(FlightMode):
    """Passes the sticks through; needs no attitude."""

    NAME: ClassVar[str] = "ACRO"
    NEEDS: ClassVar[Mapping[str, float]] = {"rx": 0.25}
    FALLBACK: ClassVar[str] = ""

    def step(self, situation: FlightSituation, dt_s: float) -> Demand:
        rx = situation.rx
        assert rx is not None
        return SurfacesDemand(rx.ailerons_us, rx.elevator_us, rx.rudder_us)

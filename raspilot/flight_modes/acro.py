"""The sticks pass through, by the Raspberry Pi."""

from up.flight_modes.demand import SurfacesDemand
from up.flight_modes.flight_mode import FlightMode, FlightSituation


class Acro(FlightMode):
    """The surfaces follow the sticks: what FBW falls back to when the board sends no rates."""

    SELECTABLE = False
    NAME = "ACRO"
    NEEDS = {"rx": 0.25}
    FALLBACK = ""

    def load(self) -> bool:
        return self.context.application.flight_controller == "raspberry"

    def step(self, situation: FlightSituation, dt_s: float) -> SurfacesDemand:
        rx = situation.rx
        assert rx is not None
        return SurfacesDemand(rx.ailerons_us, rx.elevator_us, rx.rudder_us)

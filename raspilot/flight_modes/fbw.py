"""Fly By Wire on the Raspberry Pi (thesis 3.3.2)."""

from raspilot.flight_controller import sticks
from up.commands.flight_state_command import FlyByWireLimitsCommand
from up.flight_modes.demand import AttitudeDemand
from up.flight_modes.flight_mode import FlightMode, FlightSituation


class FlyByWire(FlightMode):
    """The sticks demand bank and pitch, within the limits of airframe.yml; throttle and rudder are
    the pilot's. With ``flight controller: arduino`` the board's own FBW is flown instead."""

    SELECTABLE = False
    NAME = "FBW"
    NEEDS = {"rx": 0.25, "orientation": 1.0}
    FALLBACK = "ACRO"

    def load(self) -> bool:
        return self.context.application.flight_controller == "raspberry"

    def on_init(self) -> None:
        self._limits = sticks.DEFAULT_LIMITS
        self.up.command_executor.register_command(FlyByWireLimitsCommand, self._on_limits)

    def step(self, situation: FlightSituation, dt_s: float) -> AttitudeDemand:
        rx = situation.rx
        assert rx is not None
        return AttitudeDemand(
            sticks.roll_deg(rx.ailerons_us, self._limits),
            sticks.pitch_deg(rx.elevator_us, self._limits),
            rudder_us=rx.rudder_us,
        )

    def _on_limits(self, command: FlyByWireLimitsCommand) -> None:
        self._limits = sticks.Limits.of(command)

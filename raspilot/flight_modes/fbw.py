"""FBW: the sticks require bank and pitch."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from raspilot.flight_controller import sticks
from up.commands.flight_state_command import FlyByWireLimitsCommand
from up.flight_modes.demand import AttitudeDemand, Demand
from up.flight_modes.flight_mode import FlightMode, FlightSituation


class FlyByWire(FlightMode):
    """Holds the attitude of the sticks within the limits of ``airframe.yml``."""

    NAME: ClassVar[str] = "FBW"
    NEEDS: ClassVar[Mapping[str, float]] = {"rx": 0.25, "orientation": 0.1}
    FALLBACK: ClassVar[str] = "ACRO"

    def on_init(self) -> None:
        self._limits = sticks.DEFAULT_LIMITS
        self.up.command_executor.register_command(FlyByWireLimitsCommand, self._on_limits)

    def _on_limits(self, command: FlyByWireLimitsCommand) -> None:
        self._limits = sticks.Limits.of(command)

    def step(self, situation: FlightSituation, dt_s: float) -> Demand:
        rx = situation.rx
        assert rx is not None
        return AttitudeDemand(
            sticks.roll_deg(rx.ailerons_us, self._limits),
            sticks.pitch_deg(rx.elevator_us, self._limits),
            rudder_us=rx.rudder_us,
        )

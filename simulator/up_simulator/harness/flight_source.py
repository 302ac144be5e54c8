"""Puts something into the air: an airframe in its weather, or a recorded flight."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import Protocol

from up_rig.imu import Motion
from up_simulator.aircraft import Airframe, FlightDynamics, Start, Weather
from up_simulator.aircraft.flight import FlightState, FlightUnavailableError, Servos
from up_simulator.aircraft.recorded_flight import read_recording
from up_simulator.aircraft.replayed import ReplayedFlight


class Aloft(Protocol):
    """The flight for a board of either kind: a ``Flight`` that a ``World`` can be made of."""

    @property
    def crash(self) -> str | None:
        """Return one sentence about the crash; None while it flies."""

    @property
    def state(self) -> FlightState:
        """Return the newest state."""

    @property
    def motion(self) -> Motion:
        """Return the present motion for an IMU aboard."""

    @property
    def servos(self) -> Servos:
        """Return the present servo positions, us."""

    def set_servos(self, pulses_us: tuple[float, float, float, float]) -> None:
        """Command the servos to these pulses."""

    def advance(self, duration_s: float) -> None:
        """Fly on."""

    def change_battery(self) -> None:
        """Put a full battery in."""

    def launch(self, start: Start) -> None:
        """Put it back into the air."""


def put_aloft(options: argparse.Namespace, airframe: Airframe, say: Callable[[str], None]) -> Aloft:
    """Return the flight that the options select, or the recorded flight if nothing else is usable.

    ``say`` gets the choice. Raises ``FlightUnavailableError`` for an invalid recording.
    """
    if options.replay is not None:
        say(f"flying the recorded flight {options.replay}: the servos have no effect")
        return ReplayedFlight(read_recording(options.replay))
    weather = Weather(wind_m_s=options.wind, turbulence=options.turbulence)
    try:
        flight = FlightDynamics(airframe, Start(), weather, options.seed)
    except FlightUnavailableError as error:
        say(f"{error}: flying a recorded flight, the servos have no effect")
        return ReplayedFlight(read_recording(None))
    say(
        f"flying {airframe.title} by JSBSim: wind {options.wind:g} m/s, "
        f"turbulence {options.turbulence}"
    )
    return flight

"""A recorded flight as something that a board can be aboard of."""

from __future__ import annotations

from up_rig.imu import Motion, motion_at
from up_simulator.aircraft.flight import FlightState, Servos
from up_simulator.aircraft.recorded_flight import RecordedFlight


class ReplayedFlight:
    """Flies a recording; the IMU feels its attitude and rates, and 1 g, whatever it did then.

    It does not follow its servos.
    """

    def __init__(self, flight: RecordedFlight) -> None:
        self._flight = flight

    @property
    def crash(self) -> str | None:
        """Return None: a recording never crashes."""
        return None

    @property
    def state(self) -> FlightState:
        """Return the recorded state."""
        return self._flight.state

    @property
    def servos(self) -> Servos:
        """Return the last commanded pulses, us."""
        return self._flight.servos

    @property
    def motion(self) -> Motion:
        """Return an IMU's motion at this attitude."""
        state = self._flight.state
        rates = (state.roll_rate_deg_s, state.pitch_rate_deg_s, state.yaw_rate_deg_s)
        return motion_at(state.roll_deg, state.pitch_deg, rates)

    def set_servos(self, pulses_us: tuple[float, float, float, float]) -> None:
        """Remember the pulses."""
        ailerons, elevator, throttle, rudder = (round(each) for each in pulses_us)
        self._flight.set_servos((ailerons, elevator, throttle, rudder))

    def advance(self, duration_s: float) -> None:
        """Play on."""
        self._flight.advance(duration_s)

    def launch(self, start: object) -> None:
        """Play on: it flies anyway."""

    def change_battery(self) -> None:
        """Play on: it has none."""

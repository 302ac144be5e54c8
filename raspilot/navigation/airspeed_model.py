"""The airspeed and the climb that pitch, bank and throttle cause; no sensor of the air needed."""

import math

from raspilot.navigation.airframe_model import AirframeModel, load_of
from raspilot.navigation.limits import limited
from up.earth import GRAVITY_M_S2


class AirspeedModel:
    """Integrates the airspeed from the energy: thrust, drag, and the climb.

    The angle of attack of the present lift gives the climb from the pitch. ``thrust_m_s2`` is the
    acceleration by a working motor, ``coast_m_s2`` that by drag and climb. With ``motor_stopped``
    the model has no thrust.
    """

    def __init__(self, model: AirframeModel) -> None:
        self._model = model
        self.climb_m_s = self.thrust_m_s2 = self.coast_m_s2 = 0.0
        self._flown = 1.0, 0.0
        self._slowest = 0.85 * model.speeds.stall_m_s
        self._fastest = 2.5 * model.speeds.cruise_m_s
        self.restart(model.speeds.cruise_m_s, motor_stopped=False)

    def restart(self, airspeed_m_s: float, *, motor_stopped: bool) -> None:
        self.airspeed_m_s = self._limited(airspeed_m_s)
        self.motor_stopped = motor_stopped

    def step(self, dt_s: float, roll_deg: float, pitch_deg: float, throttle: float) -> None:
        speed, load = self.airspeed_m_s, load_of(roll_deg)
        self._flown = load, pitch_deg
        self.climb_m_s, self.coast_m_s2 = self._motion(speed, load, pitch_deg)
        self.thrust_m_s2 = GRAVITY_M_S2 * self._model.power_m_s(throttle) / speed
        change = self.coast_m_s2 + (0.0 if self.motor_stopped else self.thrust_m_s2)
        self.airspeed_m_s = limited(speed + change * dt_s, self._slowest, self._fastest)

    def more_m_s2(self, factor: float) -> float:
        """Return how much more the acceleration is, with thrust, at ``factor`` times the speed."""
        speed = self._limited(factor * self.airspeed_m_s)
        coast_m_s2 = self._motion(speed, *self._flown)[1]
        thrust_m_s2 = self.thrust_m_s2 * self.airspeed_m_s / speed
        return coast_m_s2 - self.coast_m_s2 + thrust_m_s2 - self.thrust_m_s2

    def _motion(self, speed: float, load: float, pitch_deg: float) -> tuple[float, float]:
        """Return the climb and the acceleration without thrust."""
        model = self._model
        sine = math.sin(math.radians(pitch_deg - model.level_pitch_deg(speed, load)))
        return speed * sine, -GRAVITY_M_S2 * (model.sink_m_s(speed, load) / speed + sine)

    def _limited(self, speed: float) -> float:
        return limited(speed, self._slowest, self._fastest)

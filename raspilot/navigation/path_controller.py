"""From a path, an altitude and an airspeed to an attitude and a throttle."""

from raspilot.navigation.airframe_model import AirframeModel, load_of
from raspilot.navigation.lateral import LateralGuidance
from raspilot.navigation.limits import limited
from raspilot.navigation.planning import ground_bank_deg
from raspilot.navigation.vertical import EnergyControl
from up.flight_modes.demand import AttitudeDemand, PathDemand
from up.flight_modes.navigation_file import NavigationConfig
from up.flight_modes.navigation_state import NavigationState

MAX_STEP_S = 0.25
THROTTLE_PER_S = 1.0
"""How fast the demanded throttle changes."""
MIN_BELOW_HOME_M = 5.0
"""Farther below home, as over a valley, home's altitude is not that of the ground."""


class PathController:
    """Turns each PathDemand into an AttitudeDemand; finite for every finite input.

    It begins from the present attitude, and again after ``reset``: call that when another part
    controlled the aircraft in between.
    """

    def __init__(self, config: NavigationConfig) -> None:
        self._config = config
        model = self._model = AirframeModel(config)
        self._lateral = LateralGuidance(config.lateral, model)
        self._vertical = EnergyControl(config.vertical, model)
        self.reset()

    def reset(self) -> None:
        """Begin again at the next step."""
        self._roll_deg: float | None = None
        self._pitch_deg = 0.0
        self._throttle: float | None = None

    def step(
        self,
        demand: PathDemand,
        state: NavigationState,
        dt_s: float,
        home_altitude_m: float | None = None,
    ) -> AttitudeDemand:
        """Return the attitude after ``dt_s``, of which at most 0.25 s counts."""
        dt_s = limited(dt_s, 0.0, MAX_STEP_S)
        lateral, vertical = self._config.lateral, self._config.vertical
        if self._roll_deg is None:
            self._lateral.reset()
            self._vertical.reset(state.airspeed_m_s)
            self._roll_deg = self._lateral.limited(state.roll_deg, state.airspeed_m_s)
            up_deg, down_deg = vertical.pitch_up_limit_deg, -vertical.pitch_down_limit_deg
            self._pitch_deg = limited(state.pitch_deg, down_deg, up_deg)
        wanted_deg = self._lateral.roll_deg(demand.path, state)
        limit_deg = self._bank_limit_deg(demand, state, home_altitude_m)
        wanted_deg = limited(wanted_deg, -limit_deg, limit_deg)
        roll_deg = _towards(self._roll_deg, wanted_deg, lateral.roll_rate_deg_s * dt_s)
        self._roll_deg = self._lateral.limited(roll_deg, state.airspeed_m_s)
        pitch_deg, throttle = self._vertical.step(demand, state, load_of(self._roll_deg), dt_s)
        self._pitch_deg = _towards(self._pitch_deg, pitch_deg, vertical.pitch_rate_deg_s * dt_s)
        if self._throttle is None or throttle == 0.0:
            self._throttle = throttle
        self._throttle = _towards(self._throttle, throttle, THROTTLE_PER_S * dt_s)
        return AttitudeDemand(self._roll_deg, self._pitch_deg, self._throttle)

    def _bank_limit_deg(
        self, demand: PathDemand, state: NavigationState, home_altitude_m: float | None
    ) -> float:
        """Return the demand's limit; without one and without thrust that of the ground."""
        if demand.bank_limit_deg is not None:
            return max(0.0, demand.bank_limit_deg)
        has_thrust = self._model.has_motor and demand.motor and not state.motor_stopped
        if has_thrust or home_altitude_m is None:
            return 90.0
        height_m, sd_m = state.altitude_m - home_altitude_m, state.altitude_sd_m
        if height_m < -MIN_BELOW_HOME_M - 2 * sd_m:
            return 90.0
        return ground_bank_deg(height_m, sd_m)


def _towards(value: float, wanted: float, step: float) -> float:
    return value + limited(wanted - value, -step, step)

"""Vertical control: throttle holds the total energy, pitch divides it (Lambregts)."""

import math

from raspilot.navigation.airframe_model import AirframeModel, load_of
from raspilot.navigation.limits import limited
from up.earth import GRAVITY_M_S2
from up.flight_modes.demand import PathDemand
from up.flight_modes.navigation_file import Vertical
from up.flight_modes.navigation_state import NavigationState

RATE_S = 1.0
"""Time constant of the airspeed's rate, which the estimate does not give."""
MAX_ACCELERATION_M_S2 = 1.5
MAX_AIRSPEED_M_S, MAX_CLIMB_M_S, MAX_FELT_M_S2 = 200.0, 50.0, 4.0
MAX_PITCH_SUM_DEG, MAX_THROTTLE_SUM = 12.0, 0.5
MAX_RISEN = 0.2
"""Greatest slope of an updraft that pitch answers at once."""
CLIMB_CHANGE_M_S2 = 4.0
"""How fast the demanded climb changes: about as fast as pitch follows. The motor follows later;
until then the airspeed gives the energy, less than 1 m/s of it."""
IDLE_THROTTLE, IDLE_FASTER_M_S = 0.1, 2.0
"""Near idle, below this throttle, pitch accepts up to this much excess airspeed; not in a long
descent, which would become slower."""
SPEED_PITCH_DEG = 6.0
"""Greatest sum of the airspeed's integral, either way."""
GLIDE_MARGIN = 1.15
"""Airspeed after the motor has stopped, over that of the best glide: gusts take some of it."""
PROBE_M_S = 1.0
"""Climb that the throttle would give after the motor has stopped."""
SPEED_INTEGRAL, MAX_SUMMED_ERROR_M_S = 0.15, 1.0


class EnergyControl:
    """Pitch and throttle for an altitude and an airspeed.

    The energy rates are in m/s of climb. With the motor, pitch follows the balance of climb and
    acceleration, but never above the pitch that holds the least airspeed: height is given up
    before speed. Without, pitch holds the demanded airspeed and the altitude is what results.
    """

    def __init__(self, config: Vertical, model: AirframeModel) -> None:
        self._config = config
        self._model = model
        self._climb_airspeed_m_s = model.climb_airspeed_m_s(config.climb_limit_m_s)
        self.reset()

    def reset(self, airspeed_m_s: float | None = None) -> None:
        self._smooth_m_s = airspeed_m_s
        self._throttle_sum = 0.0
        self._pitch_sum = 0.0
        self._speed_sum = 0.0
        self._energy = 0.0
        self._wanted_climb = 0.0

    def step(
        self, demand: PathDemand, state: NavigationState, load: float, dt_s: float
    ) -> tuple[float, float]:
        """Return pitch (deg) and throttle (0 to 1) for the bank that is demanded."""
        model, config = self._model, self._config
        airspeed = limited(state.airspeed_m_s, 0.5 * model.speeds.stall_m_s, MAX_AIRSPEED_M_S)
        climb = limited(state.climb_m_s, -MAX_CLIMB_M_S, MAX_CLIMB_M_S)
        if self._smooth_m_s is None:
            self._smooth_m_s = airspeed
        acceleration = (airspeed - self._smooth_m_s) / RATE_S
        share_of_rate = dt_s / RATE_S if dt_s < RATE_S else 1.0
        self._smooth_m_s += (airspeed - self._smooth_m_s) * share_of_rate
        acceleration = limited(acceleration, -MAX_FELT_M_S2, MAX_FELT_M_S2)
        # What the airspeed's change stores, as a climb.
        stored = airspeed * acceleration / GRAVITY_M_S2

        least = self.least_airspeed_m_s(load)
        wanted = model.speeds.cruise_m_s if demand.airspeed_m_s is None else demand.airspeed_m_s
        wanted = max(least, min(model.speeds.maximum_m_s, wanted))
        asked_climb = self._asked_climb(demand, state)
        wanted_climb = self._climb(asked_climb, dt_s)

        if not demand.motor or not model.has_motor:
            return self._glide(airspeed, wanted, acceleration, load, dt_s), 0.0

        # A long climb is flown faster; the throttle alone accelerates, while the pitch climbs.
        share = limited(asked_climb / config.climb_limit_m_s - 1.0, 0.0, 1.0)
        fastest = wanted + share * max(0.0, self._climb_airspeed_m_s - wanted)
        wanted_energy = wanted_climb + self._stored(airspeed, fastest)
        energy = climb + stored
        throttle = self._throttle(wanted_energy, wanted_energy - energy, airspeed, load, dt_s)
        # At idle near the altitude the rest of the energy, of rising air, becomes airspeed.
        tolerated = fastest
        if throttle < IDLE_THROTTLE:
            near = 2.0 + asked_climb / config.sink_limit_m_s
            idle = limited(min(near, 1.0 - throttle / IDLE_THROTTLE), 0.0, 1.0)
            most = min(model.speeds.maximum_m_s, wanted + idle * IDLE_FASTER_M_S)
            tolerated = max(fastest, most)
        wanted_stored = self._stored(airspeed, limited(airspeed, wanted, tolerated))
        if state.motor_stopped:
            # A motor that pulls again, or pulled all along, is noticed by some throttle.
            throttle = min(throttle, model.throttle(model.sink_m_s(airspeed, load) + PROBE_M_S))
            best = GLIDE_MARGIN * max(least, model.speeds.best_glide_m_s * math.sqrt(load))
            return self._glide(airspeed, best, acceleration, load, dt_s), throttle
        # The climb that the motor gives is the one that was seen, not the one that was expected.
        self._energy += (energy - self._energy) * share_of_rate
        highest = self._speed_pitch(airspeed, least, acceleration, self._energy, load)
        # An updraft, or an error of the model: the climb that the present pitch does not explain.
        attack_deg = model.level_pitch_deg(airspeed, load_of(state.roll_deg))
        risen = climb / airspeed - math.sin(math.radians(state.pitch_deg - attack_deg))
        risen = limited(risen, -MAX_RISEN, MAX_RISEN)
        wanted_slope = (wanted_climb - wanted_stored) / airspeed
        slope = (climb - stored) / airspeed
        base = model.level_pitch_deg(airspeed, load)
        pitch = base + math.degrees(config.pitch_p * (wanted_slope - risen)) + self._pitch_sum
        growth = math.degrees(config.pitch_i * (wanted_slope - slope)) * dt_s
        # Near the altitude gusts need more pitch, for a short time.
        limit = config.pitch_up_limit_deg
        if share > 0.0:
            reserve = model.climb_pitch_deg if state.motor_watched else model.least_climb_pitch_deg
            limit += share * min(0.0, reserve(airspeed, load) - limit)
        up, down = limit if limit < highest else highest, -config.pitch_down_limit_deg
        if not (pitch >= up and growth > 0.0) and not (pitch <= down and growth < 0.0):
            grown = self._pitch_sum + growth
            self._pitch_sum = limited(grown, -MAX_PITCH_SUM_DEG, MAX_PITCH_SUM_DEG)
        return max(down, min(up, pitch)), throttle

    def least_airspeed_m_s(self, load: float) -> float:
        return self._model.speeds.minimum_m_s * math.sqrt(load if load > 1.0 else 1.0)

    def _stored(self, airspeed: float, wanted: float) -> float:
        """Return what the change towards an airspeed stores, as a climb."""
        change = self._config.speed_gain * (wanted - airspeed)
        change = limited(change, -MAX_ACCELERATION_M_S2, MAX_ACCELERATION_M_S2)
        return airspeed * change / GRAVITY_M_S2

    def _asked_climb(self, demand: PathDemand, state: NavigationState) -> float:
        if demand.altitude_m is None:
            return demand.climb_m_s
        return self._config.height_gain * (demand.altitude_m - state.altitude_m)

    def _climb(self, asked: float, dt_s: float) -> float:
        config = self._config
        climb = limited(asked, -config.sink_limit_m_s, config.climb_limit_m_s)
        step = CLIMB_CHANGE_M_S2 * dt_s
        self._wanted_climb += limited(climb - self._wanted_climb, -step, step)
        return self._wanted_climb

    def _throttle(
        self, wanted: float, error: float, airspeed: float, load: float, dt_s: float
    ) -> float:
        model, config = self._model, self._config
        power = wanted + model.sink_m_s(airspeed, load)
        throttle = model.throttle(power) + config.throttle_p * error + self._throttle_sum
        growth = config.throttle_i * error * dt_s
        if not (throttle >= 1.0 and growth > 0.0) and not (throttle <= 0.0 and growth < 0.0):
            grown = self._throttle_sum + growth
            self._throttle_sum = limited(grown, -MAX_THROTTLE_SUM, MAX_THROTTLE_SUM)
        return limited(throttle, 0.0, 1.0)

    def _glide(
        self, airspeed: float, wanted: float, acceleration: float, load: float, dt_s: float
    ) -> float:
        """Return the pitch that holds the airspeed without power."""
        config = self._config
        sink = self._model.sink_m_s(wanted, load)
        pitch = self._speed_pitch(airspeed, wanted, acceleration, -sink, load) + self._speed_sum
        error = airspeed - wanted
        growth = SPEED_INTEGRAL * config.glide_gain * error * dt_s
        up, down = config.pitch_up_limit_deg, -config.pitch_down_limit_deg
        if down < pitch < up and abs(error) < MAX_SUMMED_ERROR_M_S:
            grown = self._speed_sum + growth
            self._speed_sum = limited(grown, -SPEED_PITCH_DEG, SPEED_PITCH_DEG)
        return max(down, min(up, pitch))

    def _speed_pitch(
        self, airspeed: float, wanted: float, acceleration: float, energy: float, load: float
    ) -> float:
        """Return the pitch towards an airspeed for an energy rate (m/s of climb)."""
        slope_deg = math.degrees(math.atan(energy / wanted))
        towards_deg = self._config.glide_gain * (airspeed + acceleration - wanted)
        return self._model.level_pitch_deg(wanted, load) + slope_deg + towards_deg

"""TAKEOFF: a hand launch."""

from enum import Enum

from raspilot.flight_controller import sticks
from raspilot.navigation.airframe_model import AirframeModel
from up.config import ConfigFile, key
from up.flight_modes.demand import AttitudeDemand, Demand
from up.flight_modes.flight_mode import FlightMode, FlightSituation, ModeRefusal
from up.flight_modes.navigation_file import NAVIGATION
from up.quick_dataclass import dataclass

LOW_US, CONSENT_US = 1100, 1250
"""The throttle stick: closed; the pilot's consent that the motor may run."""
STANDING_M_S = 3.0
MAX_FIX_AGE_S = 3.0
UPRIGHT_DEG = 45.0
CHECK_S, LEAST_CLIMB_M = 8.0, 4.0
"""Time after the throw, and the height that the aircraft must have gained by then."""
ARRIVED_M = 3.0
LEAST_HEIGHT_M = 10.0
"""Lower it never turns, whatever the target."""


@dataclass(frozen=True, slots=True)
class TakeoffConfig:
    """The mode TAKEOFF."""

    height_m: float = key(
        30.0, "Climbs so far above the place of the throw.", unit="m", minimum=10, maximum=300
    )
    throw_speed_m_s: float = key(
        5.0, "A fix faster than this over the ground is a throw; above that of a running thrower.",
        unit="m/s", minimum=4, maximum=15,
    )  # fmt: skip
    throttle: float = key(0.7, "Throttle of the climb.", minimum=0.3, maximum=1)
    pitch_deg: float = key(
        7.0, "Pitch of the climb: the motor may stop in it unseen for some seconds.", unit="deg",
        minimum=0, maximum=15,
    )  # fmt: skip


TAKEOFF = ConfigFile("takeoff.yml", TakeoffConfig)


class _Stage(Enum):
    HAND, CLIMB, PILOT = range(3)


class Takeoff(FlightMode):
    """Keeps the motor off until the aircraft is thrown, climbs straight ahead, then LOITER.

    The motor starts when a fix shows the speed of a throw while the throttle stick is raised; the
    stick must have been closed before. From then on a closed stick, or no climb, gives the
    aircraft to the sticks. The target's altitude, if there is one, replaces that of ``height_m``.
    """

    NAME = "TAKEOFF"
    NEEDS = {"orientation": 1.0, "rx": 1.0}
    FALLBACK = ""
    CONFIG = TAKEOFF

    _stage = _Stage.PILOT

    def refusal(self, situation: FlightSituation) -> ModeRefusal | None:
        state, rx = situation.navigation, situation.rx
        if not self.context.config(NAVIGATION).performance.motor:
            return ModeRefusal("no_motor", "the aircraft has no motor (navigation.yml)")
        if state is None or state.fix_age_s > MAX_FIX_AGE_S:
            return ModeRefusal("navigation", "the position is unknown")
        if state.is_in_flight or state.ground_speed_m_s > STANDING_M_S:
            return ModeRefusal("in_flight", "the aircraft moves already")
        if rx is None or rx.throttle_us > LOW_US:
            return ModeRefusal("throttle_not_low", "close the throttle stick first")
        return None

    @property
    def is_uninterrupted(self) -> bool:
        return self._stage is _Stage.HAND

    def enter(self, situation: FlightSituation) -> None:
        rx = situation.rx
        is_raised = rx is not None and rx.throttle_us > LOW_US
        # With the stick raised the motor runs by it already, or the program restarts in flight.
        self._stage = _Stage.PILOT if is_raised else _Stage.HAND
        self._was_closed = self._has_climbed = False
        self.successor = ""

    def step(self, situation: FlightSituation, dt_s: float) -> Demand:
        if self._stage is _Stage.HAND:
            self._watch_throw(situation)
        elif self._stage is _Stage.CLIMB:
            self._watch_climb(situation)
        if self._stage is _Stage.CLIMB:
            # By attitude: before the first turn the wind, and so the airspeed, is a guess.
            return AttitudeDemand(0.0, self.config.pitch_deg, self.config.throttle)
        rx = situation.rx
        if self._stage is _Stage.PILOT:
            if rx is None:
                return AttitudeDemand(0.0, 0.0)
            roll_deg, pitch_deg = sticks.roll_deg(rx.ailerons_us), sticks.pitch_deg(rx.elevator_us)
            return AttitudeDemand(roll_deg, pitch_deg, rudder_us=rx.rudder_us)
        # Thrown, it glides until a fix has shown it.
        model = AirframeModel(self.context.config(NAVIGATION))
        glide_m_s = max(model.speeds.minimum_m_s, model.speeds.best_glide_m_s)
        return AttitudeDemand(0.0, model.glide_pitch_deg(glide_m_s, 1.0), 0.0)

    def _watch_throw(self, situation: FlightSituation) -> None:
        state, rx, held = situation.navigation, situation.rx, situation.orientation
        if rx is None:
            return
        self._was_closed = self._was_closed or rx.throttle_us <= LOW_US
        if not self._was_closed or rx.throttle_us < CONSENT_US:
            return
        if state is None or state.fix_age_s > MAX_FIX_AGE_S:
            return
        is_upright = abs(held.roll_deg) < UPRIGHT_DEG and abs(held.pitch_deg) < UPRIGHT_DEG
        if is_upright and state.ground_speed_m_s > self.config.throw_speed_m_s:
            self._stage = _Stage.CLIMB
            self._thrown_s, self._began_m = situation.time_s, state.altitude_m
            target = situation.target
            self._altitude_m = state.altitude_m + self.config.height_m
            if target is not None:
                self._altitude_m = max(state.altitude_m + LEAST_HEIGHT_M, target.altitude_m)
            self.log.info("thrown: the motor starts", code="takeoff_thrown")

    def _watch_climb(self, situation: FlightSituation) -> None:
        state, rx = situation.navigation, situation.rx
        if rx is not None and rx.throttle_us < CONSENT_US:
            self._give_up("the throttle stick is closed", "stick")
        elif not self._has_climbed and situation.time_s - self._thrown_s > CHECK_S:
            self._has_climbed = (
                state is not None and state.altitude_m - self._began_m > LEAST_CLIMB_M
            )
            if not self._has_climbed:
                self._give_up("it does not climb", "no_climb")
        elif state is not None and state.altitude_m > self._altitude_m - ARRIVED_M:
            self.successor = "LOITER"

    def _give_up(self, text: str, cause: str) -> None:
        self._stage = _Stage.PILOT
        self.log.error("the sticks fly: {reason}", reason=text, cause=cause, code="takeoff_aborted")

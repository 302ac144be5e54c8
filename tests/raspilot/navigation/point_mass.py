"""A point mass with lift, drag and thrust in steady wind, for the tests of path control."""

import math
from dataclasses import dataclass, field

from raspilot.navigation.airframe_model import AirframeModel
from raspilot.navigation.path_controller import PathController
from up.flight_modes.demand import PathDemand
from up.flight_modes.navigation_file import NavigationConfig
from up.flight_modes.navigation_state import LocalFrame, NavigationState, Point

STEP_S = 0.02
G = 9.80665
FRAME = LocalFrame(50.0, 14.5)
CONFIG = NavigationConfig()


@dataclass
class PointMass:
    """The aircraft that the configuration describes, apart from ``drag`` and ``thrust``."""

    config: NavigationConfig = CONFIG
    wind: tuple = (0.0, 0.0)
    north: float = 0.0
    east: float = 0.0
    altitude: float = 300.0
    airspeed: float = 11.0
    heading: float = 0.0
    climb_angle: float = 0.0
    roll: float = 0.0
    pitch: float = 0.0
    thrust: float = 1.0
    drag: float = 1.0
    motor_stopped: bool = False
    time_s: float = 0.0
    track: list = field(default_factory=list)

    def __post_init__(self):
        self.model = AirframeModel(self.config)
        self.controller = PathController(self.config)

    @property
    def velocity(self):
        level = self.airspeed * math.cos(self.climb_angle)
        heading = math.radians(self.heading)
        return Point(
            level * math.cos(heading) + self.wind[0], level * math.sin(heading) + self.wind[1]
        )

    @property
    def state(self):
        return NavigationState(
            self.time_s, FRAME, Point(self.north, self.east), self.velocity, self.altitude,
            self.airspeed * math.sin(self.climb_angle), Point(*self.wind), self.airspeed,
            self.heading, self.roll, self.pitch, 1.0, 1.0, 0.3, 0.3, 3.0, 0.1,
            self.motor_stopped,
        )  # fmt: skip

    def move(self, attitude):
        """One step with first-order attitude (0.3 s) and lift by the angle of attack."""
        self.roll += (attitude.roll_deg - self.roll) * STEP_S / 0.3
        self.pitch += (attitude.pitch_deg - self.pitch) * STEP_S / 0.3
        speed, lowest = self.airspeed, self.model.level_pitch_deg(1e6, 1.0)
        alpha = self.pitch - math.degrees(self.climb_angle)
        slope = self.config.performance.stall_pitch_deg - lowest
        lift = min(1.0, (alpha - lowest) / slope) * (speed / self.config.airspeed.stall_m_s) ** 2
        bank = math.radians(self.roll)
        power = self.thrust * self.model.power_m_s(attitude.throttle)
        resistance = self.drag * self.model.sink_m_s(speed, lift)
        self.airspeed += STEP_S * G * ((power - resistance) / speed - math.sin(self.climb_angle))
        self.climb_angle += (
            STEP_S * G / speed * (lift * math.cos(bank) - math.cos(self.climb_angle))
        )
        self.heading += math.degrees(STEP_S * G / speed * lift * math.sin(bank))
        self.north += STEP_S * self.velocity.north_m
        self.east += STEP_S * self.velocity.east_m
        self.altitude += STEP_S * speed * math.sin(self.climb_angle)
        self.time_s += STEP_S

    def fly(self, demand, duration_s):
        """Fly a PathDemand, or what a function of the state returns; return the new states."""
        begin = len(self.track)
        for _ in range(round(duration_s / STEP_S)):
            wanted = demand if isinstance(demand, PathDemand) else demand(self.state)
            if isinstance(wanted, PathDemand):
                wanted = self.controller.step(wanted, self.state, STEP_S)
            self.attitude = wanted
            self.move(wanted)
            self.track.append(self.state)
        return self.track[begin:]


def distances(track, point=(0.0, 0.0)):
    return [math.dist(each.position, point) for each in track]


def rms(values):
    values = list(values)
    return math.sqrt(sum(each * each for each in values) / len(values))

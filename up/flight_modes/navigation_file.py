"""navigation.yml: how the aircraft flies a path, and the numbers of its airframe."""

from collections.abc import Iterator

from up.config import ConfigFile, key, section
from up.quick_dataclass import dataclass


def _speed(default: float, comment: str) -> float:
    return key(default, comment, unit="m/s", minimum=3, maximum=60)


@dataclass(frozen=True, slots=True)
class Airspeed:
    """Airspeeds. The least permitted one is 1.2 times the stall speed or above."""

    stall_m_s: float = _speed(6.5, "Stall in level flight.")
    minimum_m_s: float = _speed(8.0, "Height is given up before the airspeed falls below this.")
    best_glide_m_s: float = _speed(8.0, "Flattest glide with the motor off.")
    cruise_m_s: float = _speed(11.0, "Where a mode or a Command sets no other airspeed.")
    maximum_m_s: float = _speed(16.0, "Greatest airspeed that is demanded.")

    def problems(self) -> Iterator[tuple[str, str]]:
        if self.minimum_m_s < 1.2 * self.stall_m_s:
            least = 1.2 * self.stall_m_s
            yield "minimum_m_s", f"must be at least {least:.1f}, 1.2 times stall_m_s"
        if not self.minimum_m_s <= self.cruise_m_s <= self.maximum_m_s:
            yield "cruise_m_s", "must be between minimum_m_s and maximum_m_s"


@dataclass(frozen=True, slots=True)
class Performance:
    """What the airframe needs for an airspeed; the feed-forward of the path controller."""

    motor: bool = key(True, "Whether a motor holds the altitude; false is a glider.")
    glide_ratio: float = key(
        13.5, "Flattest glide, metres ahead for each metre down.", minimum=2, maximum=60
    )
    level_throttle: float = key(
        0.49, "Throttle that holds the altitude at cruise.", minimum=0.05, maximum=0.95
    )
    full_throttle_climb_m_s: float = key(
        7.5, "Climb at cruise and full throttle.", unit="m/s", minimum=0.5, maximum=30
    )
    cruise_pitch_deg: float = key(
        0.4, "Pitch that holds the altitude at cruise.", unit="deg", minimum=-15, maximum=15
    )
    stall_pitch_deg: float = key(
        7.5, "The same just above the stall.", unit="deg", minimum=-10, maximum=30
    )


@dataclass(frozen=True, slots=True)
class Lateral:
    """L1 guidance onto lines and circles (Park, Deyst, How 2004)."""

    bank_limit_deg: float = key(42.0, "Greatest bank.", unit="deg", minimum=10, maximum=60)
    period_s: float = key(
        8.0, "Period of the approach to the path: less is sharper.", unit="s", minimum=3, maximum=30
    )
    damping: float = key(0.75, "Damping of the approach.", minimum=0.4, maximum=1.5)
    roll_rate_deg_s: float = key(
        60.0, "How fast the demanded bank changes.", unit="deg/s", minimum=10, maximum=180
    )
    roll_delay_s: float = key(
        0.4, "From demanded to flown bank: turns begin earlier by this.", unit="s", minimum=0,
        maximum=2,
    )  # fmt: skip


@dataclass(frozen=True, slots=True)
class Vertical:
    """Total energy control (Lambregts): throttle holds the energy, pitch divides it."""

    climb_limit_m_s: float = key(
        2.5, "Greatest demanded climb.", unit="m/s", minimum=0.3, maximum=15
    )
    sink_limit_m_s: float = key(2.5, "Greatest demanded sink.", unit="m/s", minimum=0.3, maximum=15)
    height_gain: float = key(0.6, "Climb for an altitude error.", unit="m/s per m", minimum=0.05,
                             maximum=2)  # fmt: skip
    speed_gain: float = key(0.4, "Acceleration for an airspeed error.", unit="m/s2 per m/s",
                            minimum=0.05, maximum=2)  # fmt: skip
    throttle_p: float = key(0.08, "Throttle for an error of the energy rate.", unit="per m/s",
                            minimum=0, maximum=1)  # fmt: skip
    throttle_i: float = key(0.012, "The same for each second of it.", unit="per m", minimum=0,
                            maximum=0.5)  # fmt: skip
    pitch_p: float = key(1.0, "Part of the climb angle demanded that pitch follows immediately.",
                         minimum=0, maximum=2)  # fmt: skip
    pitch_i: float = key(0.25, "Pitch for each second of an error of the climb angle.", unit="1/s",
                         minimum=0, maximum=2)  # fmt: skip
    glide_gain: float = key(2.0, "Nose down for an airspeed below the one that pitch holds.",
                            unit="deg per m/s", minimum=0.2, maximum=10)  # fmt: skip
    pitch_up_limit_deg: float = key(18.0, "Greatest pitch up.", unit="deg", minimum=5, maximum=40)
    pitch_down_limit_deg: float = key(18.0, "Greatest pitch down.", unit="deg", minimum=5,
                                      maximum=40)  # fmt: skip
    pitch_rate_deg_s: float = key(
        30.0, "How fast the demanded pitch changes.", unit="deg/s", minimum=5, maximum=90
    )


@dataclass(frozen=True, slots=True)
class NavigationConfig:
    """How the Raspberry Pi flies a path. The defaults are those of the glider of the simulator."""

    auto_mode: str = key(
        "FBW",
        "The flight mode of the Raspberry Pi that acts when the switch comes to AUTO. FBW without"
        " the control loop on the Raspberry Pi: the board keeps flying its own.",
        max_length=16,
    )
    home_accuracy_m: float = key(
        10.0,
        "Home is set only while the position's standard deviation is at most this.",
        unit="m",
        minimum=1,
        maximum=100,
    )
    arm_without_home: bool = key(
        False,
        "Permits arming before home is set, although a failsafe flies RETURN. Where no source of a"
        " position is connected, arming never waits for home.",
    )
    airspeed: Airspeed = section(Airspeed)
    performance: Performance = section(Performance)
    lateral: Lateral = section(Lateral)
    vertical: Vertical = section(Vertical)


NAVIGATION = ConfigFile("navigation.yml", NavigationConfig)

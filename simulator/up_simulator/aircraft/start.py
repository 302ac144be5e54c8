"""How a flight begins."""

from __future__ import annotations

import math
from dataclasses import dataclass

from up.config import key
from up_simulator.aircraft.airframe_file import LaunchConfig
from up_simulator.aircraft.model import FOOT_M, FlightModel
from up_simulator.aircraft.weather import Weather

GROUND_M = 250.0
START_LATITUDE_DEG = 50.0
START_LONGITUDE_DEG = 14.5
# Radii of the Earth (WGS 84) at the start, along the meridian and about the axis.
MERIDIAN_M, PARALLEL_M = 6_373_326.0, 4_108_102.0


def _rate(comment: str) -> float:
    return key(0.0, comment, unit="deg/s", minimum=-720, maximum=720)


@dataclass(frozen=True, slots=True)
class StartPart:
    """Initial state in the air, at 0 s."""

    height_m: float = key(120.0, "Above the ground.", unit="m", minimum=1, maximum=5000)
    airspeed_m_s: float | None = key(
        None, "null: the cruise speed of the airframe.", unit="m/s", minimum=3, maximum=80
    )
    roll_deg: float = key(0.0, "Right wing down positive.", unit="deg", minimum=-180, maximum=180)
    pitch_deg: float | None = key(
        None, "Nose up positive. null: that of the airframe.", unit="deg", minimum=-85, maximum=85
    )
    heading_deg: float = key(0.0, "0 is north, 90 east.", unit="deg", minimum=0, maximum=360)
    climb_m_s: float | None = key(
        None,
        "Through the air, up positive. null: the climb of the airframe at this pitch.",
        unit="m/s",
        minimum=-60,
        maximum=30,
    )
    roll_rate_deg_s: float = _rate("Initial roll rate, right wing down positive.")
    pitch_rate_deg_s: float = _rate("Initial pitch rate, nose up positive.")
    yaw_rate_deg_s: float = _rate("Initial yaw rate, clockwise from above positive.")
    throttle: float | None = key(
        None,
        "Initial motor throttle. null: that of the throttle stick at 0 s.",
        minimum=0,
        maximum=1,
    )


@dataclass(frozen=True, slots=True)
class Start(StartPart):
    """Initial conditions of a flight, its motor's throttle and the throw included.

    ``throw_m_s``: a hand holds the aircraft until it is thrown, so fast over the ground; the
    airspeed is then that speed and the headwind.
    """

    throttle: float = 0.0
    throw_m_s: float | None = None


def set_initial(
    fdm: FlightModel, start: Start, launch: LaunchConfig, weather: Weather, seed: int
) -> None:
    """Put the flight model where a flight begins; ``fdm`` has its model and has not run yet."""
    airspeed_m_s = launch.airspeed_m_s if start.airspeed_m_s is None else start.airspeed_m_s
    if start.throw_m_s is not None:
        from_deg = weather.wind_from_deg - start.heading_deg
        airspeed_m_s = start.throw_m_s + weather.wind_m_s * math.cos(math.radians(from_deg))
    pitch_deg = launch.pitch_deg if start.pitch_deg is None else start.pitch_deg
    alpha_deg = launch.alpha_deg
    if start.climb_m_s is not None:
        share = max(-1.0, min(1.0, start.climb_m_s / max(0.1, airspeed_m_s)))
        alpha_deg = pitch_deg - math.degrees(math.asin(share))
    fdm["ic/terrain-elevation-ft"] = GROUND_M / FOOT_M
    fdm["ic/lat-geod-deg"] = START_LATITUDE_DEG
    fdm["ic/long-gc-deg"] = START_LONGITUDE_DEG
    fdm["ic/h-sl-ft"] = (GROUND_M + start.height_m) / FOOT_M
    fdm["ic/phi-deg"] = start.roll_deg
    fdm["ic/theta-deg"] = pitch_deg
    fdm["ic/psi-true-deg"] = start.heading_deg
    # Over the ground; set before the wind, which does not change the speed over the ground.
    alpha = math.radians(alpha_deg)
    air = (airspeed_m_s * math.cos(alpha), 0.0, airspeed_m_s * math.sin(alpha))
    wind = _to_body((*weather.wind_ned_m_s, 0.0), start, pitch_deg)
    for name, through, carried in zip("uvw", air, wind, strict=True):
        fdm[f"ic/{name}-fps"] = (through + carried) / FOOT_M
    fdm["ic/vw-mag-fps"] = weather.wind_m_s / FOOT_M
    fdm["ic/vw-dir-deg"] = (weather.wind_from_deg + 180.0) % 360.0
    fdm["ic/p-rad_sec"] = math.radians(start.roll_rate_deg_s)
    fdm["ic/q-rad_sec"] = math.radians(start.pitch_rate_deg_s)
    fdm["ic/r-rad_sec"] = math.radians(start.yaw_rate_deg_s)
    fdm["simulation/randomseed"] = seed
    fdm.run_ic()


def _to_body(
    ned: tuple[float, float, float], start: Start, pitch_deg: float
) -> tuple[float, float, float]:
    """Return a vector of the ground's axes in those of the body at the start."""
    roll, pitch = math.radians(start.roll_deg), math.radians(pitch_deg)
    yaw = math.radians(start.heading_deg)
    north, east, down = ned
    ahead = north * math.cos(yaw) + east * math.sin(yaw)
    right = east * math.cos(yaw) - north * math.sin(yaw)
    x = ahead * math.cos(pitch) - down * math.sin(pitch)
    below = ahead * math.sin(pitch) + down * math.cos(pitch)
    return (
        x,
        right * math.cos(roll) + below * math.sin(roll),
        below * math.cos(roll) - right * math.sin(roll),
    )

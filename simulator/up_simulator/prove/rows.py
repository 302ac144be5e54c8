"""The failures and the points of a flight: a new failure is one more row of ``ROWS``."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True, slots=True)
class Point:
    """Where in a flight a failure comes: ``mode`` acts, home is ``away_m`` behind.

    ``by_sticks``: the pilot flies in FBW if the failure is one of the sticks. ``climbs``: it begins
    low and climbs.
    """

    about: str
    mode: str
    away_m: float
    by_sticks: bool = False
    climbs: bool = False


POINTS = {
    "climb": Point("in the climb-out", "CRUISE", 200.0, by_sticks=True, climbs=True),
    "far": Point("far away", "CRUISE", 500.0, by_sticks=True),
    "home": Point("on the way home", "RETURN", 500.0),
    "turn": Point("in a turn", "LOITER", 150.0),
}
BORDER = Point("at the border", "CRUISE", 100.0)


@dataclass(frozen=True, slots=True)
class Row:
    """A failure: the change of an event (as in a scenario) that begins it and that ends it.

    ``lasts_s``: None is until the flight ends; ``order_s`` later the ground commands RETURN, and
    ``rest_s`` of the way home are watched after the turn: a critical battery has to last so long.
    ``trigger`` is the key of failsafe.yml that has to answer; ``of_sticks``: only where the sticks
    fly. ``needs`` are the configuration's values (file, keys) without which the failure does not
    exist. ``may_land``: a gentle touch-down is no crash. ``is_blown``: the wind is stronger than
    the aircraft, so that nothing brings it home.
    """

    code: str
    about: str
    begin: Mapping[str, Any] = field(default_factory=dict)
    end: Mapping[str, Any] = field(default_factory=dict)
    lasts_s: float | None = None
    order_s: float = 10.0
    rest_s: float = 15.0
    trigger: str = ""
    of_sticks: bool = False
    needs: tuple[str, ...] = ()
    points: tuple[str, ...] = tuple(POINTS)
    border: str = ""
    may_land: bool = False
    is_blown: bool = False


LOW, CRITICAL = "low_v", "critical_v"
ROWS = (
    Row("receiver_lost", "the receiver is lost", {"receiver": "lost"}, trigger="receiver_lost",
        of_sticks=True),
    Row("receiver_out_of_range", "the transmitter is out of range", {"receiver": "failsafe"},
        trigger="receiver_lost", of_sticks=True, points=("climb", "far")),
    Row("uplink_lost", "the uplink is lost", {"link": "blackout"}, trigger="uplink_lost"),
    Row("flight_battery_critical", "the flight battery is critically low",
        {"flight_battery": CRITICAL}, trigger="flight_battery_critical",
        needs=("flight_battery.yml", CRITICAL), rest_s=45.0),
    Row("flight_battery_low", "the flight battery is low", {"flight_battery": LOW},
        trigger="flight_battery_low", needs=("flight_battery.yml", LOW), points=("home", "turn")),
    Row("phone_battery", "the phone's battery is low", {"phone_battery": 3.0},
        trigger="phone_battery", points=("home", "turn")),
    Row("fence_radius", "the aircraft flies towards the fence", trigger="fence",
        needs=("failsafe.yml", "fence", "radius_m"), points=("border",), border="radius_m"),
    Row("fence_ceiling", "the aircraft climbs towards the fence's ceiling", trigger="fence",
        needs=("failsafe.yml", "fence", "ceiling_m"), points=("border",), border="ceiling_m"),
    Row("fence_floor", "the aircraft sinks towards the fence's floor", trigger="fence",
        needs=("failsafe.yml", "fence", "floor_m"), points=("border",), border="floor_m"),
    Row("no_progress", "the head wind is stronger than the aircraft", trigger="no_progress",
        points=("home",), is_blown=True),
    Row("gps_lost", "the GPS is lost for 20 s", {"gps": "lost"}, {"gps": "back"}, 20.0),
    Row("gps_jumped", "the GPS jumps by 300 m for 8 s", {"gps": "jumped"}, {"gps": "back"}, 8.0,
        15.0),
    Row("gps_frozen", "the GPS is frozen for 15 s", {"gps": "frozen"}, {"gps": "back"}, 15.0),
    Row("phone_lost", "the phone is unplugged for 20 s", {"phone": "unplugged"},
        {"phone": "back"}, 20.0, 15.0),
    Row("daemon_killed", "Raspilot is killed and starts again after 3 s", {"raspilot": "killed"},
        {"raspilot": "started"}, 3.0),
    Row("serial_cut", "the serial line is cut for 8 s", {"serial": "unplugged"},
        {"serial": "back"}, 8.0),
    Row("motor_stopped", "the motor stops silently", {"motor": "stopped"}, may_land=True),
    Row("imu_frozen", "the IMU is frozen for 3 s", {"imu": "frozen"}, {"imu": "well"}, 3.0),
    Row("board_reset", "the Arduino hangs and its watchdog resets it", {"reset": "watchdog"},
        lasts_s=1.0),
)  # fmt: skip
CODES = tuple(row.code for row in ROWS)
GPS_FAULTS = ("lost", "jumped", "frozen")


def row_of(code: str) -> Row:
    """Return the row of a code, which must exist."""
    return next(row for row in ROWS if row.code == code)


def point_of(name: str) -> Point:
    """Return a point of a flight by its name."""
    return POINTS.get(name, BORDER)

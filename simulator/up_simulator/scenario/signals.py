"""The signals that a flight logs and evaluates."""

from __future__ import annotations

import enum
from collections.abc import Iterator
from dataclasses import dataclass

from up.commands.board_schema import (
    DATA,
    FLIGHT_MODES,
    RESET_CAUSES,
    SWITCH_POSITIONS,
)
from up.commands.telemetry_schema import FIELDS
from up.fields import suggestion
from up_simulator.sensors.chips import CHIPS

_MODES = tuple(FLIGHT_MODES.values())
_POSITIONS = tuple(SWITCH_POSITIONS.values())
_SOURCES = ("arduino", "android", "gps", *CHIPS)
_CAUSES = tuple(RESET_CAUSES.values())
_VALUES: dict[str, tuple[str, ...]] = {
    "board.mode": _MODES,
    "board.switch": (*_POSITIONS, "not known"),
    "board.reset_cause": tuple(cause for cause in _CAUSES if " " not in cause),
    "ground.arduino.framing": ("checked", "thesis"),
    "ground.arduino.switch": _POSITIONS,
    "ground.arduino.reset_cause": (*_CAUSES, "unknown"),
    "ground.mode": ("flight controller", "black box", "black box (provisional)"),
    "ground.flight_mode": _MODES,
    "ground.flight_controller": ("arduino", "raspberry"),
    "mavlink.ack": (
        "ACCEPTED",
        "TEMPORARILY_REJECTED",
        "DENIED",
        "UNSUPPORTED",
        "FAILED",
        "IN_PROGRESS",
    ),
}
_SEPARATORS = {"board.reset_cause": " ", "ground.arduino.reset_cause": ", "}
"""Separators for signals that may have several values at a time."""


def values_of(name: str) -> tuple[str, ...]:
    """Return the allowed values of a text signal; empty if it may be any text."""
    return _SOURCES if name.startswith("ground.source.") else _VALUES.get(name, ())


def value_problem(name: str, text: str) -> str:
    """Return a sentence if the signal never has that value, with a suggestion."""
    values = values_of(name)
    parts = text.split(_SEPARATORS[name]) if name in _SEPARATORS else [text]
    wrong = next((part for part in parts if part not in values), None)
    if not values or wrong is None:
        return ""
    hint = suggestion(wrong, values) or f": it has {', '.join(values)}"
    return f'{name} is never "{wrong[:60]}"{hint}'


class Kind(enum.Enum):
    """The type of a signal's values."""

    NUMBER = "number"
    FLAG = "flag"
    TEXT = "text"


@dataclass(frozen=True, slots=True)
class Signal:
    """One column of a flight's log; it exists only if the part ``source`` flies."""

    name: str
    about: str
    unit: str = ""
    kind: Kind = Kind.NUMBER

    @property
    def source(self) -> str:
        """Return the part before the first dot: truth, board, ground..."""
        return self.name.partition(".")[0]


_FLAG, _TEXT = Kind.FLAG, Kind.TEXT
_KINDS = {"flag": Kind.FLAG, "text": Kind.TEXT, "number": Kind.NUMBER}
_STICKS = ("ailerons", "elevator", "throttle", "rudder", "aux1", "aux2")
_SERVOS = _STICKS[:4]


def _truth() -> Iterator[Signal]:
    for name, unit, about in (
        ("roll_deg", "deg", "bank, right wing down positive"),
        ("pitch_deg", "deg", "pitch, nose up positive"),
        ("yaw_deg", "deg", "direction of the nose, 0 is north"),
        ("roll_rate_deg_s", "deg/s", "rotation about the long axis"),
        ("pitch_rate_deg_s", "deg/s", "rotation about the wing"),
        ("yaw_rate_deg_s", "deg/s", "rotation about the vertical axis of the body"),
        ("latitude_deg", "deg", "position"),
        ("longitude_deg", "deg", "position"),
        ("north_m", "m", "distance north of the start"),
        ("east_m", "m", "distance east of the start"),
        ("altitude_m", "m", "above the sea"),
        ("height_m", "m", "above the ground"),
        ("climb_m_s", "m/s", "up positive"),
        ("speed_m_s", "m/s", "over the ground"),
        ("track_deg", "deg", "course over the ground"),
        ("airspeed_m_s", "m/s", "through the air"),
        ("alpha_deg", "deg", "angle of attack"),
        ("sideslip_deg", "deg", "angle of the airflow from the side"),
        ("load_factor_g", "g", "load on the wing, 1 in level flight"),
        ("battery_v", "V", "voltage of the flight battery under load"),
        ("battery_percent", "%", "charge of the flight battery"),
        ("motor_rpm", "1/min", "speed of the propeller"),
        ("motor_w", "W", "power of the motor"),
        ("wind_north_m_s", "m/s", "speed of the air to the north, with gusts and turbulence"),
        ("wind_east_m_s", "m/s", "speed of the air to the east"),
        ("wind_down_m_s", "m/s", "speed of the air down"),
    ):
        yield Signal(f"truth.{name}", about, unit)
    yield Signal("truth.crashed", "it has hit the ground or broken up", kind=_FLAG)


def _pilot() -> Iterator[Signal]:
    for channel in _STICKS:
        yield Signal(f"stick.{channel}_us", f"pulse of the stick: {channel}", "us")
    for channel in _SERVOS:
        yield Signal(f"servo.{channel}_us", f"pulse measured at the output: {channel}", "us")
    yield Signal(
        "servo.stale_ms",
        "longest time that any output had no new pulse, since the previous row",
        "ms",
    )


def _board() -> Iterator[Signal]:
    yield Signal("board.mode", "mode of the Arduino: ACRO, RATE, FBW, SETPOINT...", kind=_TEXT)
    for datum in DATA:
        if datum.signal:
            yield Signal(f"board.{datum.signal}", datum.about, datum.unit, _KINDS[datum.kind])
    yield Signal("board.switch", "position of AUX1: low, middle, high", kind=_TEXT)
    yield Signal("board.reset_cause", "cause of the last reset", kind=_TEXT)
    for name, unit, about in (
        ("roll_deg", "deg", "bank estimated by the Arduino"),
        ("pitch_deg", "deg", "pitch estimated by the Arduino"),
        ("yaw_deg", "deg", "yaw estimated by the Arduino, without a magnetometer"),
        ("roll_rate_deg_s", "deg/s", "rate of its gyroscope"),
        ("pitch_rate_deg_s", "deg/s", "rate of its gyroscope"),
        ("yaw_rate_deg_s", "deg/s", "rate of its gyroscope"),
        ("status_age_s", "s", "since its newest status was received"),
        ("orientation_age_s", "s", "since its newest orientation was received"),
        ("bad_frames", "", "frames of the Arduino that a listener on the line dropped"),
    ):
        yield Signal(f"board.{name}", about, unit)


def _demand() -> Iterator[Signal]:
    for name, unit, about in (
        ("roll_deg", "deg", "bank demanded by sticks, failsafe or set-point"),
        ("pitch_deg", "deg", "pitch demanded by sticks, failsafe or set-point"),
        ("roll_rate_deg_s", "deg/s", "roll rate demanded by the stick in RATE"),
        ("pitch_rate_deg_s", "deg/s", "pitch rate demanded by the stick in RATE"),
    ):
        yield Signal(f"demand.{name}", about, unit)
        yield Signal(f"error.{name}", f"truth.{name} minus demand.{name}", unit)
    for name in ("roll_deg", "pitch_deg"):
        yield Signal(f"estimate_error.{name}", f"board.{name} minus truth.{name}", "deg")


def _distance() -> Iterator[Signal]:
    for name, place in (
        ("estimate", "position that telemetry reports: it includes the way since then"),
        ("home", "home that telemetry reports"),
        ("target", "target that telemetry reports: where the flight mode flies to"),
    ):
        yield Signal(f"distance.{name}_m", f"distance from the {place}", "m")


def _daemon() -> Iterator[Signal]:
    yield Signal("raspilot.running", "the daemon's process runs", kind=_FLAG)
    yield Signal("phone.plugged", "the cable of the phone is plugged in", kind=_FLAG)


def _ground() -> Iterator[Signal]:
    yield Signal("ground.age_s", "since the newest telemetry arrived", "s")
    yield Signal(
        "ground.latency_s",
        "age of telemetry on arrival, the maximum since the previous row",
        "s",
    )
    yield Signal("ground.frames", "number of telemetry frames received")
    yield Signal("ground.connected", "it has a connection, to its knowledge", kind=_FLAG)
    yield Signal("ground.in_control", "it has control at the proxy", kind=_FLAG)
    for field in FIELDS:
        if field.type != "object":
            about = f"telemetry {field.path} (docs/protocols.md 6)"
            kind = _KINDS.get(field.type, Kind.TEXT)
            yield Signal(f"ground.{field.path}", about, field.unit, kind)


def _adapters() -> Iterator[Signal]:
    places = "at the places of the shipped osd.yml"
    yield Signal("goggles.mode", f"the shown flight mode, {places}", kind=_TEXT)
    yield Signal("goggles.warning", f"the shown warning, {places}; empty: none", kind=_TEXT)
    yield Signal("goggles.satellites", "the shown number of satellites, or dashes", kind=_TEXT)
    yield Signal("goggles.altitude_m", "the shown height above home", "m")
    yield Signal(
        "goggles.altitude_error_m",
        "the shown height minus the true one above the home that telemetry reports",
        "m",
    )
    yield Signal("goggles.bytes", "bytes received")
    yield Signal("goggles.errors", "frames that no goggles understand")
    yield Signal("metrics.age_s", "since the newest page of metrics arrived", "s")
    yield Signal("metrics.figures", "number of figures on it")
    yield Signal(
        "mavlink.mode", "flight mode in the aircraft's heartbeat, as ArduPlane's", kind=_TEXT
    )
    yield Signal("mavlink.ack", "answer to the newest selection of a mode; empty: none", kind=_TEXT)
    yield Signal("mavlink.altitude_m", "altitude above the sea that it shows", "m")
    yield Signal("mavlink.altitude_error_m", "that altitude minus the true one", "m")
    yield Signal("mavlink.age_s", "since the newest heartbeat of the aircraft", "s")
    yield Signal("mavlink.errors", "received data that are no packets")


def _all() -> Iterator[Signal]:
    yield Signal("time_s", "since the flight began", "s")
    yield from _truth()
    yield from _pilot()
    yield from _board()
    yield from _demand()
    yield from _daemon()
    yield from _distance()
    yield from _ground()
    yield from _adapters()


EVENT_COLUMN = "event"
"""Last column of the log: the events since the previous row, empty if none."""
SIGNALS = {signal.name: signal for signal in _all()}
FREE_PREFIXES = {"ground.counters.": 3, "metrics.up_telemetry.": 2, "metrics.up_counters.": 3}
"""Prefixes of the counters of the modules and of metrics, and the least number of dots."""


def signal_of(name: str) -> Signal:
    """Return the signal of that name; raises KeyError with a sentence that suggests another."""
    if name in SIGNALS:
        return SIGNALS[name]
    dots = next((each for prefix, each in FREE_PREFIXES.items() if name.startswith(prefix)), None)
    if dots is not None and name.count(".") >= dots and not name.endswith("."):
        return Signal(name, f"telemetry {name.partition('.')[2]}")
    same_end = (each for each in SIGNALS if each.rpartition(".")[2] == name.lower())
    near = suggestion(name, SIGNALS) or suggestion(next(same_end, ""), SIGNALS)
    near = near or " ('up-sim signals' lists them)"
    raise KeyError(f"unknown signal{near}")

"""The names of everything that a flight is logged and judged by."""

from __future__ import annotations

import difflib
import enum
from collections.abc import Iterator
from dataclasses import dataclass

_MODES = ("ACRO", "RATE", "FBW", "SETPOINT", "OUTPUT", "RTH")
_POSITIONS = ("low", "middle", "high")
_SOURCES = ("arduino", "android")
_CAUSES = ("power-on", "external", "brown-out", "watchdog", "state restored", "unknown")
_WORDS: dict[str, tuple[str, ...]] = {
    "board.mode": _MODES,
    "board.switch": (*_POSITIONS, "not known"),
    "board.reset_cause": ("power", "button", "brown-out", "watchdog"),
    "ground.arduino.framing": ("checked", "thesis"),
    "ground.arduino.switch": _POSITIONS,
    "ground.arduino.reset_cause": _CAUSES,
    "ground.mode": ("flight controller", "black box", "black box (provisional)"),
    "ground.flight_mode": _MODES,
    "ground.flight_controller": ("arduino", "raspberry"),
    "ground.flight_control.mode": ("ACRO", "RATE", "FBW", "AUTO"),
}
_SEVERAL = {"board.reset_cause": " ", "ground.arduino.reset_cause": ", "}
"""Separators for signals that may have several values at a time."""


def words_of(name: str) -> tuple[str, ...]:
    """Return the words of a signal; empty where it may be any text."""
    return _SOURCES if name.startswith("ground.source.") else _WORDS.get(name, ())


def word_problem(name: str, text: str) -> str:
    """Return a sentence if the signal never has that value, with the probable intention."""
    words = words_of(name)
    parts = text.split(_SEVERAL[name]) if name in _SEVERAL else [text]
    wrong = next((part for part in parts if part not in words), None)
    if not words or wrong is None:
        return ""
    by_lower = {word.lower(): word for word in words}
    near = difflib.get_close_matches(wrong.lower()[:80], by_lower, n=1)
    hint = f"did you mean '{by_lower[near[0]]}'?" if near else f"it has {', '.join(words)}"
    return f'{name} is never "{wrong[:60]}": {hint}'


class Kind(enum.Enum):
    """The type of a signal's values."""

    NUMBER = "number"
    FLAG = "flag"
    WORD = "word"


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


_FLAG, _WORD = Kind.FLAG, Kind.WORD
_STICKS = ("ailerons", "elevator", "throttle", "rudder", "aux1", "aux2")
_SERVOS = _STICKS[:4]


def _truth() -> Iterator[Signal]:
    for name, unit, about in (
        ("roll_deg", "deg", "bank, right wing down positive"),
        ("pitch_deg", "deg", "pitch, nose up positive"),
        ("yaw_deg", "deg", "where the nose points, 0 is north"),
        ("roll_rate_deg_s", "deg/s", "rotation about the long axis"),
        ("pitch_rate_deg_s", "deg/s", "rotation about the wing"),
        ("yaw_rate_deg_s", "deg/s", "rotation about the vertical axis of the body"),
        ("latitude_deg", "deg", "where it is"),
        ("longitude_deg", "deg", "where it is"),
        ("north_m", "m", "how far north of the start"),
        ("east_m", "m", "how far east of the start"),
        ("altitude_m", "m", "above the sea"),
        ("height_m", "m", "above the ground"),
        ("climb_m_s", "m/s", "up positive"),
        ("speed_m_s", "m/s", "over the ground"),
        ("track_deg", "deg", "where it goes over the ground"),
        ("airspeed_m_s", "m/s", "through the air"),
        ("alpha_deg", "deg", "angle of attack"),
        ("sideslip_deg", "deg", "angle of the air from the side"),
        ("load_factor_g", "g", "what the wing carries, 1 in level flight"),
        ("battery_v", "V", "the flight battery under its load"),
        ("battery_percent", "%", "what is left in the flight battery"),
        ("motor_rpm", "1/min", "the propeller"),
        ("motor_w", "W", "what the motor takes"),
        ("wind_north_m_s", "m/s", "how fast the air goes north, with gusts and turbulence"),
        ("wind_east_m_s", "m/s", "how fast the air goes east"),
        ("wind_down_m_s", "m/s", "how fast the air sinks"),
    ):
        yield Signal(f"truth.{name}", about, unit)
    yield Signal("truth.crashed", "it has hit the ground or broken", kind=_FLAG)


def _pilot() -> Iterator[Signal]:
    for channel in _STICKS:
        yield Signal(f"stick.{channel}_us", f"the pulse that the pilot gives: {channel}", "us")
    for channel in _SERVOS:
        yield Signal(f"servo.{channel}_us", f"the pulse measured at the output: {channel}", "us")
    yield Signal(
        "servo.stale_ms",
        "the longest that any output had no new pulse since the row before",
        "ms",
    )


def _board() -> Iterator[Signal]:
    yield Signal("board.mode", "what the Arduino flies: ACRO, RATE, FBW, SETPOINT...", kind=_WORD)
    for name, about in (
        ("armed", "the motor and the Raspberry Pi may act"),
        ("auto", "the mode switch stands at AUTO"),
        ("failsafe", "it flies the circle of a lost receiver"),
        ("imu_valid", "the attitude can be flown by"),
        ("receiver_valid", "the receiver can be flown by"),
        ("restored", "the last reset came in flight and the state before it came back"),
        ("pi_heard", "the Raspberry Pi was heard within a second"),
        ("gains_valid", "the EEPROM holds gains"),
    ):
        yield Signal(f"board.{name}", about, kind=_FLAG)
    yield Signal("board.switch", "where AUX1 stands: low, middle, high", kind=_WORD)
    yield Signal("board.reset_cause", "of the last reset", kind=_WORD)
    for name, unit, about in (
        ("roll_deg", "deg", "bank as the Arduino estimates it"),
        ("pitch_deg", "deg", "pitch as the Arduino estimates it"),
        ("yaw_deg", "deg", "yaw as the Arduino estimates it, without a magnetometer"),
        ("roll_rate_deg_s", "deg/s", "its gyroscope"),
        ("pitch_rate_deg_s", "deg/s", "its gyroscope"),
        ("yaw_rate_deg_s", "deg/s", "its gyroscope"),
        ("loop_us", "us", "period of its loop, mean of a second"),
        ("loop_late_us", "us", "greatest lateness of its loop in a second"),
        ("dropped_frames", "", "frames from the Raspberry Pi that it dropped"),
        ("missing_frames", "", "frames from the Raspberry Pi that never came"),
        ("receiver_age_ms", "ms", "age of the newest pulses"),
        ("imu_age_ms", "ms", "age of the newest sample"),
        ("uptime_s", "s", "since its reset"),
        ("status_age_s", "s", "since its newest status was heard"),
        ("orientation_age_s", "s", "since its newest orientation was heard"),
        ("bad_frames", "", "frames of the Arduino that a listener on the line had to drop"),
    ):
        yield Signal(f"board.{name}", about, unit)


def _demand() -> Iterator[Signal]:
    for name, unit, about in (
        ("roll_deg", "deg", "the bank that sticks, failsafe or setpoint ask for"),
        ("pitch_deg", "deg", "the pitch that sticks, failsafe or setpoint ask for"),
        ("roll_rate_deg_s", "deg/s", "the roll rate that the stick asks for in RATE"),
        ("pitch_rate_deg_s", "deg/s", "the pitch rate that the stick asks for in RATE"),
    ):
        yield Signal(f"demand.{name}", about, unit)
        yield Signal(f"error.{name}", f"truth.{name} less demand.{name}", unit)
    for name in ("roll_deg", "pitch_deg"):
        yield Signal(f"estimate_error.{name}", f"board.{name} less truth.{name}", "deg")


def _daemon() -> Iterator[Signal]:
    yield Signal("raspilot.running", "the daemon's process runs", kind=_FLAG)
    yield Signal("phone.plugged", "the phone's cable is in", kind=_FLAG)


def _ground() -> Iterator[Signal]:
    yield Signal("ground.age_s", "since the newest telemetry came", "s")
    yield Signal(
        "ground.latency_s",
        "how old telemetry was when it came, the oldest since the row before",
        "s",
    )
    yield Signal("ground.frames", "telemetry frames that have come")
    yield Signal("ground.connected", "it has a connection, as far as it knows", kind=_FLAG)
    for group, unit in (("orientation", "deg"), ("rates", "deg/s")):
        for axis in ("roll", "pitch", "yaw"):
            yield _telemetry(f"{group}.{axis}", unit)
    for channel in _STICKS:
        yield _telemetry(f"rx.{channel}", "us")
    for channel in _SERVOS:
        yield _telemetry(f"servo.{channel}", "us")
    for name, unit in (
        ("location.latitude", "deg"),
        ("location.longitude", "deg"),
        ("location.altitude", "m"),
        ("home.distance", "m"),
        ("home.bearing", "deg"),
        ("altitude", "m"),
        ("heading.actual", "deg"),
        ("heading.required", "deg"),
        ("android.batteryLevel", "%"),
        ("arduino.loop_us", "us"),
        ("arduino.late_us", "us"),
        ("arduino.frame_errors", ""),
        ("load.cpu", "%"),
        ("load.ram", "%"),
        ("load.delay_ms", "ms"),
        ("system.uptime_s", "s"),
    ):
        yield _telemetry(name, unit)
    for name in (
        "android.connected",
        "arduino.connected",
        "arduino.failsafe",
        "arduino.restored",
        "arduino.bias_stored",
        "arduino.receiver_valid",
        "arduino.imu_valid",
        "load.panic",
        "armed",
    ):
        yield _telemetry(name, kind=_FLAG)
    for name in (
        "arduino.framing",
        "arduino.switch",
        "arduino.reset_cause",
        "mode",
        "flight_mode",
        "flight_controller",
        "flight_control.mode",
        "vetoes",
    ):
        yield _telemetry(name, kind=_WORD)
    for reading in _READINGS:
        yield _telemetry(f"age_ms.{reading}", "ms")
        yield _telemetry(f"source.{reading}", kind=_WORD)


_READINGS = ("orientation", "rx", "servo", "location", "altitude", "heading", "battery")


def _telemetry(key: str, unit: str = "", kind: Kind = Kind.NUMBER) -> Signal:
    return Signal(f"ground.{key}", f"telemetry {key} (docs/protocols.md 6)", unit, kind)


def _all() -> Iterator[Signal]:
    yield Signal("time_s", "since the flight began", "s")
    yield from _truth()
    yield from _pilot()
    yield from _board()
    yield from _demand()
    yield from _daemon()
    yield from _ground()


EVENT_COLUMN = "event"
"""The log's last column: the events since the row before, empty without one."""
SIGNALS = {signal.name: signal for signal in _all()}
FREE_PREFIX = "ground.counters."
"""The names behind it are the modules' counters."""


def signal_of(name: str) -> Signal:
    """Return the signal of that name; raises KeyError with a sentence that suggests another."""
    if name in SIGNALS:
        return SIGNALS[name]
    if name.startswith(FREE_PREFIX) and name.count(".") >= 3 and not name.endswith("."):
        return Signal(name, f"telemetry {name.partition('.')[2]}")
    near = difflib.get_close_matches(name.lower()[:80], SIGNALS, n=1)
    if not near:
        near = [each for each in SIGNALS if each.rpartition(".")[2] == name.lower()][:1]
    hint = f", did you mean '{near[0]}'?" if near else " ('up-sim signals' lists them)"
    raise KeyError(f"there is no signal of that name{hint}")

"""A recorded flight, looped, which is the flight without JSBSim; and the log that records one."""

from __future__ import annotations

import csv
import gzip
import io
import math
import zlib
from bisect import bisect_right
from dataclasses import MISSING, astuple, fields, replace
from importlib import resources
from pathlib import Path

from up_rig.imu import Motion, motion_at
from up_simulator.aircraft.airframe_file import PIN_V
from up_simulator.aircraft.flight import NEUTRAL, FlightState, FlightUnavailableError, Servos

BLEND_S = 4.0
SHIPPED = "recorded_flight.csv.gz"
COLUMNS = tuple(field.name for field in fields(FlightState) if field.default is MISSING)
SERVO_COLUMNS = ("ailerons_us", "elevator_us", "throttle_us", "rudder_us")
DECIMALS = {"latitude_deg": 8, "longitude_deg": 8, "time_s": 3}
LOG_PERIOD_S = 0.02
ANGLES = ("roll_deg", "pitch_deg", "yaw_deg", "track_deg")


class RecordedFlight:
    """Plays a state log in a loop; the servo commands have no effect on it, and it never crashes.

    The IMU feels the recorded attitude and rates, and 1 g, whatever it felt then. The last
    ``BLEND_S`` of the recording fade into its beginning, and each round starts where the one before
    ended, so that neither attitude nor position jumps.
    """

    motor_works = True
    is_thrown = True

    def __init__(self, states: list[FlightState]) -> None:
        start_s = states[0].time_s
        self._states = [replace(each, time_s=each.time_s - start_s) for each in states]
        self._times_s = [each.time_s for each in self._states]
        self._round_s = self._times_s[-1] - BLEND_S
        if self._round_s < BLEND_S:
            raise FlightUnavailableError(
                f"a recorded flight takes at least {2 * BLEND_S:.0f} s, this one has "
                f"{self._times_s[-1]:.1f} s"
            )
        first, last = self._at(0.0), self._at(self._round_s)
        self._drift_deg = (
            last.latitude_deg - first.latitude_deg,
            last.longitude_deg - first.longitude_deg,
        )
        self._time_s = 0.0
        self._servos: Servos = NEUTRAL
        self._state = self._at(0.0)

    @property
    def state(self) -> FlightState:
        return self._state

    @property
    def servos(self) -> Servos:
        return self._servos

    @property
    def a7_v(self) -> float:
        """Return the end of the ADC, where the voltage is unknown: it has no battery."""
        return PIN_V

    @property
    def crash(self) -> str | None:
        return None

    @property
    def is_landed(self) -> bool:
        return False

    @property
    def motion(self) -> Motion:
        state = self._state
        rates = (state.roll_rate_deg_s, state.pitch_rate_deg_s, state.yaw_rate_deg_s)
        return motion_at(state.roll_deg, state.pitch_deg, rates)

    def set_charge(self, percent: float) -> None:
        """Do nothing: it has no battery."""

    def set_servos(self, pulses_us: tuple[float, float, float, float]) -> None:
        ailerons, elevator, throttle, rudder = (round(each) for each in pulses_us)
        self._servos = (ailerons, elevator, throttle, rudder)

    def launch(self, start: object) -> None:
        """Do nothing: it flies anyway."""

    def change_battery(self) -> None:
        """Do nothing: it has none."""

    def advance(self, duration_s: float) -> None:
        self._time_s += duration_s
        rounds, phase_s = divmod(self._time_s, self._round_s)
        state = self._at(phase_s)
        north_deg, east_deg = self._drift_deg
        if rounds and phase_s < BLEND_S:
            tail = self._at(self._round_s + phase_s)
            tail = replace(
                tail,
                latitude_deg=tail.latitude_deg - north_deg,
                longitude_deg=tail.longitude_deg - east_deg,
            )
            state = _between(tail, state, phase_s / BLEND_S)
        self._state = replace(
            state,
            time_s=self._time_s,
            latitude_deg=state.latitude_deg + rounds * north_deg,
            longitude_deg=state.longitude_deg + rounds * east_deg,
        )

    def _at(self, time_s: float) -> FlightState:
        after = bisect_right(self._times_s, time_s)
        if after == len(self._states):
            return self._states[-1]
        left, right = self._states[after - 1], self._states[after]
        return _between(left, right, (time_s - left.time_s) / (right.time_s - left.time_s))


def read_recording(path: Path | None) -> RecordedFlight:
    """Return the flight of a state log, plain or gzipped; None: the one shipped here.

    Raises ``FlightUnavailableError`` for an invalid file, naming the line.
    """
    try:
        if path is None:
            data = resources.files("up_simulator.aircraft").joinpath(SHIPPED).read_bytes()
        else:
            data = path.read_bytes()
        if data[:2] == b"\x1f\x8b":
            data = gzip.decompress(data)
        text = data.decode("utf-8")
    except OSError as error:
        raise FlightUnavailableError(
            f"cannot read the recorded flight {path}: {error.strerror or error}"
        ) from error
    except (EOFError, zlib.error, UnicodeDecodeError) as error:
        raise FlightUnavailableError(f"cannot read the recorded flight {path}: {error}") from error
    name = str(path or SHIPPED)
    try:
        return RecordedFlight(_states(text, name))
    except csv.Error as error:
        raise FlightUnavailableError(f"{name}: not a recorded flight: {error}") from error


def _states(text: str, name: str) -> list[FlightState]:
    states: list[FlightState] = []
    rows = csv.DictReader(io.StringIO(text))
    missing = [column for column in COLUMNS if column not in (rows.fieldnames or ())]
    if missing:
        raise FlightUnavailableError(f"{name}:1: not a recorded flight, no column {missing[0]}")
    for row in rows:
        try:
            state = FlightState(*(float(row[column]) for column in COLUMNS))
        except (TypeError, ValueError):
            state = None
        if state is None or not all(map(math.isfinite, astuple(state))):
            raise FlightUnavailableError(f"{name}:{rows.line_num}: a value is not a number")
        if states and state.time_s <= states[-1].time_s:
            raise FlightUnavailableError(f"{name}:{rows.line_num}: time does not rise")
        states.append(state)
    if len(states) < 2:
        raise FlightUnavailableError(f"{name}: a recorded flight has at least two lines")
    return states


def _between(left: FlightState, right: FlightState, share: float) -> FlightState:
    """Return the state ``share`` (0 to 1) of the way, angles the short way round."""
    values: list[float] = []
    for name in COLUMNS:
        start, end = getattr(left, name), getattr(right, name)
        way = end - start
        if name in ANGLES:
            way = (way + 180.0) % 360.0 - 180.0
        value = start + share * way
        values.append(value % 360.0 if name in ("yaw_deg", "track_deg") else value)
    return FlightState(*values)


class StateLog:
    """A CSV line for every 20 ms of flight, flushed immediately.

    Columns are ``COLUMNS``, then the four servo
    positions (us). The file can be flown again with ``--replay``. Raises ``OSError`` when it cannot
    be written.
    """

    def __init__(self, path: Path) -> None:
        self._file = path.open("w", encoding="ascii", buffering=1)
        self._file.write(",".join(COLUMNS + SERVO_COLUMNS) + "\n")
        self._next_s = 0.0

    def record(self, state: FlightState, servos_us: Servos) -> None:
        """Write a line when the next 20 ms are over."""
        if state.time_s < self._next_s - 1e-9:
            return
        self._next_s = state.time_s + LOG_PERIOD_S
        values = [f"{getattr(state, name):.{DECIMALS.get(name, 3)}f}" for name in COLUMNS]
        self._file.write(",".join([*values, *map(str, servos_us)]) + "\n")

    def close(self) -> None:
        self._file.close()

"""What each serial Command does to the board, and what it answers."""

from __future__ import annotations

import math
import struct
from typing import Protocol

from up_simulator.authority import OUTPUT, SETPOINT, Authority
from up_simulator.flight import Flight
from up_simulator.memory import Gains, OutOfRangeError, read_profile
from up_simulator.reason import Reason, RefusedError
from up_simulator.wire import THESIS_TYPES, Command

Answer = tuple[str, bytes] | None

VETO_LIVES_S = 1.0
OUTPUT_AGE_S = 0.1
STILL_DEG_S = 2.0
GROUND_MODES = frozenset(b"rfsu")
ENDS_BEGIN, ENDS_END, HIGHEST_CALIBRATION = 1, 2, 3


class Commanded(Protocol):
    """What the Commands ask of the board."""

    flight: Flight
    authority: Authority
    gains: Gains
    is_started: bool
    is_thesis: bool
    period_s: float

    def orientation_age_s(self, sequence: int, now_s: float) -> float:
        """Return how long ago the orientation with this sequence was sent."""


class CommandTable:
    """Carries out the Commands of protocols 2.3; raises ``RefusedError`` with the reason of 2.5.

    Returns the answer where it is no plain confirmation. Location, altitude and headings are
    checked and then unused, as nothing here navigates.
    """

    def __init__(self, board: Commanded) -> None:
        self._board = board

    def carry_out(self, command: Command, now_s: float) -> Answer:
        """Do what the Command says."""
        board, payload = self._board, command.payload
        if board.is_thesis and command.type not in THESIS_TYPES:
            raise RefusedError(Reason.NOT_IN_THESIS_FRAMING)
        if not self.is_in_range(command):
            raise RefusedError(Reason.OUT_OF_RANGE)
        match command.type:
            case "s":
                board.is_started = True
            case "a":
                board.authority.arm(now_s)
            case "d":
                board.authority.disarm(now_s)
            case "M":
                board.authority.ask_mode(payload.decode("ascii"), now_s)
            case "m":
                return "m", board.authority.mode(now_s).encode("ascii")
            case "p":
                board.period_s = _i16(payload[1:]) / 1000
            case "t":
                board.gains.set_two_axes(payload)
            case "g":
                board.gains.set_three_axes(payload)
            case "T":
                return "T", board.gains.two_axes
            case "G":
                return "G", board.gains.three_axes
            case "u":
                self._take_output(payload, now_s)
            case "S":
                self._take_setpoint(payload, now_s)
            case "v":
                board.authority.veto_until_s = now_s + VETO_LIVES_S if payload[0] else now_s
            case "C":
                self._require_disarmed()
                board.authority.profile = read_profile(payload)
            case "c":
                return "C", board.authority.profile.wire
            case "e":
                self._calibrate(payload[0])
        return None

    def is_in_range(self, command: Command) -> bool:
        """Return whether every field is within the range that the page gives."""
        payload = command.payload
        match command.type:
            case "M":
                return payload[0] in GROUND_MODES
            case "p":
                return payload[0] <= 1 and 10 <= _i16(payload[1:]) <= 1000
            case "t" | "g" | "C":
                return _is_taken(command)
            case "b" | "B":
                return 0 <= _i16(payload) <= 359
            case "l":
                latitude_deg, longitude_deg = struct.unpack(">2f", payload)
                is_place: bool = abs(latitude_deg) <= 90 and abs(longitude_deg) <= 180
                return is_place
            case "u":
                ailerons, elevator, throttle, rudder = _pulses(payload)
                return all(1000 <= each <= 2000 for each in (ailerons, elevator, rudder)) and (
                    _is_throttle(throttle)
                )
            case "S":
                roll, pitch, _yaw_rate, throttle, lifetime_ms = struct.unpack(">3h2H", payload)
                is_attitude: bool = abs(roll) <= 18000 and abs(pitch) <= 9000
                return is_attitude and _is_throttle(throttle) and 1 <= lifetime_ms <= 250
            case "v":
                return payload[0] <= 1
            case "e":
                return payload[0] <= HIGHEST_CALIBRATION
        return True

    def _take_output(self, payload: bytes, now_s: float) -> None:
        board = self._board
        board.authority.require_authority(OUTPUT, now_s)
        ailerons, elevator, throttle, rudder, sequence = struct.unpack(">5H", payload)
        if board.orientation_age_s(sequence, now_s) > OUTPUT_AGE_S:
            raise RefusedError(Reason.TOO_OLD)
        board.authority.follow((ailerons, elevator, throttle, rudder), now_s)

    def _take_setpoint(self, payload: bytes, now_s: float) -> None:
        self._board.authority.require_authority(SETPOINT, now_s)
        throttle_us, lifetime_ms = struct.unpack(">2H", payload[6:])
        self._board.authority.demand_throttle(throttle_us, lifetime_ms / 1000, now_s)

    def _require_disarmed(self) -> None:
        if self._board.authority.is_armed:
            raise RefusedError(Reason.ONLY_DISARMED)

    def _calibrate(self, what: int) -> None:
        self._require_disarmed()
        authority = self._board.authority
        if what == ENDS_BEGIN:
            authority.is_calibrating = True
        elif what == ENDS_END:
            if not authority.is_calibrating:
                raise RefusedError(Reason.OUT_OF_RANGE)
            authority.is_calibrating = False
        elif not self._is_still():
            raise RefusedError(Reason.NOT_STILL)

    def _is_still(self) -> bool:
        state = self._board.flight.state
        rates = (state.roll_rate_deg_s, state.pitch_rate_deg_s, state.yaw_rate_deg_s)
        return all(math.fabs(rate) <= STILL_DEG_S for rate in rates)


def _is_taken(command: Command) -> bool:
    """Return whether a set of gains or a profile would be taken whole."""
    try:
        if command.type == "C":
            read_profile(command.payload)
        elif command.type == "g":
            Gains().set_three_axes(command.payload)
        else:
            Gains().set_two_axes(command.payload)
    except OutOfRangeError:
        return False
    return True


def _i16(two_bytes: bytes) -> int:
    return int.from_bytes(two_bytes, "big", signed=True)


def _is_throttle(pulse_us: int) -> bool:
    return pulse_us == 0 or 1000 <= pulse_us <= 2000


def _pulses(payload: bytes) -> tuple[int, int, int, int]:
    ailerons, elevator, throttle, rudder = struct.unpack(">4H", payload[:8])
    return ailerons, elevator, throttle, rudder

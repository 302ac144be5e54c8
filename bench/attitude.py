"""How far the firmware's attitude is from the truth, with the gyro errors that each seed draws.

The navigation estimator of the Raspberry Pi gets the firmware's attitude and a phone's fixes, and
sends the airspeed, as in a flight.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterable
from typing import Any

from arduino_cog.modules.arduino_airspeed import PERIOD_S, payload_of
from arduino_cog.wire import OUTPUTS

from bench.table import LeftOutError, Row
from raspilot.navigation.estimator import Estimator
from raspilot.navigation.fix_gate import Fix
from up_simulator.aircraft import FlightDynamics, Start, Weather, load_airframe
from up_simulator.aircraft.flight import FlightUnavailableError
from up_simulator.firmware.build import BoardUnavailableError, choose_board
from up_simulator.firmware.imu_errors import ImuErrors, drawn_errors
from up_simulator.firmware.line_monitor import LineMonitor
from up_simulator.firmware.preparation import PreparationError, cached_eeprom
from up_simulator.harness.firmware_aircraft import FirmwareAircraft
from up_simulator.harness.user_log import no_log
from up_simulator.harness.workers import MAX_PROCESSES, Workers
from up_simulator.harness.world import World
from up_simulator.phone.sensors import PhoneSensors
from up_simulator.radio.circling_pilot import CirclingPilot

FLIGHTS, MINUTES = 20, 10
TARGET_DEG = 2.0
TICK_S = 0.004
STARVED_EVERY_S, STARVED_S = 2.0, (0.05, 1.5)
Errors = tuple[float, float]


def rows(quick: bool = False) -> Iterable[Row]:
    flights, minutes = (2, 1) if quick else (FLIGHTS, MINUTES)
    seeds = range(1, flights + 1)
    try:
        with Workers(MAX_PROCESSES) as workers:
            for has_raspberry in (True, False):
                flown = [(seed, minutes, False, None, has_raspberry) for seed in seeds]
                found = workers.fly(fly, flown)
                errors_deg = worst(each for flight in found for each in flight)
                which = "" if has_raspberry else ", without the Raspberry Pi"
                yield Row(
                    f"attitude error with drawn gyro errors, worst of {flights} flights of"
                    f" {minutes} min{which}",
                    _text(errors_deg),
                    target=f"<= {TARGET_DEG:.1f} deg" if has_raspberry else "",
                    met=max(errors_deg) <= TARGET_DEG if has_raspberry else None,
                )
    except (BoardUnavailableError, FlightUnavailableError, PreparationError) as error:
        raise LeftOutError(str(error)) from error


def worst(errors: Iterable[Errors]) -> Errors:
    roll_deg, pitch_deg = zip(*errors, strict=True)
    return max(roll_deg), max(pitch_deg)


class StarvedClock:
    """The clock of a process that is suspended every few seconds, or never."""

    def __init__(self, seed: int, is_starved: bool) -> None:
        self._chance = random.Random(f"starved {seed}")
        self._now_s = 0.0
        self._next_s = STARVED_EVERY_S if is_starved else math.inf

    def seconds(self) -> float:
        return self._now_s

    def tick(self) -> None:
        """Advance the time until the process runs again."""
        self._now_s += TICK_S
        if self._now_s >= self._next_s:
            self._now_s += self._chance.uniform(*STARVED_S)
            self._next_s = self._now_s + STARVED_EVERY_S


class ComparingLine:
    """A serial line that compares the board's attitude with the truth, and its Raspberry Pi."""

    def __init__(self, flight: FlightDynamics, seed: int, has_raspberry: bool) -> None:
        self._flight = flight
        self._tap = LineMonitor()
        self._waiting = self._tap.start_bytes()
        self._phone = PhoneSensors(seed)
        self._estimator = Estimator()
        self._due_s = 0.0 if has_raspberry else math.inf
        self.worst_deg: Errors = (0.0, 0.0)

    def read(self, timeout_s: float, most: int) -> bytes:
        waiting, self._waiting = self._waiting, b""
        return waiting

    def write(self, data: bytes) -> None:
        for message in self._tap.feed(data, 0.0):
            if message.type == "r":
                throttle_us = OUTPUTS.unpack(message.payload)[2]
                self._estimator.throttle((throttle_us - 1000) / 1000)
            elif message.type == "O":
                self._compare()

    def _compare(self) -> None:
        told, true = self._tap.orientation, self._flight.state
        assert told is not None
        roll_deg = abs((told.roll_deg - true.roll_deg + 180.0) % 360.0 - 180.0)
        self.worst_deg = worst([self.worst_deg, (roll_deg, abs(told.pitch_deg - true.pitch_deg))])
        now_s = true.time_s
        self._estimator.orientation(now_s, told.roll_deg, told.pitch_deg, told.yaw_deg)
        if now_s < self._due_s:
            return
        self._due_s = now_s + PERIOD_S
        fix = self._phone.location(true)
        if fix is not None:
            self._estimator.fix(_fix_of(fix, now_s), now_s)
        state = self._estimator.state()
        payload = None if state is None else payload_of(state)
        if payload is not None:
            self._waiting += self._tap.command_bytes("A", payload)


def _fix_of(data: dict[str, Any], now_s: float) -> Fix:
    taken_s = now_s - data["age_ms"] / 1000
    names = "latitude", "longitude", "altitude", "accuracy", "speed", "bearing"
    return Fix(taken_s, *(data[name] for name in names))


def fly(
    seed: int,
    minutes: int,
    is_starved: bool = False,
    errors: ImuErrors | None = None,
    has_raspberry: bool = True,
) -> list[Errors]:
    """Return the worst errors of roll and pitch, deg, in each minute of a flight of ``make run``.

    The seed determines wind, bias, drift, vibration and the GPS. A crash is an infinite error and
    ends the flight. Raises ``BoardUnavailableError``, ``FlightUnavailableError``,
    ``PreparationError``.
    """
    chance = random.Random(f"attitude {seed}")
    airframe = load_airframe("glider")
    weather = Weather(wind_m_s=chance.uniform(0, 6), turbulence="moderate")
    flight = FlightDynamics(airframe, Start(), weather, seed)
    drawn = drawn_errors(
        seed,
        vibration_deg_s=chance.uniform(1, 10),
        vibration_m_s2=chance.uniform(1, 6),
        vibration_hz=chance.uniform(100, 300),
    )
    eeprom = cached_eeprom("host", airframe.profile, airframe.gains)
    board = choose_board("host", seed=seed, eeprom=eeprom, imu_errors=errors or drawn)
    clock, line = StarvedClock(seed, is_starved), ComparingLine(flight, seed, has_raspberry)
    pilot, world = CirclingPilot(), World(flight, board)
    aircraft = FirmwareAircraft(flight, world, line, pilot, clock, "circle", no_log)
    found: list[Errors] = []
    for minute in range(1, minutes + 1):
        while aircraft.real_time.world.time_s < 60.0 * minute:
            clock.tick()
            aircraft.advance()
            if flight.crash is not None:
                return [*found, (math.inf, math.inf)]
        found.append(line.worst_deg)
        line.worst_deg = (0.0, 0.0)
    return found


def _text(errors_deg: Errors) -> str:
    return f"roll {errors_deg[0]:.2f}, pitch {errors_deg[1]:.2f} deg"

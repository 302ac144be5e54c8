"""How far the firmware's attitude is from the truth, with the gyro errors that each seed draws.

``python -m bench.attitude --help`` flies other flights than the table's.
"""

from __future__ import annotations

import argparse
import math
import random
from collections.abc import Iterable

from bench.table import Row
from up_simulator.aircraft import FlightDynamics, Start, Weather, load_airframe
from up_simulator.crew.firmware_aircraft import FirmwareAircraft
from up_simulator.firmware.build import BoardUnavailableError, choose_board
from up_simulator.firmware.imu_errors import ImuErrors, drawn_errors
from up_simulator.firmware.preparation import PreparationError, prepared_eeprom
from up_simulator.firmware.tap import BoardTap
from up_simulator.flight import FlightUnavailableError
from up_simulator.radio.circling_pilot import CirclingPilot
from up_simulator.tuning.workers import MOST_PROCESSES, Workers

FLIGHTS, MINUTES = 20, 10
QUICK_FLIGHTS, QUICK_MINUTES = 2, 1
TARGET_DEG = 2.0
TICK_S = 0.004
STARVED_EVERY_S, STARVED_S = 2.0, (0.05, 1.5)
VIBRATION_DEG_S, VIBRATION_M_S2, VIBRATION_HZ = (1.0, 10.0), (1.0, 6.0), (100.0, 300.0)
WIND_M_S = 6.0
Errors = tuple[float, float]
_CANNOT_FLY = (BoardUnavailableError, FlightUnavailableError, PreparationError)


def rows(quick: bool = False) -> Iterable[Row]:
    """Yield the worst of all flights; ``RuntimeError`` says what is missing to fly them."""
    flights, minutes = (QUICK_FLIGHTS, QUICK_MINUTES) if quick else (FLIGHTS, MINUTES)
    try:
        with Workers(MOST_PROCESSES) as workers:
            found = workers.fly(fly, [(seed, minutes) for seed in range(1, flights + 1)])
    except _CANNOT_FLY as error:
        raise RuntimeError(str(error)) from error
    roll_deg, pitch_deg = worst(each for flight in found for each in flight)
    yield Row(
        f"attitude error with drawn gyro errors, worst of {flights} flights of {minutes} min",
        f"roll {roll_deg:.2f}, pitch {pitch_deg:.2f} deg",
        target=f"<= {TARGET_DEG:.1f} deg",
        met=max(roll_deg, pitch_deg) <= TARGET_DEG,
    )


def worst(errors: Iterable[Errors]) -> Errors:
    """Return the greatest of each axis."""
    roll_deg, pitch_deg = zip(*errors, strict=True)
    return max(roll_deg), max(pitch_deg)


class Starved:
    """A clock of a computer that holds the process up every few seconds, or never."""

    def __init__(self, seed: int, is_starved: bool) -> None:
        self._chance = random.Random(f"starved {seed}")
        self._now_s = 0.0
        self._next_s = STARVED_EVERY_S if is_starved else float("inf")

    def seconds(self) -> float:
        """Return the time."""
        return self._now_s

    def tick(self) -> None:
        """Pass the time until the program runs again."""
        self._now_s += TICK_S
        if self._now_s >= self._next_s:
            self._now_s += self._chance.uniform(*STARVED_S)
            self._next_s = self._now_s + STARVED_EVERY_S


class Line:
    """The end of the serial line: it compares what the board says with what is true."""

    def __init__(self, flight: FlightDynamics) -> None:
        self._flight = flight
        self._waiting = BoardTap().start_bytes()
        self.tap = BoardTap()
        self.worst_deg: Errors = (0.0, 0.0)

    def read(self, timeout_s: float, most: int) -> bytes:
        """Return a Start Command, once."""
        waiting, self._waiting = self._waiting, b""
        return waiting

    def write(self, data: bytes) -> None:
        """Take what the board says."""
        if not any(each.type == "O" for each in self.tap.feed(data, 0.0)):
            return
        told, true = self.tap.orientation, self._flight.state
        assert told is not None
        roll_deg = abs((told.roll_deg - true.roll_deg + 180.0) % 360.0 - 180.0)
        pitch_deg = abs(told.pitch_deg - true.pitch_deg)
        self.worst_deg = (max(self.worst_deg[0], roll_deg), max(self.worst_deg[1], pitch_deg))


def fly(
    seed: int, minutes: int, is_starved: bool = False, errors: ImuErrors | None = None
) -> list[Errors]:
    """Return the worst errors of roll and pitch in each minute of a flight of ``make run``.

    Wind, bias, drift and vibration are drawn by the seed. A crash is an infinite error and ends
    the flight. Raises ``BoardUnavailableError``, ``FlightUnavailableError`` and
    ``PreparationError``.
    """
    chance = random.Random(f"attitude {seed}")
    airframe = load_airframe("glider")
    weather = Weather(wind_m_s=chance.uniform(0, WIND_M_S), turbulence="moderate")
    flight = FlightDynamics(airframe, Start(), weather, seed)
    board = choose_board(
        "host",
        seed=seed,
        eeprom=prepared_eeprom("host", airframe.profile, airframe.gains),
        imu_errors=errors
        or drawn_errors(
            seed,
            vibration_deg_s=chance.uniform(*VIBRATION_DEG_S),
            vibration_m_s2=chance.uniform(*VIBRATION_M_S2),
            vibration_hz=chance.uniform(*VIBRATION_HZ),
        ),
    )
    clock, line = Starved(seed, is_starved), Line(flight)
    aircraft = FirmwareAircraft(
        flight, board, line, CirclingPilot(), clock, "circle", lambda _text: None
    )
    found: list[Errors] = []
    for minute in range(1, minutes + 1):
        while aircraft.real_time.world.time_s < 60.0 * minute:
            clock.tick()
            aircraft.keep()
            if flight.crash is not None:
                return [*found, (math.inf, math.inf)]
        found.append(line.worst_deg)
        line.worst_deg = (0.0, 0.0)
    return found


def main() -> None:
    """Fly what is asked for and print the worst error of each minute."""
    parser = argparse.ArgumentParser(prog="python -m bench.attitude", description=__doc__)
    parser.add_argument("--flights", type=int, default=FLIGHTS)
    parser.add_argument("--minutes", type=int, default=MINUTES)
    parser.add_argument("--first", type=int, default=1, metavar="SEED", help="of the first flight")
    parser.add_argument("--starved", action="store_true", help="hold the process up at times")
    parser.add_argument("--no-errors", action="store_true", help="of the gyro, but its noise")
    options = parser.parse_args()
    errors = ImuErrors() if options.no_errors else None
    seeds = range(options.first, options.first + options.flights)
    with Workers(MOST_PROCESSES) as workers:
        found = workers.fly(
            fly, [(seed, options.minutes, options.starved, errors) for seed in seeds]
        )
    for seed, flight in zip(seeds, found, strict=True):
        minutes = " ".join(f"{roll_deg:.1f}/{pitch_deg:.1f}" for roll_deg, pitch_deg in flight)
        roll_deg, pitch_deg = worst(flight)
        print(f"seed {seed:3}  worst roll {roll_deg:.2f}, pitch {pitch_deg:.2f} deg  {minutes}")
    roll_deg, pitch_deg = worst(each for flight in found for each in flight)
    print(f"all       worst roll {roll_deg:.2f}, pitch {pitch_deg:.2f} deg")


if __name__ == "__main__":
    main()

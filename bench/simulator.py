"""The speed of the virtual aircraft relative to real time, on one core."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable

from bench.table import LeftOutError, Row, compared
from bench.timing import Limit
from up_simulator.aircraft import FlightDynamics, Weather, load_airframe
from up_simulator.aircraft.flight import FlightUnavailableError
from up_simulator.firmware.board import BoardKind
from up_simulator.firmware.build import BoardUnavailableError, choose_board
from up_simulator.firmware.line_monitor import LineMonitor
from up_simulator.firmware.preparation import PreparationError, cached_eeprom
from up_simulator.harness.world import World

CHIP_TARGET, HOST_TARGET = (Limit(value, is_minimum=True) for value in (8.0, 30.0))
ROUNDS = 3
MIDDLE_US = 1500.0
BEAT_S = 0.02


def rows(quick: bool = False) -> Iterable[Row]:
    flown_s = 1.0 if quick else 10.0
    try:
        chip, host = _world("firmware"), _world("host")
    except (BoardUnavailableError, FlightUnavailableError, PreparationError) as error:
        raise LeftOutError(str(error)) from error
    flights = {
        "compiled firmware and flight dynamics in lockstep": (lambda: _fly(chip, flown_s)),
        "firmware built for this computer, with flight dynamics": (lambda: _fly(host, flown_s)),
        "compiled firmware alone": (lambda: chip.board.run_us(flown_s * 1e6)),
    }
    factors: dict[str, list[float]] = {name: [] for name in flights}
    for _ in range(ROUNDS):
        for name, run in flights.items():
            factors[name].append(_factor(run, flown_s))
    for (name, figures), limit in zip(
        factors.items(), (CHIP_TARGET, HOST_TARGET, None), strict=True
    ):
        yield compared(f"simulator, {name}", "x real time", figures, limit=limit)


def _world(kind: BoardKind) -> World:
    """Return the glider in moderate turbulence, armed and in FBW, its board sending all it has."""
    airframe = load_airframe("glider")
    eeprom = cached_eeprom(kind, airframe.profile, airframe.gains)
    weather = Weather(wind_m_s=4, turbulence="moderate")
    world = World(FlightDynamics(airframe, weather=weather), choose_board(kind, eeprom=eeprom))
    world.board.set_stick("aux1", MIDDLE_US)
    world.boot(arms=True)
    world.board.write(LineMonitor().start_bytes())
    world.board.set_stick("throttle", MIDDLE_US)
    return world


def _fly(world: World, duration_s: float) -> None:
    tap = LineMonitor()
    for _ in range(round(duration_s / BEAT_S)):
        world.advance(BEAT_S)
        tap.feed(world.board.read(), world.time_s)


def _factor(run: Callable[[], None], simulated_s: float) -> float:
    """Return simulated time by processor time: other programs do not count."""
    start_s = time.process_time()
    run()
    return simulated_s / (time.process_time() - start_s)

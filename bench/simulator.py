"""How much faster than the clock the virtual aircraft flies, on one core."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable

from bench.table import Row
from up_simulator.aircraft import FlightDynamics, Weather, load_airframe
from up_simulator.firmware.board import BoardKind
from up_simulator.firmware.build import BoardUnavailableError, choose_board
from up_simulator.firmware.preparation import PreparationError, prepared_eeprom
from up_simulator.firmware.tap import BoardTap
from up_simulator.flight import FlightUnavailableError
from up_simulator.world import World

TARGET = 8.0
MIDDLE_US = 1500.0
BEAT_S = 0.02


def rows(quick: bool = False) -> Iterable[Row]:
    """Yield the factors; ``RuntimeError`` says what is missing to measure them."""
    flown_s = 2.0 if quick else 20.0
    try:
        world = _world("firmware")
        lockstep = _factor(lambda: _fly(world, flown_s), flown_s)
        yield Row(
            "simulator, compiled firmware and flight dynamics in lockstep",
            _times(lockstep),
            target=f">= {_times(TARGET)}",
            met=lockstep >= TARGET,
        )
        alone = _factor(lambda: world.board.run_us(flown_s * 1e6), flown_s)
        yield Row("simulator, compiled firmware alone", _times(alone))
        host = _world("host")
        yield Row(
            "simulator, firmware built for this computer, with flight dynamics",
            _times(_factor(lambda: _fly(host, flown_s), flown_s)),
        )
    except (BoardUnavailableError, FlightUnavailableError, PreparationError) as error:
        raise RuntimeError(str(error)) from error


def _world(kind: BoardKind) -> World:
    """Return the glider in moderate turbulence, armed and in FBW, its board sending all it has."""
    airframe = load_airframe("glider")
    eeprom = prepared_eeprom(kind, airframe.profile, airframe.gains)
    weather = Weather(wind_m_s=4, turbulence="moderate")
    world = World(FlightDynamics(airframe, weather=weather), choose_board(kind, eeprom=eeprom))
    world.board.set_stick("aux1", MIDDLE_US)
    world.boot(arms=True)
    world.board.write(BoardTap().start_bytes())
    world.board.set_stick("throttle", MIDDLE_US)
    return world


def _fly(world: World, duration_s: float) -> None:
    tap = BoardTap()
    for _ in range(round(duration_s / BEAT_S)):
        world.advance(BEAT_S)
        tap.feed(world.board.read(), world.time_s)


def _factor(run: Callable[[], None], simulated_s: float) -> float:
    """Return simulated time by processor time: what else runs here does not count."""
    start_s = time.process_time()
    run()
    return simulated_s / (time.process_time() - start_s)


def _times(factor: float) -> str:
    return f"{factor:.1f} x real time"

"""Puts flight, board and phone together and keeps them in time."""

from __future__ import annotations

import argparse
from collections.abc import Awaitable, Callable
from typing import Any

from twisted.internet.task import LoopingCall

from up_rig.pty_line import PtyLine
from up_simulator.aircraft import Airframe, FlightDynamics, Start, Weather
from up_simulator.board import Board, OldFirmware
from up_simulator.flight import Flight, FlightUnavailableError
from up_simulator.pace import Pace
from up_simulator.phone import Phone
from up_simulator.phone_address import RaspberryPi, Runner, discover, spawn
from up_simulator.phone_link import PhoneLink
from up_simulator.receiver import POWERED, SOARING, Receiver, read_sticks
from up_simulator.recorded_flight import read_recording
from up_simulator.state_log import StateLog

TICK_S = 0.005
START = Start(height_m=400.0)
READ_SIZE = 4096

Say = Callable[[str], None]


class Simulation:
    """Everything that the options ask for, built at once and started by ``start``.

    ``reactor`` gives time, sockets and readers; its clock must be monotonic. ``say`` takes one
    line for the user. Raises ``FlightUnavailableError``, ``PtyLineError`` and ``OSError`` (the
    state log) with messages for the user.
    """

    def __init__(self, reactor: Any, options: argparse.Namespace, say: Say) -> None:
        self._say = say
        self._flight = make_flight(options, say)
        self._pace = Pace(self._flight, reactor, say)
        self._ticks: list[Callable[[], None]] = [self._pace.keep]
        self._port: PtyLine | None = None
        self._link: PhoneLink | None = None
        self._log = StateLog(options.state_log) if options.state_log else None
        self._loop = LoopingCall(self._tick)
        self._loop.clock = reactor
        if not options.no_board:
            self._port = PtyLine(options.pty_link)
            self._board = _make_board(self._flight, reactor, self._port, options, say)
            self._ticks += [self._hear, self._board.tick]
        if not options.no_phone:
            phone = Phone(
                self._flight, reactor, seed=options.seed, say=lambda text: say(f"phone: {text}")
            )
            self._link = PhoneLink(
                reactor,
                phone,
                _make_find(reactor, options),
                options.orientation,
                lambda text: say(f"phone: {text}"),
            )
            self._ticks.append(phone.tick)

    def start(self, on_failure: Callable[[Any], None]) -> None:
        """Begin to fly; ``on_failure`` gets the failure of a tick, which ends the flight."""
        if self._port is not None:
            self._say(f"board on {self._port.path}")
            self._board.opened()
        if self._link is not None:
            self._link.start()
        self._loop.start(TICK_S).addErrback(on_failure)

    async def stop(self) -> None:
        """Land: close links, pty and log, and remove the symbolic link."""
        if self._loop.running:
            self._loop.stop()
        if self._port is not None:
            self._port.close()
        if self._log is not None:
            self._log.close()
        if self._link is not None:
            await self._link.stop()

    def _hear(self) -> None:
        if self._port is not None and (data := self._port.read(0.0, READ_SIZE)):
            self._board.data_received(data)

    def _tick(self) -> None:
        for tick in self._ticks:
            tick()
        if isinstance(self._flight, FlightDynamics) and self._flight.crash is not None:
            self._say(f"{self._flight.crash}: launched again in the air")
            self._flight.launch(START)
        if self._log is not None:
            try:
                self._log.record(self._flight.state, self._flight.servos)
            except OSError as error:
                self._say(f"state log: {error}: no more of it is written")
                self._log = None


def make_flight(options: argparse.Namespace, say: Say) -> Flight:
    """Return the model, or the recorded flight where that is asked for or nothing else flies."""
    if options.replay is not None:
        say(f"flying the recorded flight {options.replay}: the servos have no effect")
        return read_recording(options.replay)
    airframe: Airframe = options.aircraft
    weather = Weather(wind_m_s=options.wind, turbulence=options.turbulence)
    try:
        flight = FlightDynamics(airframe, START, weather, options.seed)
    except FlightUnavailableError as error:
        say(f"{error}: flying a recorded flight, the servos have no effect")
        return read_recording(None)
    say(
        f"flying {airframe.name} by JSBSim: wind {options.wind:g} m/s, "
        f"turbulence {options.turbulence}"
    )
    return flight


def _make_board(
    flight: Flight, reactor: Any, port: PtyLine, options: argparse.Namespace, say: Say
) -> Board:
    has_motor = options.aircraft.has_motor and options.replay is None
    moves = read_sticks(POWERED if has_motor else SOARING) + options.sticks
    old = OldFirmware(options.old_confirms, options.boot_text)
    board = Board(
        flight,
        Receiver(moves, reactor.seconds(), options.seed),
        reactor,
        port.write,
        has_motor=has_motor,
        old=old if options.framing == "thesis" else None,
        say=lambda text: say(f"board: {text}"),
    )
    port.returned = board.opened
    return board


def _make_find(reactor: Any, options: argparse.Namespace) -> Callable[[], Awaitable[RaspberryPi]]:
    async def find() -> RaspberryPi:
        host = options.phone_host
        if options.runner:
            runner_host, runner_port = options.runner
            runner = Runner(runner_host, runner_port, options.aircraft_name)
            return await spawn(reactor, runner)
        if options.discover:
            host = await discover(reactor, *options.discover)
        return RaspberryPi(host, options.general_port, options.orientation_port)

    return find

"""The virtual aircraft in real time: flight, board, radio and phone, in one time."""

from __future__ import annotations

import argparse
import secrets
from collections.abc import Awaitable, Callable
from typing import Any

from twisted.internet.task import LoopingCall

from up.commands.board_schema import FLIGHT_MODES, MODE_TEXTS
from up_rig.pty_line import PtyLine
from up_simulator.aircraft import Airframe, load_airframe
from up_simulator.aircraft.state_log import StateLog
from up_simulator.aircraft.truth import record_of
from up_simulator.betaflight.board import BetaflightBoard
from up_simulator.betaflight.packets import LINE as BETAFLIGHT_LINE
from up_simulator.betaflight.world import BetaflightWorld, NoLine
from up_simulator.firmware.line_monitor import LineMonitor
from up_simulator.harness.firmware_aircraft import FirmwareAircraft
from up_simulator.harness.parts import make_board, make_flight
from up_simulator.harness.real_time import RealTimeFlight
from up_simulator.harness.uplink import make_uplink
from up_simulator.harness.user_log import Log
from up_simulator.harness.world import World
from up_simulator.link.relay import LinkRelay
from up_simulator.phone.address import RaspberryPi, Runner, discover, spawn
from up_simulator.phone.link import PythonHandset
from up_simulator.radio.choice import choose_radio
from up_simulator.radio.remote import RemoteRadio
from up_simulator.radio.sticks import Radio
from up_simulator.sensors.ubx_receiver import Line, UbxReceiver

TICK_S = 0.004


class VirtualAircraft:
    """All parts that the options select, built by the constructor and started by ``start``.

    ``reactor`` gives time and sockets; its clock must be monotonic. ``on_leave`` is called when the
    pilot at the keyboard leaves. Raises ``FlightUnavailableError``, ``AirframeError``,
    ``BoardUnavailableError``, ``PtyLineError``, ``RadioError``, ``LinkRelayError``
    and ``OSError`` (the state log) with messages for the user.
    """

    def __init__(
        self, reactor: Any, options: argparse.Namespace, log: Log, on_leave: Callable[[], None]
    ) -> None:
        self._reactor = reactor
        self._log = log
        self._line: PtyLine | None = None
        self._gps_line: PtyLine | None = None
        self._betaflight: BetaflightBoard | None = None
        self._radio: Radio | None = None
        self._phone: PythonHandset | None = None
        self._state_log: StateLog | None = None
        self._uplink: LinkRelay | None = None
        self._ticks: list[Callable[[], None]] = []
        self._loop = LoopingCall(self._tick)
        self._loop.clock = reactor
        airframe = load_airframe(options.airframe)
        self.flight = make_flight(options, airframe, log)
        try:
            self._build(options, airframe, on_leave)
        except BaseException:
            self._release()
            raise

    def start(self, on_failure: Callable[[Any], None]) -> None:
        """Begin to fly; ``on_failure`` gets the failure of a tick, which ends the flight."""
        path = BETAFLIGHT_LINE if self._line is None else self._line.path
        if self._radio is not None:
            self._log(f"board on {path}", code="board_ready", path=str(path))
        if self._phone is not None:
            self._phone.start()
        self._loop.start(TICK_S).addErrback(on_failure)

    async def stop(self) -> None:
        """Close links, pty, log and radio, and remove the symbolic link."""
        if self._loop.running:
            self._loop.stop()
        self._release()
        if self._phone is not None:
            await self._phone.stop()
        if self._uplink is not None:
            await self._uplink.stop()

    def _build(
        self, options: argparse.Namespace, airframe: Airframe, on_leave: Callable[[], None]
    ) -> None:
        if options.state_log:
            self._state_log = StateLog(options.state_log)
        if not options.no_phone:
            self._phone = self._make_phone(options)
        if options.gps_link is not None:
            self._gps_line = line = PtyLine(options.gps_link)
            receiver = UbxReceiver(options.seed)
            self._ticks.append(lambda: receiver.exchange(line, self.flight.state))
        if options.link is not None:
            self._uplink = make_uplink(
                self._reactor, options.link_port, options.link_to, options.link, options.seed
            )
            self._uplink.start()
        if options.no_board:
            flight = RealTimeFlight(self.flight, self._reactor, self._log)
            self._ticks.append(flight.advance)
        else:
            self._ticks.append(self._add_board(options, airframe, on_leave))
        if self._phone is not None:
            self._ticks.append(self._phone.tick)

    def _add_board(
        self, options: argparse.Namespace, airframe: Airframe, on_leave: Callable[[], None]
    ) -> Callable[[], None]:
        monitor = LineMonitor()

        def mode() -> str:
            return FLIGHT_MODES.get(monitor.mode or "", "")

        def is_armed() -> bool | None:
            return None if monitor.status is None else monitor.status.is_armed

        radio = choose_radio(
            options.radio,
            options.sticks,
            options.controller,
            has_motor=airframe.has_motor,
            log=self._log,
            on_leave=on_leave,
            mode=mode,
        )
        self._radio = radio
        remote: RemoteRadio | None = None
        if options.radio_socket is not None:
            # A pilot with a transmitter arms with it.
            arms = is_armed if options.radio in ("circle", "script") else None
            remote = RemoteRadio(options.radio_socket, radio, self._log, mode, arms)
            self._radio = radio = remote

        def describe_pilot() -> str:
            pilot = options.radio if options.radio != "circle" else "the circling pilot"
            if remote is not None and remote.is_taken:
                pilot = "another radio"
            return f"{mode() or 'unknown mode'}, {pilot} had the sticks"

        # Last, because it may have to be built.
        world, line = self._make_world(options, airframe)
        aircraft = FirmwareAircraft(
            self.flight, world, line, radio, self._reactor, options.radio, self._log, describe_pilot
        )

        def on_sent(data: bytes) -> None:
            before = monitor.mode
            monitor.feed(data, self._reactor.seconds())
            monitor.answers.clear()
            if monitor.mode != before:
                text = f"board: {mode()}: {MODE_TEXTS.get(mode(), 'unknown')}"
                self._log(text, code="board_mode", mode=mode())

        aircraft.real_time.on_sent = on_sent
        return aircraft.advance

    def _make_world(self, options: argparse.Namespace, airframe: Airframe) -> tuple[World, Line]:
        if options.autopilot == "betaflight":
            self._betaflight = BetaflightBoard(self.flight, options.sitl, options.seed)
            text = f"aboard: {self._betaflight.title}"
            self._log(text, code="board_selected", board=self._betaflight.title)
            return BetaflightWorld(self.flight, self._betaflight), NoLine()
        board = make_board(options, airframe, self._log)
        self._line = PtyLine(options.pty_link)
        return World(self.flight, board), self._line

    def _make_phone(self, options: argparse.Namespace) -> PythonHandset:
        def log(text: str, /, *, code: str = "phone", **fields: Any) -> None:
            self._log(f"phone: {text}", code=code, **fields)

        record = record_of if options.truth else None
        find = _make_find(self._reactor, options)
        return PythonHandset(
            self._reactor,
            self.flight,
            find,
            options.orientation,
            log,
            seed=options.seed,
            identity=secrets.token_hex(4),
            record=record,
        )

    def _tick(self) -> None:
        for tick in self._ticks:
            tick()
        if self._state_log is not None:
            try:
                self._state_log.record(self.flight.state, self.flight.servos)
            except OSError as error:
                self._log(f"state log: {error}; logging stops", code="state_log_failed")
                self._state_log = None

    def _release(self) -> None:
        for each in (self._radio, self._line, self._gps_line, self._state_log, self._betaflight):
            if each is not None:
                each.close()
        self._radio = self._line = self._gps_line = self._state_log = self._betaflight = None


def _make_find(reactor: Any, options: argparse.Namespace) -> Callable[[], Awaitable[RaspberryPi]]:
    async def find() -> RaspberryPi:
        host = options.phone_host
        if options.runner:
            runner_host, runner_port = options.runner
            runner = Runner(runner_host, runner_port, options.aircraft_name, options.pairing)
            return await spawn(reactor, runner)
        if options.discover:
            host = await discover(reactor, *options.discover)
        return RaspberryPi(host, options.general_port, options.orientation_port)

    return find

"""Flights in real time, and a world with a pty for its serial line."""

from __future__ import annotations

from collections.abc import Callable

from up.system.clock import Clock
from up_simulator.aircraft.dynamics import FlightDynamics
from up_simulator.harness.user_log import Log, no_log
from up_simulator.harness.world import BYTES_A_STEP, STEP_S, World
from up_simulator.radio.sticks import SWITCH_US, Radio, Sticks, Transmitter
from up_simulator.sensors.ubx_receiver import Line

MAX_LATE_S = 0.25
REPORT_PERIOD_S = 60.0
STICK_STEPS = 10
"""A receiver sends a frame every 20 ms: reading the sticks more often has no effect."""
MAX_STEPS = 25
"""Steps at a time: a world that has to catch up leaves the sockets their turn."""


class RealTime:
    """Keeps a flight in step with a monotonic clock, never ahead of it.

    A delay beyond 250 ms is skipped instead of flown in a burst, which would make the next call
    late as well: it is added to ``skipped_s`` and reported at most once a minute.
    """

    def __init__(self, clock: Clock, log: Log = no_log, flown_s: float = 0.0) -> None:
        self.skipped_s = 0.0
        self._clock = clock
        self._log = log
        self._reported_s = -REPORT_PERIOD_S
        self.restart(flown_s)

    def restart(self, flown_s: float) -> None:
        """Continue from this time of the flight; the time since the last call is not a delay."""
        self._start_s = self._clock.seconds() - flown_s - self.skipped_s

    def late_s(self, flown_s: float) -> float:
        """Return how far a flight of this duration is behind the clock."""
        return self._clock.seconds() - self._start_s - self.skipped_s - flown_s

    def skip(self, flown_s: float) -> float:
        """Skip the delay beyond the limit, and return the remaining one."""
        late_s = self.late_s(flown_s)
        if late_s <= MAX_LATE_S:
            return late_s
        self.skipped_s += late_s - MAX_LATE_S
        now_s = self._clock.seconds()
        if now_s - self._reported_s >= REPORT_PERIOD_S:
            self._reported_s = now_s
            text = f"late by {late_s:.2f} s: this machine is too busy; missed time is skipped,"
            text += f" not flown, {self.skipped_s:.2f} s so far"
            self._log(text, code="late", late_s=round(late_s, 2))
        return MAX_LATE_S


class RealTimeFlight:
    """A flight without a board in real time."""

    def __init__(self, flight: FlightDynamics, clock: Clock, log: Log) -> None:
        self.time = RealTime(clock, log)
        self._flight = flight
        self._flown_s = 0.0

    def advance(self) -> None:
        late_s = self.time.skip(self._flown_s)
        self._flown_s += late_s
        self._flight.advance(late_s)


class RealTimeWorld:
    """A world in real time.

    Each step passes the serial line's bytes, every tenth moves the sticks, then ``watchers`` are
    called; ``on_sent`` gets the bytes that the board sends.
    """

    def __init__(
        self, world: World, line: Line, radio: Radio, clock: Clock, log: Log = no_log
    ) -> None:
        self.world = world
        self.radio = radio
        self.watchers: list[Callable[[], None]] = []
        self.on_sent: Callable[[bytes], None] | None = None
        self.time = RealTime(clock, log, world.time_s)
        self._line = line
        self._steps = 0
        self._transmitter = Transmitter(world.board)

    def advance(self) -> None:
        """Fly until now, or for a bounded number of steps. Raises ``BoardCrashedError``."""
        self.time.skip(self.world.time_s)
        for _ in range(MAX_STEPS):
            if self.time.late_s(self.world.time_s) < STEP_S - 1e-9:
                return
            self.step()

    def step(self) -> None:
        """Fly for one step, regardless of the clock. Raises ``BoardCrashedError``."""
        world = self.world
        if self._steps % STICK_STEPS == 0:
            self._transmitter.send(self.radio.sticks(world.time_s, world.state))
        self._steps += 1
        data = self._line.read(0.0, BYTES_A_STEP)
        if data:
            world.board.write(data)
        world.step()
        sent = world.board.read()
        if sent:
            self._line.write(sent)
            if self.on_sent is not None:
                self.on_sent(sent)
        for watch in self.watchers:
            watch()

    def relaunch(self, boot: Callable[[World], None]) -> None:
        """Let ``boot`` put the aircraft back into the air; its duration does not count as delay.

        Before it the sticks are in the positions for power-on, and the mode switch is not at AUTO,
        which ends the flight mode that the last flight had.
        """
        self._transmitter.send(Sticks(aux1=SWITCH_US["FBW"]))
        boot(self.world)
        # Booting may have moved the switches.
        self._transmitter = Transmitter(self.world.board)
        self.time.restart(self.world.time_s)

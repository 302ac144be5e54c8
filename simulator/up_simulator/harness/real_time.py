"""Keeps a world in step with the clock on the wall, with a pty for its serial line."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from up_simulator.harness.clock import Clock
from up_simulator.harness.world import BYTES_A_STEP, STEP_S, World
from up_simulator.radio.sticks import Radio, Sticks, Transmitter

LATEST_S = 0.25
SAY_AGAIN_S = 5.0
STICK_STEPS = 10
"""A receiver sends a frame every 20 ms: reading the sticks more often has no effect."""
STEPS_MOST = 25
"""Steps at a time: a world that has to catch up leaves the sockets their turn."""


class SerialLine(Protocol):
    """The board's serial line, as ``up_rig.pty_line.PtyLine``."""

    def read(self, timeout_s: float, most: int) -> bytes:
        """Return the received bytes, waiting for them up to a time."""

    def write(self, data: bytes) -> None:
        """Send bytes, or drop them without a reader."""


class RealTimeWorld:
    """Flies a world in step with a clock, never ahead of it.

    A delay beyond 250 ms is skipped instead of flown in a burst: it is added to ``skipped_s`` and
    reported at most every 5 s. Each step passes the serial line's bytes, every tenth moves the
    sticks, then ``watchers`` are called. ``clock`` is monotonic; ``say`` takes one line for the
    user.
    """

    def __init__(
        self,
        world: World,
        line: SerialLine,
        radio: Radio,
        clock: Clock,
        say: Callable[[str], None] = lambda _text: None,
    ) -> None:
        self.world = world
        self.skipped_s = 0.0
        self.radio = radio
        self.watchers: list[Callable[[], None]] = []
        self.heard: Callable[[bytes], None] | None = None
        self._line = line
        self._clock = clock
        self._say = say
        self._said_s = -SAY_AGAIN_S
        self._steps = 0
        self._transmitter = Transmitter(world.board)
        self._start_s = clock.seconds() - world.time_s

    @property
    def late_s(self) -> float:
        """Return how far the world is behind the clock."""
        return self._clock.seconds() - self._start_s - self.skipped_s - self.world.time_s

    def keep(self) -> None:
        """Fly until now, or for a bounded number of steps. Raises ``BoardCrashedError``."""
        late_s = self.late_s
        if late_s > LATEST_S:
            self._skip(late_s)
        for _ in range(STEPS_MOST):
            if self.late_s < STEP_S - 1e-9:
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
            if self.heard is not None:
                self.heard(sent)
        for watch in self.watchers:
            watch()

    def begin_again(self, boot: Callable[[World], None]) -> None:
        """Let ``boot`` put the aircraft back into the air; its duration does not count as delay.

        Before it the sticks are in the positions for power-on.
        """
        self._transmitter.send(Sticks())
        boot(self.world)
        # Booting may have moved the switches.
        self._transmitter = Transmitter(self.world.board)
        self._start_s = self._clock.seconds() - self.world.time_s - self.skipped_s

    def _skip(self, late_s: float) -> None:
        self.skipped_s += late_s - LATEST_S
        now_s = self._clock.seconds()
        if now_s - self._said_s >= SAY_AGAIN_S:
            self._said_s = now_s
            self._say(f"late by {late_s:.2f} s: the missed time is skipped, not flown")

"""Runs a rig as fast as the clock on the wall, with a pty for its serial line."""

from __future__ import annotations

import math
import time
from collections.abc import Callable

from up_rig.imu import Motion, motion_at
from up_rig.pty_line import PtyLine
from up_rig.rig import Rig
from up_rig.sticks import StickMove

STEP_S = 0.002
MAX_LATE_S = 0.25
REPORT_PERIOD_S = 5.0
MAX_LINE_BYTES = 1024
ROCKING_DEG, ROCKING_PERIOD_S = 10.0, 6.0


def rocking(time_s: float) -> Motion:
    """Return the motion of an aircraft that rocks slowly from wing to wing."""
    phase = 2 * math.pi * time_s / ROCKING_PERIOD_S
    rate_deg_s = ROCKING_DEG * 2 * math.pi / ROCKING_PERIOD_S * math.cos(phase)
    return motion_at(ROCKING_DEG * math.sin(phase), 0.0, (rate_deg_s, 0.0, 0.0))


class RealTime:
    """Keeps a rig in step with a monotonic clock.

    A delay beyond 250 ms is skipped, not flown in a burst. ``echo`` takes one line for the user.
    """

    def __init__(
        self,
        rig: Rig,
        line: PtyLine,
        moves: list[StickMove],
        echo: Callable[[str], None],
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._rig = rig
        self._line = line
        self._moves = sorted(moves, key=lambda move: move.time_s)
        self._echo = echo
        self._clock = clock
        self._start_s = clock()
        self._skipped_s = 0.0
        self._reported_s = -REPORT_PERIOD_S
        self.is_ending = False
        rig.receiver.start()

    def run(self) -> None:
        """Run until ``is_ending``. Raises ``CrashError``."""
        while not self.is_ending:
            self.step()

    def step(self) -> None:
        """Run for a step and pass on the bytes, in both directions."""
        time_s = self._rig.now_us / 1e6
        wait_s = time_s + STEP_S - self._elapsed_s()
        room = MAX_LINE_BYTES - self._rig.serial.waiting
        data = self._line.read(wait_s, room)
        if data:
            self._rig.serial.write(data)
        late_s = self._elapsed_s() - time_s
        if late_s > MAX_LATE_S:
            self._skip(late_s - MAX_LATE_S)
        if late_s < STEP_S - 1e-6:
            # Woken by bytes: the step is not over.
            return
        while self._moves and self._moves[0].time_s <= time_s + STEP_S:
            self._move(self._moves.pop(0))
        # Unused here, and they would grow without a bound.
        self._rig.servo.clear()
        self._rig.receiver.sent.clear()
        self._rig.run_us(STEP_S * 1e6)
        sent = self._rig.serial.read()
        if sent:
            self._line.write(sent)

    def _elapsed_s(self) -> float:
        return self._clock() - self._start_s - self._skipped_s

    def _skip(self, missed_s: float) -> None:
        self._skipped_s += missed_s
        if self._clock() - self._reported_s >= REPORT_PERIOD_S:
            self._reported_s = self._clock()
            self._echo(f"late by {missed_s + MAX_LATE_S:.2f} s: the missed time is skipped")

    def _move(self, move: StickMove) -> None:
        receiver = self._rig.receiver
        if move.channel != "receiver":
            receiver.set(move.channel, move.value)
        elif move.value:
            receiver.start()
        else:
            receiver.stop()

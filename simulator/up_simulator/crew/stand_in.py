"""An aircraft whose Arduino is the stand-in: for old firmware, and where no compiler is."""

from __future__ import annotations

import argparse
from collections.abc import Callable

from up_rig.pty_line import PtyLine
from up_simulator.board import Board, OldFirmware
from up_simulator.clock import Clock
from up_simulator.crew.aloft import Aloft
from up_simulator.pace import Pace
from up_simulator.radio.sticks import Radio, Transmitter
from up_simulator.receiver import Receiver

READ_SIZE = 4096


class StandInAircraft:
    """A flight, the stand-in on its serial line, and a radio, in real time.

    ``line`` is a ``PtyLine``; ``say`` takes one line for the user.
    """

    def __init__(
        self,
        flight: Aloft,
        line: PtyLine,
        radio: Radio,
        clock: Clock,
        options: argparse.Namespace,
        has_motor: bool,
        say: Callable[[str], None],
    ) -> None:
        receiver = Receiver([], clock.seconds(), options.seed)
        old = OldFirmware(options.old_confirms, options.boot_text)
        self._flight = flight
        self._line = line
        self._radio = radio
        self._clock = clock
        self._start_s = clock.seconds()
        self._pace = Pace(flight, clock, say)
        self._transmitter = Transmitter(receiver)
        self._board = Board(
            flight,
            receiver,
            clock,
            line.write,
            has_motor=has_motor,
            old=old if options.framing == "thesis" else None,
            say=lambda text: say(f"board: {text}"),
        )
        line.returned = self._board.opened
        self._board.opened()

    def keep(self) -> None:
        """Fly until now."""
        self._pace.keep()
        time_s = self._clock.seconds() - self._start_s
        self._transmitter.send(self._radio.sticks(time_s, self._flight.state))
        data = self._line.read(0.0, READ_SIZE)
        if data:
            self._board.data_received(data)
        self._board.tick()

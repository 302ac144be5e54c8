"""The keyboard of a terminal as a radio, with a status line of the flight."""

from __future__ import annotations

import atexit
import os
import re
import select
import termios
import textwrap
import tty
from collections.abc import Callable
from contextlib import suppress
from typing import Any

from up_simulator.aircraft.flight import FlightState
from up_simulator.radio.keyboard import HELP, KeyboardSticks, KeyReader
from up_simulator.radio.sticks import RadioError, Sticks

_OFF = b"\x00"
_ITEM = re.compile(r"\S+(?: \S+)* {2,}")


class KeyTerminal:
    """Takes a terminal's keys without echo until ``leave``; Ctrl-C still ends the program.

    The terminal is restored on every exit except kill -9: ``leave`` is called at exit, too. Raises
    ``RadioError`` without a terminal.
    """

    def __init__(self, keys: int = 0, picture: int = 1) -> None:
        self._keys = keys
        self._picture = picture
        self._is_shown = False
        try:
            self._saved: Any = termios.tcgetattr(keys)
        except termios.error:
            raise RadioError("the keyboard needs a terminal", "no_terminal") from None
        atexit.register(self.leave)
        tty.setcbreak(keys, termios.TCSANOW)
        settings = termios.tcgetattr(keys)
        # Suspended, the aircraft would stand still in the air and the shell without an echo.
        settings[6][termios.VSUSP] = _OFF
        termios.tcsetattr(keys, termios.TCSANOW, settings)

    def fileno(self) -> int:
        return self._keys

    def read(self) -> bytes:
        try:
            return os.read(self._keys, 256)
        except OSError:
            return b""

    def show(self, line: str) -> None:
        """Show one line in the place of the last one, cut to the terminal's width."""
        self._write(f"\r{line[: self._columns() - 1]}\x1b[K")
        self._is_shown = True

    def echo(self, text: str) -> None:
        """Write lines that stay, wrapped by words, above the line that does not."""
        lines = "\n".join(wrapped(line, self._columns()) for line in text.splitlines())
        self._write(f"\r\x1b[K{lines}\n")
        self._is_shown = False

    def leave(self) -> None:
        """Restore the terminal; keys typed for the sticks must not reach the shell."""
        saved, self._saved = self._saved, None
        if saved is None:
            return
        atexit.unregister(self.leave)
        if self._is_shown:
            self._write("\n")
        with suppress(termios.error):
            termios.tcsetattr(self._keys, termios.TCSAFLUSH, saved)

    def _columns(self) -> int:
        try:
            return os.get_terminal_size(self._picture).columns or 80
        except OSError:
            return 80

    def _write(self, text: str) -> None:
        with suppress(OSError):
            os.write(self._picture, text.encode("utf-8", "replace"))


def wrapped(line: str, columns: int) -> str:
    """Wrap a line to this many columns; an item's continuation is indented past its name."""
    item = _ITEM.match(line)
    indent = item.end() if item is not None and item.end() < columns // 2 else 0
    return textwrap.fill(line, max(columns, 10), subsequent_indent=" " * indent)


SHOW_PERIOD_S = 0.1


class KeyboardRadio:
    """Reads the terminal's keys; ``q``, or the end of input, calls ``on_leave``.

    ``mode`` returns the board's mode, if it is known better than from the switch. Raises
    ``RadioError`` without a terminal.
    """

    def __init__(
        self,
        on_leave: Callable[[], None],
        terminal: KeyTerminal | None = None,
        start: Sticks | None = None,
        mode: Callable[[], str] = lambda: "",
    ) -> None:
        self._terminal = terminal or KeyTerminal()
        self._keys = KeyReader()
        self._keyboard = KeyboardSticks(start)
        self._on_leave = on_leave
        self._mode = mode
        self._is_left = False
        self._shown_s = float("-inf")
        self.echo(HELP)

    def sticks(self, time_s: float, state: FlightState) -> Sticks:
        for key in self._waiting():
            if key == "q":
                self._leave()
            elif key == "?":
                self.echo(HELP)
            else:
                self._keyboard.press(key, time_s)
        sticks = self._keyboard.sticks(time_s)
        if time_s - self._shown_s >= SHOW_PERIOD_S:
            self._shown_s = time_s
            self._terminal.show(status_line(sticks, state, self._mode()))
        return sticks

    def echo(self, text: str) -> None:
        self._terminal.echo(text)

    def close(self) -> None:
        self._terminal.leave()

    def _waiting(self) -> list[str]:
        if self._is_left:
            return []
        with suppress(OSError, ValueError):
            if not select.select([self._terminal], [], [], 0)[0]:
                return []
        data = self._terminal.read()
        if not data:
            self._leave()
        return self._keys.feed(data)

    def _leave(self) -> None:
        if not self._is_left:
            self._is_left = True
            self._on_leave()


def status_line(sticks: Sticks, state: FlightState, mode: str = "") -> str:
    """Return sticks, switch, mode, attitude and height in one line for 80 columns.

    The mode that flies is named where it is another than the switch's.
    """
    part = [round((each - 1500) / 5) for each in (sticks.ailerons, sticks.elevator, sticks.rudder)]
    armed = "armed" if sticks.is_armed else "disarmed"
    flies = sticks.mode if mode in ("", sticks.mode) else f"{sticks.mode}, flies {mode}"
    return (
        f"a{part[0]:+4d} e{part[1]:+4d} r{part[2]:+4d} t{(sticks.throttle - 1000) // 10:3d}%"
        f" {flies} {armed}"
        f" bank {state.roll_deg:+.0f} pitch {state.pitch_deg:+.0f}"
        f" {state.height_m:.0f} m {state.airspeed_m_s:.0f} m/s"
    )

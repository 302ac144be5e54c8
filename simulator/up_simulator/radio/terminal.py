"""A terminal with unbuffered keys, restored afterwards."""

from __future__ import annotations

import atexit
import os
import re
import termios
import textwrap
import tty
from contextlib import suppress
from typing import Any

from up_simulator.radio.sticks import RadioError

KEYS, PICTURE = 0, 1
_OFF = b"\x00"
_ITEM = re.compile(r"\S+(?: \S+)* {2,}")


class KeyTerminal:
    """Takes a terminal's keys without echo until ``leave``; Ctrl-C still ends the program.

    The terminal is restored on every exit except kill -9: ``leave`` is called at exit, too. Raises
    ``RadioError`` without a terminal.
    """

    def __init__(self) -> None:
        self._is_shown = False
        try:
            self._saved: Any = termios.tcgetattr(KEYS)
        except termios.error:
            raise RadioError("the keyboard needs a terminal", "no_terminal") from None
        atexit.register(self.leave)
        tty.setcbreak(KEYS, termios.TCSANOW)
        settings = termios.tcgetattr(KEYS)
        # Suspended, the aircraft would stand still in the air and the shell without an echo.
        settings[6][termios.VSUSP] = _OFF
        termios.tcsetattr(KEYS, termios.TCSANOW, settings)

    def fileno(self) -> int:
        return KEYS

    def read(self) -> bytes:
        try:
            return os.read(KEYS, 256)
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
            termios.tcsetattr(KEYS, termios.TCSAFLUSH, saved)

    def _columns(self) -> int:
        try:
            return os.get_terminal_size(PICTURE).columns or 80
        except OSError:
            return 80

    def _write(self, text: str) -> None:
        with suppress(OSError):
            os.write(PICTURE, text.encode("utf-8", "replace"))


def wrapped(line: str, columns: int) -> str:
    """Wrap a line to this many columns; an item's continuation is indented past its name."""
    item = _ITEM.match(line)
    indent = item.end() if item is not None and item.end() < columns // 2 else 0
    return textwrap.fill(line, max(columns, 10), subsequent_indent=" " * indent)

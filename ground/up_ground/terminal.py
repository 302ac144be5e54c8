"""The terminal: taken over, painted without ever waiting for it, and given back."""

from __future__ import annotations

import contextlib
import os
import termios
import tty
from typing import Any

_ENTER = "\x1b[?1049h\x1b[?25l\x1b[2J"
_LEAVE = "\x1b[0m\x1b[?25h\x1b[?1049l"
_VSUSP_OFF = b"\x00"
_FALLBACK_SIZE = (80, 24)


class Terminal:
    """A full-screen terminal: alternate screen, unbuffered keys, no echo.

    Output uses a separate non-blocking descriptor: a terminal that is slow or stopped (Ctrl-S)
    drops pictures and blocks nothing. ``leave`` restores the terminal.
    """

    def __init__(self, input_descriptor: int = 0, output_descriptor: int = 1) -> None:
        self._input = input_descriptor
        self._output = output_descriptor
        self._own: int | None = None
        self._saved: Any = None
        self._waiting = b""
        self._shown: list[str] = []
        self._shown_size = (0, 0)

    def fileno(self) -> int:
        return self._input

    @property
    def size(self) -> tuple[int, int]:
        try:
            size = os.get_terminal_size(self._output)
        except OSError:
            return _FALLBACK_SIZE
        return (size.columns, size.lines) if size.columns and size.lines else _FALLBACK_SIZE

    def enter(self) -> None:
        with contextlib.suppress(termios.error):
            saved = termios.tcgetattr(self._input)
            tty.setcbreak(self._input, termios.TCSANOW)
            settings = termios.tcgetattr(self._input)
            # A suspended picture would leave the shell on the alternate screen.
            settings[6][termios.VSUSP] = _VSUSP_OFF
            termios.tcsetattr(self._input, termios.TCSANOW, settings)
            self._saved = saved
        with contextlib.suppress(OSError):
            self._own = os.open(
                os.ttyname(self._output), os.O_WRONLY | os.O_NONBLOCK | os.O_NOCTTY | os.O_CLOEXEC
            )
        self._waiting = _ENTER.encode("ascii")
        self._flush()

    def leave(self) -> None:
        if self._own is not None:
            os.close(self._own)
            self._own = None
        if self._saved is not None:
            with contextlib.suppress(termios.error):
                # Keys typed for this screen must not reach the shell.
                termios.tcsetattr(self._input, termios.TCSAFLUSH, self._saved)
            self._saved = None
        with contextlib.suppress(OSError):
            os.write(self._output, _LEAVE.encode("ascii"))

    def keys(self) -> str:
        """Return the keys that wait, empty at the end of input."""
        try:
            return os.read(self._input, 256).decode("ascii", "replace")
        except OSError:
            return ""

    def paint(self, picture: str) -> bool:
        """Show a picture of rows; False if it was dropped because the last one is still queued."""
        if not self._flush():
            return False
        rows = picture.split("\n")
        if self.size != self._shown_size:
            self._shown_size = self.size
            self._shown = []
            self._waiting += b"\x1b[0m\x1b[2J"
        out = []
        for number, row in enumerate(rows):
            if number >= len(self._shown) or self._shown[number] != row:
                out.append(f"\x1b[{number + 1};1H{row}\x1b[K")
        self._shown = rows
        self._waiting += "".join(out).encode("utf-8", "replace")
        self._flush()
        return True

    def _flush(self) -> bool:
        while self._waiting:
            try:
                sent = os.write(self._output if self._own is None else self._own, self._waiting)
            except BlockingIOError:
                return False
            self._waiting = self._waiting[sent:]
        return True

"""Hears Ctrl-C for a flight."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager


class Interrupt:
    """Whether Ctrl-C was pressed."""

    def __init__(self) -> None:
        self.is_asked = False

    def look(self) -> None:
        """Raise KeyboardInterrupt here when it was."""
        if self.is_asked:
            raise KeyboardInterrupt


@contextmanager
def hearing_ctrl_c() -> Iterator[Interrupt]:
    """Note Ctrl-C, to be looked for between steps; a second one ends whatever runs.

    What Python raises by itself could come inside a call from C, which would swallow it.
    """
    interrupt = Interrupt()

    def note(number: int, frame: object) -> None:
        if interrupt.is_asked:
            raise KeyboardInterrupt
        interrupt.is_asked = True

    before = signal.signal(signal.SIGINT, note)
    try:
        yield interrupt
    finally:
        signal.signal(signal.SIGINT, before)

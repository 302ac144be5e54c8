"""What a module registered with the system, so that it can be taken back as a whole."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

Undo = Callable[[], object]


class Registrations:
    """Notes what is registered while a module is initialized and started.

    Whatever the system offers for registering says with ``note_undo`` how it is taken back. A
    start that goes on later keeps its module: the note is a context variable, which coroutines
    carry along.
    """

    def __init__(self) -> None:
        self._undos: list[Undo] = []
        self._is_over = False
        self._is_kept = False

    @contextmanager
    def noted(self) -> Iterator[None]:
        """Note what is registered meanwhile, also by coroutines that begin meanwhile."""
        token = _noting.set(self)
        try:
            yield
        finally:
            _noting.reset(token)

    def undo(self) -> None:
        """Take everything back, the newest first; what comes after is taken back at once."""
        self._is_over = True
        while self._undos:
            self._undos.pop()()

    def keep(self) -> None:
        """Let everything stand for good; what comes after is not noted."""
        self._is_kept = True
        self._undos.clear()

    def add(self, undo: Undo) -> None:
        """Note one thing."""
        if self._is_over:
            undo()
        elif not self._is_kept:
            self._undos.append(undo)


_noting: ContextVar[Registrations | None] = ContextVar("registrations", default=None)


def note_undo(undo: Undo) -> None:
    """Say how what was just registered is taken back; to do so must be harmless at any time."""
    registrations = _noting.get()
    if registrations is not None:
        registrations.add(undo)

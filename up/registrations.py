"""The registrations of a module, so that they can be undone as a whole."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

Undo = Callable[[], object]


class Registrations:
    """Notes registrations while a module is initialized and started.

    Every registering method of the system calls ``note_undo`` with the undo function. An
    asynchronous start keeps its module: the current registrations are a context variable, which
    coroutines inherit.
    """

    def __init__(self) -> None:
        self._undos: list[Undo] = []
        self._is_over = False
        self._is_kept = False

    @contextmanager
    def noted(self) -> Iterator[None]:
        """Note registrations inside the context, including those of coroutines started in it."""
        token = _noting.set(self)
        try:
            yield
        finally:
            _noting.reset(token)

    def undo(self) -> None:
        """Undo everything, newest first; later registrations are undone immediately."""
        self._is_over = True
        while self._undos:
            self._undos.pop()()

    def keep(self) -> None:
        """Keep everything permanently; later registrations are not noted."""
        self._is_kept = True
        self._undos.clear()

    def add(self, undo: Undo) -> None:
        """Note one undo function."""
        if self._is_over:
            undo()
        elif not self._is_kept:
            self._undos.append(undo)


_noting: ContextVar[Registrations | None] = ContextVar("registrations", default=None)


def note_undo(undo: Undo) -> None:
    """Note how to undo the registration just made; the function must be harmless at any time."""
    registrations = _noting.get()
    if registrations is not None:
        registrations.add(undo)

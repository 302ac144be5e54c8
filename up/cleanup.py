"""The cleanups of a module's registrations, so that they can be undone as a whole."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

Cleanup = Callable[[], object]


class CleanupStack:
    """Collects cleanups while a module is initialized and started.

    Every registering method of the system calls ``add_cleanup``. An asynchronous start keeps its
    stack: the active stack is a context variable, which coroutines inherit.
    """

    def __init__(self) -> None:
        self._cleanups: list[Cleanup] = []
        self._is_unwound = False
        self._is_discarded = False

    @contextmanager
    def recording(self) -> Iterator[None]:
        """Collect cleanups inside the context, including those of coroutines started in it."""
        token = _active.set(self)
        try:
            yield
        finally:
            _active.reset(token)

    def unwind(self) -> None:
        """Run every cleanup, newest first; later ones run immediately."""
        self._is_unwound = True
        while self._cleanups:
            self._cleanups.pop()()

    def discard(self) -> None:
        """Drop every cleanup, so that the registrations stay; later ones are not collected."""
        self._is_discarded = True
        self._cleanups.clear()

    def add(self, cleanup: Cleanup) -> None:
        if self._is_unwound:
            cleanup()
        elif not self._is_discarded:
            self._cleanups.append(cleanup)


_active: ContextVar[CleanupStack | None] = ContextVar("cleanups", default=None)


def add_cleanup(cleanup: Cleanup) -> None:
    """Add the cleanup of the registration just made; it must be harmless at any time."""
    stack = _active.get()
    if stack is not None:
        stack.add(cleanup)

"""Connections that wait because too many are new; their sources take turns."""

from collections import deque
from typing import Generic, TypeVar

_T = TypeVar("_T")


class AdmissionQueue(Generic[_T]):
    """At most `size` items, first come first served within a source; the sources take turns.

    When it is full, the source with the most items loses its newest one: a flood displaces only
    its own connections.
    """

    def __init__(self, size: int) -> None:
        self._size = size
        self._queues: dict[str, deque[_T]] = {}
        """In the order of their turns."""
        self._count = 0

    def __len__(self) -> int:
        return self._count

    def put(self, source: str, item: _T) -> _T | None:
        """Add an item; return the one that has lost its place, which can be this one."""
        self._queues.setdefault(source, deque()).append(item)
        self._count += 1
        if self._count <= self._size:
            return None
        # In a tie the newcomer loses: it has waited for the shortest time.
        heaviest = max(self._queues, key=lambda each: (len(self._queues[each]), each == source))
        lost = self._queues[heaviest].pop()
        self._forget_empty(heaviest)
        return lost

    def pop(self) -> _T:
        """Return the next item. Raises StopIteration if there is none."""
        source = next(iter(self._queues))
        queue = self._queues.pop(source)
        item = queue.popleft()
        self._queues[source] = queue
        self._forget_empty(source)
        return item

    def _forget_empty(self, source: str) -> None:
        self._count -= 1
        if not self._queues[source]:
            del self._queues[source]

"""Selects which of several sources of one reading is followed."""

import math
from collections.abc import Callable

from up.quick_dataclass import dataclass

RETURN_AFTER_S = 1.0


@dataclass(slots=True)
class _Source:
    priority: int
    newest_s: float
    good_since_s: float


class SourceArbiter:
    """Follows the freshest source of the highest priority.

    A source is fresh while its data are at most ``max_age_s`` old. A source of lower priority is
    followed when those above it are not fresh; returning to a higher one needs ``RETURN_AFTER_S``
    of valid data from it, without an invalid one between. Times are monotonic seconds.
    """

    def __init__(self, max_age_s: float, on_switch: Callable[[str, str], object]) -> None:
        self.current = ""
        self._max_age_s = max_age_s
        self._on_switch = on_switch
        self._sources: dict[str, _Source] = {}

    def accepts(self, source: str, priority: int, now_s: float) -> bool:
        """Note valid data of a source and return whether to use them."""
        known = self._sources.get(source)
        if known is None:
            known = self._sources[source] = _Source(priority, now_s, now_s)
        elif now_s - known.newest_s > self._max_age_s:
            known.good_since_s = now_s
        known.newest_s = now_s
        known.priority = priority
        if source == self.current:
            return True
        return self._takes_over(source, known, now_s)

    def note_invalid(self, source: str, now_s: float) -> None:
        """Note data that the source itself marks invalid: its valid time restarts."""
        known = self._sources.get(source)
        if known is not None:
            known.good_since_s = now_s

    def note_left_out(self, source: str, now_s: float) -> None:
        """Note data that their user leaves out: the source is not fresh, whatever it sends."""
        known = self._sources.get(source)
        if known is not None:
            known.newest_s, known.good_since_s = -math.inf, now_s

    def _takes_over(self, source: str, candidate: _Source, now_s: float) -> bool:
        current = self._sources.get(self.current)
        if current is not None and now_s - current.newest_s <= self._max_age_s:
            if candidate.priority <= current.priority:
                return False
            if now_s - candidate.good_since_s < RETURN_AFTER_S:
                return False
        elif self._is_better_fresh(source, candidate.priority, now_s):
            return False
        previous, self.current = self.current, source
        self._on_switch(previous, source)
        return True

    def _is_better_fresh(self, source: str, priority: int, now_s: float) -> bool:
        return any(
            name != source
            and other.priority > priority
            and now_s - other.newest_s <= self._max_age_s
            and now_s - other.good_since_s >= RETURN_AFTER_S
            for name, other in self._sources.items()
        )

"""Limits repeated log events."""

from collections.abc import Callable, Hashable
from typing import Any

from up.quick_dataclass import dataclass
from up.system.clock import Clock, Timer

Emit = Callable[..., None]


class Once:
    """Remembers keys seen: at most `limit` of them, beyond which no key counts as new."""

    def __init__(self, limit: int = 1000) -> None:
        self._limit = limit
        self._seen: set[Hashable] = set()

    def first(self, key: Hashable) -> bool:
        if key in self._seen or len(self._seen) >= self._limit:
            return False
        self._seen.add(key)
        return True


@dataclass(slots=True)
class _Suppressed:
    """The events suppressed in the current interval, with the newest one."""

    call: Timer
    emit: Emit
    format_: str
    fields: dict[str, Any]
    more: int = 0


class Limited:
    """Passes one event per key in `interval_s`, and then reports how many more there were.

    For the reactor's thread. Beyond `limit` keys in one interval the rest share one key.
    """

    def __init__(self, clock: Clock, interval_s: float, limit: int = 1000) -> None:
        self._clock = clock
        self._interval_s = interval_s
        self._limit = limit
        self._suppressed: dict[Hashable, _Suppressed] = {}
        self._is_stopped = False

    def log(self, emit: Emit, format_: str, *, key: Hashable = None, **fields: Any) -> None:
        """Log by `emit` (a logger's method), now or counted; the format is the default key."""
        if self._is_stopped:
            emit(format_, **fields)
            return
        key = format_ if key is None else key
        if key not in self._suppressed and len(self._suppressed) >= self._limit:
            key = _OTHERS
        held = self._suppressed.get(key)
        if held is None:
            self._suppressed[key] = _Suppressed(self._schedule(key), emit, format_, fields)
            emit(format_, **fields)
        else:
            held.emit, held.format_, held.fields = emit, format_, fields
            held.more += 1

    def stop(self) -> None:
        """Report the suppressed events; later ones pass, and leave no timer behind."""
        self._is_stopped = True
        held_back, self._suppressed = self._suppressed, {}
        for held in held_back.values():
            held.call.cancel()
            self._report(held)

    def _schedule(self, key: Hashable) -> Timer:
        return self._clock.callLater(self._interval_s, self._end_interval, key)

    def _end_interval(self, key: Hashable) -> None:
        held = self._suppressed[key]
        if not held.more:
            del self._suppressed[key]
            return
        self._report(held)
        held.more = 0
        held.call = self._schedule(key)

    def _report(self, held: _Suppressed) -> None:
        if held.more:
            held.emit(
                held.format_ + " (and {more} more in {interval_s:g} s)",
                **held.fields,
                more=held.more,
                interval_s=self._interval_s,
            )


_OTHERS = object()

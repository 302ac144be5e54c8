"""The proxy's periodic tick and the lateness of its event loop."""

from collections import deque
from collections.abc import Callable

from up.system.clock import Clock, Timer, cancel

TICK_S = 0.25
"""Period of the checks of silence, idleness and leases."""
_WINDOW = 240


class LoopTick:
    """Calls `on_tick` every TICK_S and measures the lateness of the event loop.

    `lag_max_s` covers the last minute.
    """

    def __init__(self, clock: Clock, on_tick: Callable[[], None]) -> None:
        self._clock = clock
        self._on_tick = on_tick
        self._started_s = clock.seconds()
        self._due_s = 0.0
        self._timer: Timer | None = None
        self._lags_s: deque[float] = deque([0.0], maxlen=_WINDOW)

    @property
    def uptime_s(self) -> float:
        return self._clock.seconds() - self._started_s

    @property
    def lag_s(self) -> float:
        return self._lags_s[-1]

    @property
    def lag_max_s(self) -> float:
        return max(self._lags_s)

    def start(self) -> None:
        self._started_s = self._clock.seconds()
        self._arm()

    def stop(self) -> None:
        cancel(self._timer)

    def _arm(self) -> None:
        self._due_s = self._clock.seconds() + TICK_S
        self._timer = self._clock.callLater(TICK_S, self._tick)

    def _tick(self) -> None:
        self._lags_s.append(max(0.0, self._clock.seconds() - self._due_s))
        self._arm()
        self._on_tick()

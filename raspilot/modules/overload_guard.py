"""Notices an event loop that is blocked again and again, and stops optional modules."""

import time
from collections import Counter, deque
from collections.abc import Callable, Mapping
from typing import NamedTuple

from twisted.internet.defer import Deferred

from up.base_periodic_module import BasePeriodicModule
from up.base_started_module import BaseStartedModule
from up.failures import FailureSource
from up.needs import needed_by

REACTOR = "reactor"
"""The counters of the reactor's monitor: blocks of more than 20 ms, by the module to blame."""
WINDOW_S = 10.0
MANY = 10
"""This number of blocks in WINDOW_S are an overload; a busy computer causes a few."""
BUSY_SHARE = 0.8
"""Below this share of a core other modules do not cause it: only the one to blame is stopped."""


class _Sample(NamedTuple):
    time_s: float
    processor_s: float
    blocks: Counter[str]


class OverloadGuard(BasePeriodicModule, FailureSource):
    """Reports the failure ``overload``, and sheds modules with a ``SHED_ORDER`` while it lasts.

    The one that causes most blocks goes first if it may; otherwise, while the reactor's thread
    itself is busy, that with the lowest number, one in WINDOW_S. It is stopped for good, with an
    arming veto by its name. Modules that another one needs stay, and so does all control.
    """

    processor_s: Callable[[], float] = staticmethod(time.thread_time)

    def on_init(self) -> None:
        self._samples: deque[_Sample] = deque()
        self._is_overloaded = False
        self._next_s = float("-inf")
        self._seconds = self.context.reactor.seconds

    @property
    def failures(self) -> Mapping[str, bool]:
        return {"overload": self._is_overloaded}

    def on_period(self) -> None:
        samples, now_s = self._samples, self._seconds()
        newest = _Sample(now_s, self.processor_s(), Counter(self.up.counters_of(REACTOR)))
        samples.append(newest)
        while now_s - samples[0].time_s > WINDOW_S:
            samples.popleft()
        oldest = samples[0]
        blocks = newest.blocks - oldest.blocks
        self._is_overloaded = blocks.total() >= MANY
        if not self._is_overloaded or now_s < self._next_s:
            return
        passed_s = now_s - oldest.time_s
        is_busy = newest.processor_s - oldest.processor_s >= BUSY_SHARE * passed_s
        victim = self._victim(blocks, is_busy=is_busy and passed_s > WINDOW_S / 2)
        if victim is not None:
            self._next_s = now_s + WINDOW_S
            self._shed(victim, blocks)

    def _victim(self, blocks: Counter[str], *, is_busy: bool) -> BaseStartedModule | None:
        modules = self.up.modules
        needed = [each for module in modules for each in needed_by(module)]
        optional = [
            each for each in self.up.get_modules(BaseStartedModule)
            if each.SHED_ORDER is not None and each.started and each not in needed
        ]  # fmt: skip
        [(worst, count)] = blocks.most_common(1)
        for each in optional:
            if each.class_name == worst and count >= MANY:
                return each
        return (
            min(optional, key=lambda each: each.SHED_ORDER or 0) if is_busy and optional else None
        )

    def _shed(self, module: BaseStartedModule, blocks: Counter[str]) -> None:
        [(worst, count)] = blocks.most_common(1)
        reason = (
            f"stopped: the program was overloaded, {count} times in {WINDOW_S:.0f} s by {worst};"
            " restart it"
        )
        self.up.exclude(module, reason)
        stopped = Deferred.fromCoroutine(module.stop())
        stopped.addErrback(
            lambda failure: self.log.failure("it did not stop", failure, code="stop_failed")
        )

"""Wanted instances that no runner holds: the first runner of the ranking starts them."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Awaitable, Callable

from up.log import UpLogger
from up_cluster.membership import run
from up_runner.pool.directory import PoolDirectory
from up_runner.pool.hosted import HostedInstances
from up_runner.request import Request
from up_runner.response import Response

STEP_S = 1.0
"""After how long the next runner of the ranking takes an orphan."""
RETRY_S = 10.0
"""After a failed start."""
MAX_STARTS = 2 * max(2, os.cpu_count() or 1)
"""At the same time: with more, the starts on one machine miss their time limits."""
_QUIET = frozenset(("elsewhere", "cluster", "draining", "instance_limit"))
_log = UpLogger.get_logger("runner.pool")


class Orphans:
    """Takes orphans over: the first runner of the ranking immediately, the others later."""

    def __init__(
        self,
        directory: PoolDirectory,
        hosted: HostedInstances,
        counts: Counter[str],
        start: Callable[[Request], Awaitable[Response]],
    ) -> None:
        self._directory = directory
        self._hosted = hosted
        self._counts = counts
        self._start = start
        self._since_s: dict[str, float] = {}
        self._next_s: dict[str, float] = {}
        self._starts = 0

    def __len__(self) -> int:
        return len(self._since_s)

    def sweep(self, at_s: float, own_id: str, ranking: Callable[[Request], list[str]]) -> None:
        """Start the orphans whose turn it is; without a current directory there are none."""
        found = self._directory.wanted if self._directory.is_current else {}
        self._since_s = {
            name: self._since_s.get(name, at_s)
            for name in found
            if name not in self._directory.holders and name not in self._hosted
        }
        self._next_s = {name: due_s for name, due_s in self._next_s.items() if name in found}
        for name, since_s in self._since_s.items():
            if self._starts >= MAX_STARTS or at_s < self._next_s.get(name, 0.0):
                continue
            order = ranking(found[name])
            if own_id in order and at_s - since_s >= order.index(own_id) * STEP_S:
                self._next_s[name] = at_s + RETRY_S
                self._starts += 1
                run(self._take(found[name]), "an orphan")

    async def _take(self, request: Request) -> None:
        name = request.aircraft
        try:
            response = await self._start(request)
        finally:
            self._starts -= 1
        if response.running:
            self._counts["taken_over"] += 1
            self._next_s.pop(name, None)
            _log.info("{name} runs here now", code="orphan_taken", name=name, pid=response.pid)
        elif response.error is not None and response.error.code not in _QUIET:
            text, code = "cannot take {name} over: {reason}", response.error.code
            _log.error(text, code=code, name=name, reason=str(response.error))

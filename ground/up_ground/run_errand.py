"""Runs an errand on the real reactor."""

from __future__ import annotations

import signal
from collections.abc import Callable
from typing import Any

from twisted.internet.defer import Deferred

from up.system.clock import use_monotonic_time
from up.system.pid_file import service
from up_ground.errand import EXIT_INTERRUPTED, EXIT_REFUSED, complain

MakeErrand = Callable[[Any], Any]


@service()
def run(make: MakeErrand) -> int:
    """Do an errand on the real reactor until it is finished or interrupted."""
    from twisted.internet import reactor

    loop: Any = reactor
    use_monotonic_time(loop)
    errand = make(loop)
    status = [EXIT_INTERRUPTED]

    async def do() -> None:
        errand.start()
        status[0] = await errand.finished
        await errand.stop()
        loop.stop()

    def begin() -> None:
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, lambda *_: loop.callFromThread(errand.finish, EXIT_INTERRUPTED))
        Deferred.fromCoroutine(do()).addErrback(_crash)

    def _crash(failure: Any) -> None:
        complain(f"a mistake in the program: {failure.getErrorMessage()}")
        status[0] = EXIT_REFUSED
        loop.stop()

    loop.callWhenRunning(begin)
    loop.run(installSignalHandlers=False)
    return status[0]

"""One-shot tasks on the link, with an exit status and a last message."""

from __future__ import annotations

import signal
import sys
from collections.abc import Callable
from typing import Any

from twisted.internet.defer import Deferred

from up.system.clock import use_monotonic_time
from up.system.pid_file import service
from up_ground.ground_link import GroundLink

EXIT_DONE = 0
EXIT_REFUSED = 1
EXIT_USAGE = 2
EXIT_NO_ANSWER = 3
EXIT_INTERRUPTED = 130

Echo = Callable[[str], object]


class OneShotTask:
    """A one-shot task over a link; ``finished`` fires with the exit status.

    ``echo`` takes lines for the user, ``print_error`` lines for stderr.
    """

    link: GroundLink

    def __init__(self, echo: Echo, print_error: Echo) -> None:
        self.finished: Deferred[int] = Deferred()
        self.print_error = print_error
        self._say = echo
        self._timers: dict[str, Any] = {}

    def finish(self, status: int) -> None:
        """End; the first status counts."""
        for timer in self._timers.values():
            if timer.active():
                timer.cancel()
        if not self.finished.called:
            self.finished.callback(status)

    async def stop(self) -> None:
        """Close all that was opened; returns when it is closed."""
        await self.link.stop()

    def echo(self, text: str) -> None:
        """Print a line for the user; a closed output ends the task."""
        try:
            self._say(text)
        except OSError:
            self.finish(EXIT_DONE)

    @property
    def is_finished(self) -> bool:
        """Return whether the task has ended."""
        return bool(self.finished.called)

    def after(self, reactor: Any, name: str, delay_s: float, call: Callable[[], object]) -> None:
        """Call later, unless the task ends or another call of that name replaces it."""
        self.cancel_timer(name)
        if not self.is_finished:
            self._timers[name] = reactor.callLater(delay_s, call)

    def cancel_timer(self, name: str) -> None:
        """Take a call back."""
        timer = self._timers.pop(name, None)
        if timer is not None and timer.active():
            timer.cancel()


def echo(text: str) -> None:
    """Write a line for the user."""
    sys.stdout.write(text + "\n")
    sys.stdout.flush()


def print_error(text: str) -> None:
    """Write a line to stderr."""
    sys.stderr.write(f"up-ground: {text}\n")
    sys.stderr.flush()


MakeTask = Callable[[Any], Any]


@service()
def run(make: MakeTask) -> int:
    """Run a task on the real reactor until it is finished or interrupted."""
    from twisted.internet import reactor

    loop: Any = reactor
    use_monotonic_time(loop)
    task = make(loop)
    status = [EXIT_INTERRUPTED]

    async def do() -> None:
        task.start()
        status[0] = await task.finished
        await task.stop()
        loop.stop()

    def begin() -> None:
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, lambda *_: loop.callFromThread(task.finish, EXIT_INTERRUPTED))
        Deferred.fromCoroutine(do()).addErrback(_crash)

    def _crash(failure: Any) -> None:
        print_error(f"a mistake in the program: {failure.getErrorMessage()}")
        status[0] = EXIT_REFUSED
        loop.stop()

    loop.callWhenRunning(begin)
    loop.run(installSignalHandlers=False)
    return status[0]

"""One-shot tasks on the link, with an exit status and a last message."""

from __future__ import annotations

import signal
import sys
from collections.abc import Callable
from typing import Any

from twisted.internet.defer import Deferred

from up.cli.option_parser import EXIT_FAILED, EXIT_INTERRUPTED, EXIT_OK
from up.output import echo, program_error
from up.protocols.general_message import GeneralMessage
from up.sanitize_text import sanitize_text
from up.system.clock import cancel, use_monotonic_time
from up.system.pid_file import service
from up_ground.ground_link import GroundLink
from up_ground.link_status import ASK_INTERVAL_S, ControlStatus, LinkState, control_status
from up_ground.settings import Settings
from up_ground.token_store import TokenStore

EXIT_NO_ANSWER = 3
"""No connection, no aircraft or no answer."""


class OneShotTask:
    """A one-shot task over a link; ``finished`` fires with the exit status."""

    def __init__(self) -> None:
        self.finished: Deferred[int] = Deferred()
        self._timers: dict[str, Any] = {}

    def finish(self, status: int) -> None:
        """End; the first status counts."""
        cancel(*self._timers.values())
        if not self.finished.called:
            self.finished.callback(status)

    def echo(self, text: str, code: str = "", **fields: object) -> None:
        """Print a line for the user; a closed output ends the task."""
        try:
            echo(text, code, **fields)
        except OSError:
            self.finish(EXIT_OK)

    def fail(self, text: str, code: str, status: int, **fields: object) -> None:
        print_error(sanitize_text(text, 600), code, **fields)
        self.finish(status)

    @property
    def is_finished(self) -> bool:
        return bool(self.finished.called)

    def after(self, reactor: Any, name: str, delay_s: float, call: Callable[[], object]) -> None:
        """Call later, unless the task ends or another call of that name replaces it."""
        self.cancel_timer(name)
        if not self.is_finished:
            self._timers[name] = reactor.callLater(delay_s, call)

    def cancel_timer(self, name: str) -> None:
        cancel(self._timers.pop(name, None))


class LinkTask(OneShotTask):
    """A task over a link to an aircraft, whose listener it is."""

    def __init__(self, reactor: Any, settings: Settings, tokens: TokenStore) -> None:
        super().__init__()
        self.link = GroundLink(reactor, settings, self, tokens)
        self._reactor = reactor
        self._settings = settings

    async def stop(self) -> None:
        await self.link.stop()

    def on_message(self, message: GeneralMessage) -> None: ...

    def on_link(self) -> None:
        """End when the link is lost; otherwise continue with `on_control`."""
        status = self.link.status
        if self.is_finished:
            return
        if status.state is LinkState.WAITING:
            exit_status = EXIT_FAILED if status.rejection else EXIT_NO_ANSWER
            code = status.rejection or status.code
            self.fail(status.reason, code, exit_status)
        elif status.is_open:
            self.on_control(control_status(status, self._settings.direct))

    def on_control(self, control: ControlStatus) -> None: ...

    def request_control(self) -> None:
        """Request control until the task ends or cancels the timer ``request``."""
        self.link.request_seat()
        self.after(self._reactor, "request", ASK_INTERVAL_S, self.request_control)


def print_error(text: str, code: str, **fields: object) -> None:
    """Write a line to stderr, as JSON with UP_LOG_FORMAT=json."""
    sys.stderr.write(f"{program_error('up-ground', text, code, **fields)}\n")


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
            # 'nohup' ignores SIGHUP.
            if number != signal.SIGHUP or signal.getsignal(number) != signal.SIG_IGN:
                signal.signal(number, lambda *_: loop.callFromThread(task.finish, EXIT_INTERRUPTED))
        Deferred.fromCoroutine(do()).addErrback(_crash)

    def _crash(failure: Any) -> None:
        print_error(f"error in the program: {failure.getErrorMessage()}", "internal")
        status[0] = EXIT_FAILED
        loop.stop()

    loop.callWhenRunning(begin)
    loop.run(installSignalHandlers=False)
    return status[0]

"""The program `up-runner`."""

from __future__ import annotations

import gc
import os
import signal
import sys
from collections.abc import Sequence
from typing import Any

from up.cli.option_parser import EXIT_FAILED
from up.cli.server_parser import ServerParser
from up.log import start_logging
from up.output import program_error
from up.system.clock import use_monotonic_time
from up.system.pid_file import service
from up_runner.config import RUNNER
from up_runner.paths import own_root


@service()
def main(arguments: Sequence[str] | None = None) -> int:
    """Run the program and return its exit status: 1 cannot start, 2 wrong configuration."""
    parser = ServerParser(
        RUNNER,
        ("--port",),
        prog="up-runner",
        description="Starts and supervises a Raspilot for each aircraft whose phone requests one\n"
        "on TCP port 3002.",
        epilog='Try it: echo \'{"aircraft": "glider-1"}\' | nc 127.0.0.1 3002',
    )
    options, folder, config = parser.load(arguments, own_root() / "config")
    start_logging(options.log_level or "info")
    from twisted.internet import reactor

    from up_runner.run_folder import CannotStart
    from up_runner.runner import Runner

    use_monotonic_time(reactor)
    runner = Runner(reactor, config, folder)
    _end_by_signals(reactor)
    try:
        runner.start()
    except CannotStart as error:
        sys.stderr.write(f"{program_error('up-runner', str(error), error.code)}\n")
        return EXIT_FAILED
    _serve(reactor, runner)
    return 0


def _end_by_signals(reactor: Any) -> None:
    """End by a signal; a second one does not wait for the instances. Before the port is open."""
    signals: list[int] = []

    def on_signal(number: int, frame: object) -> None:
        signals.append(number)
        if len(signals) > 1:
            os._exit(128 + number)
        reactor.callFromThread(reactor.stop)

    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, on_signal)


def _serve(reactor: Any, runner: Any) -> None:
    """Run until a signal."""
    from twisted.internet.defer import Deferred

    reactor.addSystemEventTrigger(
        "before", "shutdown", lambda: Deferred.fromCoroutine(runner.stop())
    )
    # Objects of the start-up stay; the collector need not visit them again.
    gc.collect()
    gc.freeze()
    reactor.run(installSignalHandlers=False)


if __name__ == "__main__":
    sys.exit(main())

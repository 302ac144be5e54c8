"""The program `up-runner`."""

from __future__ import annotations

import argparse
import gc
import os
import signal
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from up.config import ConfigErrors
from up.log import start_logging
from up.system.clock import use_monotonic_time
from up.system.pid_file import service
from up.version import VERSION
from up_runner.config import RUNNER
from up_runner.paths import own_root

EXIT_CANNOT_START = 1
EXIT_CONFIGURATION = 2


def parse_arguments(arguments: Sequence[str] | None = None) -> argparse.Namespace:
    """Return the command line's options."""
    parser = argparse.ArgumentParser(
        prog="up-runner",
        description="Starts and supervises a Raspilot for each aircraft whose phone requests one "
        "on TCP port 3002.",
        epilog='Try it: echo \'{"aircraft": "glider-1"}\' | nc 127.0.0.1 3002',
    )
    parser.add_argument(
        "--config", type=Path, metavar="DIR", help="folder of runner.yml (default: config)"
    )
    parser.add_argument("--port", type=_port, metavar="N", help="TCP port; 0: any free port")
    parser.add_argument("--log-level", choices=("debug", "info", "warning", "error"))
    parser.add_argument("--version", action="version", version=f"up-runner {VERSION}")
    return parser.parse_args(arguments)


@service()
def main(arguments: Sequence[str] | None = None) -> int:
    """Run the program and return its exit status: 1 cannot start, 2 wrong configuration."""
    # Until it serves, Ctrl-C simply ends it: there is nothing to clean up.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    options = parse_arguments(arguments)
    folder = options.config or own_root() / "config"
    if options.config is not None and not folder.is_dir():
        return _fail(f"--config {folder}: no such folder", EXIT_CONFIGURATION)
    try:
        config = RUNNER.load(folder)
    except ConfigErrors as errors:
        return _fail(str(errors), EXIT_CONFIGURATION)
    if options.port is not None:
        config = replace(config, port=options.port)
    start_logging(options.log_level or "info")
    from twisted.internet import reactor

    from up_runner.runner import CannotStart, Runner

    use_monotonic_time(reactor)
    runner = Runner(reactor, config, folder)
    try:
        runner.start()
    except CannotStart as error:
        return _fail(f"up-runner: {error}", EXIT_CANNOT_START)
    _serve(reactor, runner)
    return 0


def _serve(reactor: Any, runner: Any) -> None:
    """Run until a signal; a second one does not wait for the instances."""
    signals: list[int] = []

    def on_signal(number: int, frame: object) -> None:
        signals.append(number)
        if len(signals) > 1:
            os._exit(128 + number)
        reactor.callFromThread(reactor.stop)

    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, on_signal)
    reactor.addSystemEventTrigger("before", "shutdown", _stopping(runner))
    # Objects of the start-up stay; the collector need not visit them again.
    gc.collect()
    gc.freeze()
    reactor.run(installSignalHandlers=False)


def _stopping(runner: Any) -> Any:
    from twisted.internet.defer import Deferred

    return lambda: Deferred.fromCoroutine(runner.stop())


def _port(text: str) -> int:
    port = int(text) if text.isascii() and text.isdigit() and len(text) < 6 else -1
    if not 0 <= port <= 65535:
        raise argparse.ArgumentTypeError(f"a port is a number from 0 to 65535, not {text!r}")
    return port


def _fail(text: str, status: int) -> int:
    sys.stderr.write(f"{text}\n")
    return status


if __name__ == "__main__":
    sys.exit(main())

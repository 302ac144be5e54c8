"""The program: ``python -m up_simulator``."""

from __future__ import annotations

import sys
import time
from contextlib import suppress
from typing import Any

from twisted.internet.defer import Deferred

from up_rig.pty_line import PtyLineError
from up_simulator.flight import FlightUnavailableError
from up_simulator.options import read_options
from up_simulator.simulation import Simulation


def main(arguments: list[str] | None = None) -> int:
    """Fly until SIGINT or SIGTERM and return the exit status."""
    options = read_options(arguments)
    from twisted.internet import reactor as default_reactor

    reactor: Any = default_reactor
    # The reactor keeps wall-clock time by itself, and a flight must not see that jump.
    reactor.seconds = time.monotonic
    failures: list[Any] = []

    def fail(failure: Any) -> None:
        failures.append(failure)
        reactor.stop()

    try:
        simulation = Simulation(reactor, options, say)
    except (FlightUnavailableError, PtyLineError, OSError) as error:
        sys.stderr.write(f"up_simulator: {error}\n")
        return 1
    reactor.callWhenRunning(simulation.start, fail)
    reactor.addSystemEventTrigger(
        "before", "shutdown", lambda: Deferred.fromCoroutine(simulation.stop())
    )
    reactor.run()
    for failure in failures:
        failure.printTraceback()
    return 1 if failures else 0


def say(text: str) -> None:
    """Write one line for the user; a closed standard output ends no flight."""
    with suppress(BrokenPipeError):
        sys.stdout.write(f"{text}\n")
        sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())

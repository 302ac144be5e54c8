"""``up-sim start``: the virtual aircraft in real time, until Ctrl-C."""

from __future__ import annotations

import signal
import sys
import time
from typing import Any

from twisted.internet.defer import Deferred

from up.cli.option_parser import EXIT_USAGE as WRONG_INPUT
from up.output import program_error
from up.system.pid_file import service
from up_rig.pty_line import PtyLineError
from up_simulator.aircraft import AirframeError
from up_simulator.aircraft.flight import FlightUnavailableError
from up_simulator.firmware.board import BoardCrashedError
from up_simulator.firmware.build import BoardUnavailableError
from up_simulator.firmware.preparation import PreparationError
from up_simulator.harness.participants import ParticipantError
from up_simulator.harness.signal_handling import handle
from up_simulator.harness.start_options import read_options
from up_simulator.harness.user_log import print_line
from up_simulator.harness.virtual_aircraft import VirtualAircraft
from up_simulator.link.relay import LinkRelayError
from up_simulator.radio.sticks import RadioError

FOR_THE_USER = (
    AirframeError,
    BoardCrashedError,
    BoardUnavailableError,
    ParticipantError,
    FlightUnavailableError,
    LinkRelayError,
    OSError,
    PreparationError,
    PtyLineError,
    RadioError,
)


@service()
def main(arguments: list[str] | None = None) -> int:
    """Fly until SIGINT, SIGTERM or SIGHUP and return the exit status."""
    options = read_options(arguments)
    from twisted.internet import reactor as default_reactor

    reactor: Any = default_reactor
    # The reactor's own clock is wall-clock time, and a flight must not see its jumps.
    reactor.seconds = time.monotonic
    failures: list[Any] = []

    def fail(failure: Any) -> None:
        failures.append(failure)
        reactor.stop()

    handle(signal.SIGTERM, _end_early)
    handle(signal.SIGHUP, _end_early)
    # The reactor takes Ctrl-C over from Python's own handler, and from no other.
    handle(signal.SIGINT, signal.default_int_handler)
    try:
        aircraft = VirtualAircraft(
            reactor, options, print_line, lambda: reactor.callLater(0, reactor.stop)
        )
    except FOR_THE_USER as error:
        sys.stderr.write(f"{program_error('up-sim', str(error), 'start_failed')}\n")
        return WRONG_INPUT if isinstance(error, AirframeError) else 1
    reactor.callWhenRunning(_end_on_hangup, reactor)
    reactor.callWhenRunning(aircraft.start, fail)
    reactor.addSystemEventTrigger(
        "before", "shutdown", lambda: Deferred.fromCoroutine(aircraft.stop())
    )
    reactor.run()
    for failure in failures:
        if failure.check(*FOR_THE_USER):
            text = failure.getErrorMessage()
            sys.stderr.write(f"{program_error('up-sim', text, 'flight_failed')}\n")
        else:
            failure.printTraceback()
    return 1 if failures else 0


def _end_early(_number: int, _frame: object) -> None:
    """End during the construction, and release what exists so far."""
    raise SystemExit(0)


def _end_on_hangup(reactor: Any) -> None:
    """End as for SIGTERM when the terminal is closed, so that the link to the pty goes, too."""

    def end(_number: int, _frame: object) -> None:
        reactor.callFromThread(reactor.stop)

    handle(signal.SIGHUP, end)

"""Saves gains without blocking the flight on the disk."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from twisted.internet.defer import Deferred

from up.commands.gains import GainSet, navigation_of
from up.commands.pid_tunings_commands import PIDTuningsCommand
from up.commands.refusal import Code, CommandRefusedError
from up.flight_controller.pids_file import PidsFile


def refuse_unused(command: PIDTuningsCommand, gains: GainSet, held: GainSet) -> None:
    """Raise CommandRefusedError if a set changes a gain that no controller uses.

    The rudder's stabilize gains must be those held, ``navPIDs`` must be 0.
    """
    navigation = navigation_of(command.pids or {})
    has_navigation = navigation is not None and any(map(any, navigation.axes))
    if has_navigation or gains.completed(held).stabilize.rudder != held.stabilize.rudder:
        text = (
            "no controller uses the rudder's stabilize gains and navPIDs (the numbers of the path"
            " controller are in navigation.yml)"
        )
        raise CommandRefusedError(text, Code.NOT_SUPPORTED)


def _in_thread(work: Callable[[], None]) -> None:
    """Run on a daemon thread: a disk that hangs does not prevent the program from ending."""
    threading.Thread(target=work, name="pids.yml writer", daemon=True).start()


class GainsStore:
    """Writes pids.yml on its own thread: an SD card may take a second.

    Saves keep their order. A failed one fails with CommandRefusedError on the reactor's thread.
    """

    def __init__(self, file: PidsFile, reactor: Any) -> None:
        self._file = file
        self._reactor = reactor
        self._newest: GainSet | None = None
        self._lock = threading.Lock()

    def save(self, gains: GainSet) -> Deferred[None]:
        """Save a set; the result fires when it is on the disk."""
        done: Deferred[None] = Deferred()
        self._newest = gains
        _in_thread(lambda: self._write(done))
        return done

    def _write(self, done: Deferred[None]) -> None:
        with self._lock:
            gains = self._newest
            assert gains is not None
            try:
                self._file.save(gains)
            except (OSError, ValueError) as error:
                reason = getattr(error, "strerror", None) or str(error)
                text = f"the new gains fly, but pids.yml was not saved: {reason}"
                failure = CommandRefusedError(text, Code.FAILED, detail="gains_not_saved")
                self._reactor.callFromThread(done.errback, failure)
            else:
                self._reactor.callFromThread(done.callback, None)

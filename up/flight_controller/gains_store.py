"""Saves gains without blocking the flight on the disk."""

from typing import Any

from twisted.internet.defer import Deferred
from twisted.python.failure import Failure

from up.commands.gains import GainSet, navigation_of
from up.commands.pid_tunings_commands import PIDTuningsCommand
from up.commands.refusal import Code, CommandRefusedError
from up.flight_controller.pids_file import PidsFile
from up.system.disk_thread import DiskThread


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


class GainsStore:
    """Writes pids.yml beside the reactor.

    Saves keep their order. A failed one fails with CommandRefusedError on the reactor's thread.
    """

    def __init__(self, file: PidsFile, reactor: Any) -> None:
        self._file = file
        self._disk = DiskThread(reactor)
        self._newest: GainSet | None = None

    def save(self, gains: GainSet) -> Deferred[None]:
        """Save a set; the result fires when it is on the disk."""
        self._newest = gains
        return self._disk.run(self._write).addErrback(_refuse)

    def _write(self) -> None:
        assert self._newest is not None
        self._file.save(self._newest)


def _refuse(failure: Failure) -> None:
    failure.trap(OSError, ValueError)
    reason = getattr(failure.value, "strerror", None) or failure.getErrorMessage()
    text = f"the new gains fly, but pids.yml was not saved: {reason}"
    raise CommandRefusedError(text, Code.FAILED, detail="gains_not_saved")

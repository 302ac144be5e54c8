"""A module that works in regular intervals on the reactor's thread."""

from typing import Any, ClassVar

from twisted.internet.task import LoopingCall

from up.base_started_module import BaseStartedModule
from up.log.limits import Once


class BasePeriodicModule(BaseStartedModule):
    """Calls ``on_period`` every ``PERIOD_S`` seconds while it is started; a subclass overrides it.

    A fault is logged once of each kind, and the next call comes: what a module watches is watched
    as long as the program runs. A subclass that overrides ``on_start`` or ``on_stop`` calls it.
    """

    PERIOD_S: ClassVar[float] = 1.0

    def __init__(self, config: Any = None, silent: bool = False) -> None:
        super().__init__(config, silent)
        self._loop = LoopingCall(self._on_period)
        self._faults = Once()

    def on_start(self) -> Any:
        self._loop.clock = self.context.reactor
        self._loop.start(self.PERIOD_S, now=False)

    def on_stop(self) -> Any:
        if self._loop.running:
            self._loop.stop()

    def on_period(self) -> None:
        """Do the work of one period."""

    def on_fault(self) -> None:
        """React to a fault of ``on_period``, which is logged already."""

    def _on_period(self) -> None:
        try:
            self.on_period()
        except (Exception, SystemExit) as error:  # noqa: BLE001 - a fault must not end the watch
            if self._faults.first((type(error), str(error))):
                self.log.failure("a periodic check failed", code="period_failed")
            self.on_fault()

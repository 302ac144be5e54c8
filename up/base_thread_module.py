"""A module with its own thread, for blocking work (thesis 3.2.2)."""

import threading
from collections.abc import Callable
from typing import Any

from twisted.internet.defer import CancelledError
from twisted.internet.task import deferLater
from twisted.python.failure import Failure

from up.base_started_module import BaseStartedModule

# Shorter than the limit for all stops, so that the module can still close its resources.
STOP_LIMIT_S = 1.2
_POLL_S = 0.01
_PAUSE_AFTER_FAULT_S = 1.0


class BaseThreadModule(BaseStartedModule):
    """Runs ``_loop`` repeatedly on a daemon thread until the module stops.

    The thread reaches the reactor only by publishing Commands (the bus hands them over) or by
    ``call_in_reactor``. ``_loop`` must block only briefly and waits with
    ``self.stop_event.wait(seconds)``. An exception in it is logged, counted and followed by another
    call after a second; repeated equal faults are logged rarely, with their count. A thread that
    still runs 1.2 s after the stop does not keep the process alive.
    """

    def __init__(self, config: Any = None, silent: bool = False) -> None:
        super().__init__(config, silent)
        self.stop_event = threading.Event()
        self.faults = 0
        self._thread: threading.Thread | None = None

    async def start(self) -> Any:
        """Start the module, then its thread."""
        result = await super().start()
        if self._started:
            self.stop_event.clear()
            self._thread = threading.Thread(
                target=self._run, name=f"Thread-{self.class_name}", daemon=True
            )
            self._thread.start()
        return result

    async def stop(self) -> None:
        """Signal the thread to end, wait for it without blocking the reactor, then stop.

        A cancelled wait (the stop limit expired) is treated like a timeout.
        """
        self.stop_event.set()
        deadline_s = self.context.reactor.seconds() + STOP_LIMIT_S
        while self._is_thread_alive and self.context.reactor.seconds() < deadline_s:
            try:
                await deferLater(self.context.reactor, _POLL_S)
            except CancelledError:
                break
        if self._is_thread_alive:
            self.log.warn(
                "its thread did not end in time and is left behind", code="thread_left_behind"
            )
        await super().stop()

    def call_in_reactor(self, call: Callable[..., Any], *arguments: Any) -> None:
        self.context.reactor.callFromThread(call, *arguments)

    def _loop(self) -> None:
        raise NotImplementedError(f"{self.class_name} must override _loop")

    def _run(self) -> None:
        while not self.stop_event.is_set():
            try:
                self._loop()
            except (Exception, SystemExit):  # noqa: BLE001 - one fault must not end the thread
                self.faults += 1
                self.call_in_reactor(self._log_fault, Failure())
                self.stop_event.wait(_PAUSE_AFTER_FAULT_S)

    def _log_fault(self, fault: Failure) -> None:
        self.up.command_executor.limited.log(
            self.log.failure,
            "{name} failed in its thread",
            key=(self.path, repr(fault.type)),
            failure=fault,
            name=self.class_name,
        )

    @property
    def _is_thread_alive(self) -> bool:
        return self._thread is not None and self._thread.is_alive()

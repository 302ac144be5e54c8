"""A module that is started and stopped (thesis 3.2.2)."""

from __future__ import annotations

from collections.abc import Awaitable
from enum import Enum
from typing import Any, ClassVar

from up.base_module import BaseModule
from up.errors import UserError


class BaseStartedModule(BaseModule):
    """A module with ports, links or timers.

    Override ``on_start`` and ``on_stop``; both may be ``async def``. A start returns a
    StartResult, True (or nothing) for started, or False for failed; an exception also means failed.
    A failed start stops the boot if the class is ``REQUIRED``. An absent peer is not a failure.
    """

    REQUIRED: ClassVar[bool] = False
    DATA_SOURCE: ClassVar[bool] = False
    """Whether this module can deliver readings; the program needs at least one that can."""

    def __init__(self, config: Any = None, silent: bool = False) -> None:
        """Ignore the arguments, which the prototype's modules pass on."""
        self._started = False

    @property
    def started(self) -> bool:
        return self._started

    @property
    def is_source_open(self) -> bool:
        """Return whether the port of a DATA_SOURCE is open, so that readings can arrive."""
        return self._started

    @property
    def is_healthy(self) -> bool:
        """Return whether the module works; the watchdog is fed only while all modules do."""
        return True

    async def start(self) -> StartResult:
        """Enter the start phase; the framework calls this once."""
        outcome = self.on_start()
        if isinstance(outcome, Awaitable):
            outcome = await outcome
        result = self._result_of(outcome)
        self._started = result is StartResult.STARTED
        return result

    async def stop(self) -> None:
        """Enter the stop phase; the framework calls this once, also after a failed start."""
        self._started = False
        outcome = self.on_stop()
        if isinstance(outcome, Awaitable):
            await outcome

    def on_start(self) -> Any:
        """Open ports and connect links."""
        return True

    def on_stop(self) -> Any:
        """Close what the start opened, also after a partial start."""

    def _result_of(self, outcome: Any) -> StartResult:
        if isinstance(outcome, StartResult):
            return outcome
        if outcome is None or outcome is True:
            return StartResult.STARTED
        if outcome is False:
            return self.failure_result
        raise TypeError(f"{self.class_name}.on_start returned {outcome!r}")

    @property
    def failure_result(self) -> StartResult:
        """Return how a failed start of this class affects the boot."""
        return StartResult.FAILED_STOP if self.REQUIRED else StartResult.FAILED_GO_ON


class StartResult(Enum):
    """How the boot continues after a module's start."""

    STARTED = "started"
    FAILED_GO_ON = "failed, go on"
    FAILED_STOP = "failed, stop"


class StartFailedError(UserError):
    """Raised by a start that failed for a reason that a user can fix; the text is one sentence."""

"""Starts the modules, keeps them running, stops them in reverse (thesis 4.1.3)."""

from collections.abc import Coroutine
from typing import Any

from twisted.internet.defer import CancelledError, Deferred, TimeoutError
from twisted.logger import Logger, LogLevel
from twisted.python.failure import Failure

from up.base_module import BaseModule
from up.base_started_module import BaseStartedModule, StartResult
from up.errors import UserError
from up.system.clock import cancel
from up.up import Up

START_LIMIT_S = 10.0
STOP_LIMIT_S = 1.8
"""For all stops together; a little later the process is ended by force."""
ONE_STOP_LIMIT_S = 1.5
"""For one module that hangs; the modules after it share the rest of STOP_LIMIT_S."""
# sys.exit() in a module is a fault of that module; it must not end the program.
_FAULTS = (Exception, SystemExit)


class BootStoppedError(UserError):
    """The start ended in a state in which the system must not run; the text is one sentence."""


class LifeCycle:
    """Starts and stops the modules of an initialized Up, each guarded and bounded in time.

    Modules that need a failed one are not started either. A failure is an arming veto by name.
    """

    log = Logger()

    def __init__(self, up: Up) -> None:
        self._up = up
        self._reactor = up.context.reactor
        self.started: list[BaseStartedModule] = []
        self._sources = [
            module
            for module in up.modules
            if isinstance(module, BaseStartedModule) and module.DATA_SOURCE
        ]
        self._starting: Deferred[Any] | None = None
        self._unfinished: BaseStartedModule | None = None
        self._is_stopping = False

    async def start(self) -> None:
        """Start every module in order; raises BootStoppedError with the reason for the end.

        A stop during the start abandons the starting module and starts no other.
        """
        for module in list(self._up.modules):
            if self._is_stopping:
                return
            if not isinstance(module, BaseStartedModule):
                self._skip_if_need_failed(module)
                continue
            if self._skip_if_need_failed(module):
                continue
            result = await self._start_one(module)
            if result is StartResult.FAILED_STOP:
                raise BootStoppedError(
                    f"{module.class_name} did not start, and without it the system does not run",
                    code="required_module_failed",
                )
        if not self._is_stopping:
            self._check_sources()

    async def stop(self) -> None:
        """Stop the started modules in reverse; one that hangs or raises does not block the others.

        First closes what an abandoned start has opened. Takes STOP_LIMIT_S at most.
        """
        self._is_stopping = True
        unfinished = self._unfinished
        if self._starting is not None:
            self._starting.cancel()
        now_s = self._reactor.seconds()
        one_s, all_s = now_s + ONE_STOP_LIMIT_S, now_s + STOP_LIMIT_S
        if unfinished is not None and unfinished not in self.started:
            await self._close(unfinished, one_s - now_s)
        while self.started:
            now_s = self._reactor.seconds()
            limit_s = max(0.0, one_s - now_s, (all_s - now_s) / len(self.started))
            module = self.started.pop()
            if not module.started:
                continue
            try:
                await self._bounded(module.stop(), limit_s)
            except TimeoutError:
                self.log.error(
                    "{name} did not stop in time", name=module.class_name, code="stop_timeout"
                )
            except _FAULTS:
                self.log.failure(
                    "{name} failed to stop", name=module.class_name, code="stop_failed"
                )
            self._up.command_executor.control.release(module.class_name)
        self._up.command_executor.limited.stop()

    @property
    def is_healthy(self) -> bool:
        """Return whether every started module reports that it works."""
        for module in self.started:
            try:
                if module.started and not module.is_healthy:
                    return False
            except _FAULTS:
                return False
        return True

    async def _start_one(self, module: BaseStartedModule) -> StartResult:
        reason = ""
        self._unfinished = module
        try:
            with self._up.cleanup_of(module).recording():
                self._starting = self._bounded(module.start(), START_LIMIT_S)
            result: StartResult = await self._starting
        except CancelledError:
            if self._is_stopping:
                return StartResult.FAILED_GO_ON
            result, reason = module.failure_result, "CancelledError"
        except TimeoutError:
            result, reason = module.failure_result, f"not started within {START_LIMIT_S:.0f} s"
        except UserError as error:
            result, reason = module.failure_result, str(error)
        except _FAULTS as error:
            self.log.failure("{name} failed to start", name=module.path, code="start_failed")
            result, reason = module.failure_result, f"{type(error).__name__}: {error}"
        finally:
            self._starting = self._unfinished = None
        if result is StartResult.STARTED:
            self.started.append(module)
            if module.SHED_ORDER is None:
                self._up.cleanup_of(module).discard()
        else:
            self._note_failure(module, reason or "its start reports a failure")
            if not self._is_stopping:
                await self._close(module, ONE_STOP_LIMIT_S)
        return result

    async def _close(self, module: BaseStartedModule, limit_s: float) -> None:
        """Stop a module that is not started: its start may have opened resources."""
        try:
            await self._bounded(module.stop(), limit_s)
        except TimeoutError:
            self.log.debug("{name} did not close in time", name=module.class_name)
        except _FAULTS:
            self.log.failure("{name} failed to close", name=module.class_name, level=LogLevel.debug)

    def _skip_if_need_failed(self, module: BaseModule) -> bool:
        missing = self._up.missing_need(module)
        if missing is None:
            return False
        self._note_failure(module, f"needs {missing.class_name}, which did not start")
        return True

    def _note_failure(self, module: BaseModule, reason: str) -> None:
        self._up.exclude(module, f"did not start: {reason}")

    def _check_sources(self) -> None:
        if self._sources and not any(
            module in self.started and module.is_source_open for module in self._sources
        ):
            names = [module.class_name for module in self._sources]
            which = (
                f"neither {' nor '.join(names)} has" if names[1:] else f"not even {names[0]} has"
            )
            raise BootStoppedError(
                f"{which} its port open: no data could come, so there is nothing to run",
                code="no_source",
            )

    def _bounded(self, work: Coroutine[Any, Any, Any], limit_s: float) -> Deferred[Any]:
        """Return the outcome of the work; after the limit a TimeoutError, whatever it does."""
        task: Deferred[Any] = Deferred.fromCoroutine(work)
        outcome: Deferred[Any] = Deferred(lambda _: task.cancel())

        def settle(result: Any) -> None:
            cancel(limit)
            if not outcome.called:
                outcome.callback(result)

        def give_up() -> None:
            if not outcome.called:
                outcome.errback(Failure(TimeoutError()))
            task.cancel()

        limit = self._reactor.callLater(limit_s, give_up)
        task.addBoth(settle)
        return outcome

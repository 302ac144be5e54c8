"""The bus: delivers every Command to its subscribers (thesis 4.1.4)."""

from __future__ import annotations

import threading
from collections import Counter, deque
from collections.abc import Callable, Coroutine
from dataclasses import dataclass
from functools import update_wrapper
from inspect import iscoroutinefunction
from time import monotonic, perf_counter
from typing import Any
from uuid import UUID, uuid4

from twisted.internet.defer import Deferred
from twisted.logger import Logger
from twisted.python.failure import Failure

from up.cleanup import add_cleanup
from up.commands.base_command_handler import BaseCommandHandler
from up.commands.command import BaseCommand
from up.commands.command_registry import CommandRegistry
from up.commands.control_lease import ControlLease, calling_publisher
from up.commands.origin import INTERNAL, Origin
from up.commands.refusal import CommandRefusedError, UnhandledCommandError
from up.commands.roles import Role
from up.log.limits import Limited

Handler = Callable[[Any], Any]
Observe = Callable[[BaseCommand, Origin], object]
_LOGGED_NAMES_LIMIT = 100
# sys.exit() in a handler is a fault of that handler; it must not end the program.
_FAULTS = (Exception, SystemExit)


class CommandExecutor:
    """Publishes Commands to handlers in order; a fault in one handler does not affect the others.

    Publishing is safe from any thread: on the reactor thread the handlers run immediately, from any
    other thread the Command is handed to the reactor. A publish from inside a handler waits until
    the handlers of the current Command are done. ``dispatching_since`` (perf_counter seconds, 0:
    idle) and ``dispatching`` show a monitor thread which handler blocks the event loop; the bus can
    afford only one clock reading per Command (``up.system.reactor_monitor`` does the rest). An
    observer sees every Command, but does not count as a handler. A Command with ``NEEDS_CONTROL``
    is delivered only for the publisher that has control: its origin's link, or the calling module.
    """

    log = Logger()

    __slots__ = (
        "_call_from_thread",
        "_called",
        "_faults",
        "_handlers",
        "_logged_names",
        "_observers",
        "_observing",
        "_subscribers",
        "_thread",
        "_waiting",
        "control",
        "counters",
        "dispatching",
        "dispatching_since",
        "limited",
        "on_handler_failed",
        "origin",
        "registry",
    )

    def __init__(
        self,
        registry: CommandRegistry,
        call_from_thread: Callable[..., Any],
        limited: Limited,
        seconds: Callable[[], float] = monotonic,
    ) -> None:
        self.registry = registry
        self.limited = limited
        self.control = ControlLease(seconds)
        self.origin: Origin = INTERNAL
        self.dispatching_since = 0.0
        self.dispatching: BaseCommand | None = None
        self.counters: Counter[str] = Counter()
        self.on_handler_failed: Callable[[str], None] = _ignore
        self._call_from_thread = call_from_thread
        self._thread = threading.get_ident()
        self._subscribers: dict[str, tuple[tuple[UUID, Handler], ...]] = {}
        self._handlers: dict[str, tuple[Handler, ...]] = {}
        self._observers: tuple[tuple[UUID, Handler], ...] = ()
        self._observing: tuple[Handler, ...] = ()
        # Cached handlers by Command; one that needs control is absent and takes the slow path.
        self._called: dict[str, tuple[Handler, ...]] = {}
        self._waiting: deque[tuple[BaseCommand | _Asked, Origin]] = deque()
        self._logged_names: set[str] = set()
        self._faults: Counter[tuple[str, str]] = Counter()

    def adopt_thread(self) -> None:
        """Make the calling thread the reactor thread; the program calls this before it runs."""
        self._thread = threading.get_ident()

    def register_command(
        self, command: type[BaseCommand] | str, handler: BaseCommandHandler | Handler
    ) -> UUID:
        """Subscribe ``handler`` to a Command, by class or by name; return the handle.

        Raises TypeError when the handler is neither a BaseCommandHandler nor callable.
        """
        name = self._name_of(command)
        if isinstance(handler, BaseCommandHandler):
            call: Handler = handler.run_action
        elif callable(handler):
            call = handler
        else:
            raise TypeError(f"{handler!r} cannot handle {name}: it is not callable")
        handle = uuid4()
        self._subscribers[name] = (*self._subscribers.get(name, ()), (handle, call))
        self._rebuild(name)
        add_cleanup(lambda: self._unsubscribe(name, handle))
        return handle

    def unregister_command(self, command: type[BaseCommand] | str, handle: UUID) -> None:
        """Remove a subscription; raises KeyError if the handle is not one of this Command's."""
        name = self._name_of(command)
        if not self._unsubscribe(name, handle):
            raise KeyError(f"no handler {handle} for {name}")

    def add_observer(self, call: Observe) -> UUID:
        """Call ``call(command, origin)`` with every Command before its handlers; return the handle.

        It also receives Commands without a handler; a Command that only observers receive stays
        unhandled. An observer must return immediately; its return value is ignored, so it can
        neither delay nor refuse a Command. Its exceptions are logged and counted like a handler's.
        Raises TypeError when it is not callable, or ``async def``.
        """
        if not callable(call) or iscoroutinefunction(call):
            raise TypeError(f"{call!r} cannot observe: it is no plain callable")
        handle = uuid4()
        self._observers = (*self._observers, (handle, self._handing_origin(call)))
        self._rebuild_called()
        add_cleanup(lambda: self._drop_observer(handle))
        return handle

    def remove_observer(self, handle: UUID) -> None:
        """Remove an observer; raises KeyError for an unknown handle."""
        if not self._drop_observer(handle):
            raise KeyError(f"no observer {handle}")

    def has_handlers(self, command: type[BaseCommand] | str) -> bool:
        """Return whether a Command has a subscriber."""
        return bool(self._handlers.get(self._name_of(command)))

    def handlers_of(self, command: type[BaseCommand] | str) -> tuple[Handler, ...]:
        """Return the subscribers of a Command in order, without observers."""
        return self._handlers.get(self._name_of(command), ())

    def execute_command(
        self,
        command: BaseCommand,
        origin: Origin = INTERNAL,
        _get_ident: Callable[[], int] = threading.get_ident,
        _now: Callable[[], float] = perf_counter,
    ) -> None:
        """Publish a Command; a handler's exception does not reach the caller."""
        if self.dispatching_since or _get_ident() != self._thread:
            self._postpone(command, origin)
            return
        handlers: tuple[Handler, ...]
        try:
            handlers = self._called[command.NAME]
        except KeyError:
            handlers = self._observing
            if command.NEEDS_CONTROL and command.NAME in self._handlers:
                if origin is INTERNAL:
                    origin = Origin(calling_publisher(), Role.INTERNAL)
                if self.control.refuses(origin.link, command.NAME) is not None:
                    return
                handlers += self._handlers[command.NAME]
            # A module may publish without subscribers; an unhandled Command from outside is an
            # error.
            elif origin is not INTERNAL or self.registry.get(command.NAME) is None:
                self._count_unhandled(command.NAME)
            if not handlers:
                return
        self.origin = origin
        self.dispatching = command
        self.dispatching_since = _now()
        try:
            for handler in handlers:
                try:
                    result = handler(command)
                    if result is not None:
                        later = _later(result)
                        if later is not None:
                            later.addErrback(self._failed, handler, command)
                except _FAULTS:
                    self._failed(Failure(), handler, command)
        finally:
            # Reset after any exception: a bus that is marked busy never delivers again.
            self.dispatching_since = 0.0
        if self._waiting:
            self._drain()

    publish = execute_command

    def execute_and_wait(self, command: BaseCommand, origin: Origin) -> Deferred[None]:
        """Publish a Command from the reactor thread; the result is its outcome.

        Fires with None when every handler succeeded, fails with the first handler's exception. A
        Command without a handler fails with UnhandledCommandError. When called inside a handler,
        the Command waits its turn like any other.
        """
        done: Deferred[None] = Deferred()
        if command.NEEDS_CONTROL and origin is INTERNAL:
            origin = Origin(calling_publisher(), Role.INTERNAL)
        if self.dispatching_since:
            self._waiting.append((_Asked(command, done), origin))
        else:
            self._execute_asked(command, done, origin)
        return done

    def _execute_asked(self, command: BaseCommand, done: Deferred[None], origin: Origin) -> None:
        handlers = self._handlers.get(command.NAME, ())
        refusal = command.NEEDS_CONTROL and self.control.refuses(origin.link, command.NAME)
        if refusal:
            done.errback(CommandRefusedError(refusal))
            return
        faults: list[Failure] = []
        waiting: list[Deferred[Any]] = []
        if not handlers:
            self._count_unhandled(command.NAME)
            faults.append(Failure(UnhandledCommandError(command.NAME)))
        self.origin = origin
        self.dispatching = command
        self.dispatching_since = perf_counter()
        try:
            for observer in self._observing:
                try:
                    observer(command)
                except _FAULTS:
                    self._failed(Failure(), observer, command)
            for handler in handlers:
                try:
                    result = handler(command)
                    if result is not None:
                        later = _later(result)
                        if later is not None:
                            later.addErrback(self._failed_later, handler, command)
                            waiting.append(later)
                except _FAULTS:
                    faults.append(Failure())
                    self._failed(faults[-1], handler, command)
        finally:
            self.dispatching_since = 0.0
        _join(waiting, faults, done)
        if self._waiting:
            self._drain()

    def _postpone(self, command: BaseCommand, origin: Origin) -> None:
        if command.NEEDS_CONTROL and origin is INTERNAL:
            origin = Origin(calling_publisher(), Role.INTERNAL)
        if threading.get_ident() == self._thread:
            self._waiting.append((command, origin))
        else:
            self._call_from_thread(self.execute_command, command, origin)

    def _drain(self) -> None:
        waiting = self._waiting
        while waiting and not self.dispatching_since:
            command, origin = waiting.popleft()
            if isinstance(command, _Asked):
                self._execute_asked(command.command, command.done, origin)
            else:
                self.execute_command(command, origin)

    def _name_of(self, command: type[BaseCommand] | str) -> str:
        if isinstance(command, str):
            return self.registry.primary_name(command)
        self.registry.add(command)
        return command.NAME

    def _unsubscribe(self, name: str, handle: UUID) -> bool:
        now = self._subscribers.get(name, ())
        left = tuple(each for each in now if each[0] != handle)
        if len(left) == len(now):
            return False
        self._subscribers[name] = left
        self._rebuild(name)
        return True

    def _rebuild(self, name: str) -> None:
        handlers = tuple(call for _, call in self._subscribers[name])
        if handlers:
            self._handlers[name] = handlers
        else:
            self._handlers.pop(name, None)
        self._rebuild_called()

    def _drop_observer(self, handle: UUID) -> bool:
        left = tuple(each for each in self._observers if each[0] != handle)
        if len(left) == len(self._observers):
            return False
        self._observers = left
        self._rebuild_called()
        return True

    def _rebuild_called(self) -> None:
        observing = self._observing = tuple(call for _, call in self._observers)
        self._called = {
            name: (*observing, *handlers)
            for name, handlers in self._handlers.items()
            if not getattr(self.registry.get(name), "NEEDS_CONTROL", False)
        }

    def _handing_origin(self, call: Observe) -> Handler:
        def observe(command: BaseCommand) -> None:
            call(command, self.origin)

        return update_wrapper(observe, call)

    def _count_unhandled(self, name: str) -> None:
        self.counters["unhandled"] += 1
        if name not in self._logged_names and len(self._logged_names) < _LOGGED_NAMES_LIMIT:
            self._logged_names.add(name)
            self.log.debug("nobody handles {name}", name=name)

    def _failed(self, failure: Failure, handler: Handler, command: BaseCommand) -> None:
        owner = owner_of(handler)
        error = failure.value
        if isinstance(error, CommandRefusedError) and handler not in self._observing:
            self.counters["refused"] += 1
            self.limited.log(
                self.log.info,
                "{owner} refused {name}: {reason}",
                key=(owner, command.NAME, error.code),
                owner=owner,
                name=command.NAME,
                reason=error.reason,
                code="command_refused",
                refusal=error.code.value,
            )
            return
        self.counters["failed_handlers"] += 1
        self._faults[owner, command.NAME] += 1
        count = self._faults[owner, command.NAME]
        if str(count).strip("0") == "1":
            # A handler of a frequent Command fails often: log the first, tenth, hundredth...
            self.log.failure(
                "{owner} failed while handling {name} ({count} times now)",
                failure,
                owner=owner,
                name=command.NAME,
                count=count,
            )
        self.on_handler_failed(owner)

    def _failed_later(self, failure: Failure, handler: Handler, command: BaseCommand) -> Failure:
        self._failed(failure, handler, command)
        return failure


@dataclass(frozen=True, slots=True)
class _Asked:
    """A queued Command whose caller waits for the outcome."""

    command: BaseCommand
    done: Deferred[None]


def _ignore(owner: str) -> None:
    """Ignore a failed handler; the bus itself logs and counts it."""


def owner_of(handler: Callable[..., Any]) -> str:
    """Return the display name of the class or function that contains a handler."""
    # An observer is wrapped to receive the origin.
    handler = getattr(handler, "__wrapped__", handler)
    owner = getattr(handler, "__self__", None)
    if owner is not None:
        return type(owner).__name__
    return getattr(handler, "__qualname__", None) or type(handler).__name__


def _later(result: Any) -> Deferred[Any] | None:
    """Return the Deferred of a handler that is not done yet; None if it is done."""
    if isinstance(result, Coroutine):
        return Deferred.fromCoroutine(result)
    return result if isinstance(result, Deferred) else None


def _join(waiting: list[Deferred[Any]], faults: list[Failure], done: Deferred[None]) -> None:
    left = len(waiting)

    def finish() -> None:
        if faults:
            done.errback(faults[0])
        else:
            done.callback(None)

    def settled(result: Any) -> None:
        nonlocal left
        left -= 1
        if isinstance(result, Failure):
            faults.append(result)
        if left == 0:
            finish()

    if not waiting:
        finish()
    for each in waiting:
        each.addBoth(settled)

"""The bus: delivers every Command to its subscribers (thesis 4.1.4)."""

import threading
from collections import Counter, deque
from collections.abc import Callable, Coroutine
from functools import update_wrapper
from inspect import iscoroutinefunction
from time import monotonic
from typing import Any
from uuid import UUID, uuid4

from twisted.internet.defer import Deferred, DeferredList, fail
from twisted.logger import Logger
from twisted.python.failure import Failure

from up.cleanup import add_cleanup
from up.commands.base_command_handler import BaseCommandHandler
from up.commands.command import BaseCommand
from up.commands.command_registry import CommandRegistry
from up.commands.origin import INTERNAL, Origin
from up.commands.publisher_control import PublisherControl, calling_publisher
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
    the handlers of the current Command are done. An observer sees every Command, but does not count
    as a handler. A Command with ``NEEDS_CONTROL`` is delivered only for the publisher that has
    control: its origin's link, or the calling module.
    """

    log = Logger()

    __slots__ = (
        "_call_from_thread",
        "_called",
        "_controlled",
        "_faults",
        "_handlers",
        "_is_dispatching",
        "_is_draining",
        "_logged_names",
        "_observing",
        "_subscribers",
        "_thread",
        "_waiting",
        "control",
        "counters",
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
        self.control = PublisherControl(seconds)
        self.origin: Origin = INTERNAL
        self.counters: Counter[str] = Counter()
        self.on_handler_failed: Callable[[str], None] = _ignore
        self._call_from_thread = call_from_thread
        self._thread = threading.get_ident()
        self._subscribers: dict[str, tuple[tuple[UUID, Handler], ...]] = {}
        self._handlers: dict[str, tuple[Handler, ...]] = {}
        self._observing: tuple[Handler, ...] = ()
        # Observers and handlers by Command, apart for those that need control.
        self._called: dict[str, tuple[Handler, ...]] = {}
        self._controlled: dict[str, tuple[Handler, ...]] = {}
        self._is_dispatching = False
        self._is_draining = False
        self._waiting: deque[tuple[BaseCommand, Origin, Deferred[None] | None]] = deque()
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

    def add_observer(self, call: Observe) -> None:
        """Call ``call(command, origin)`` with every Command before its handlers.

        It also receives Commands without a handler; a Command that only observers receive stays
        unhandled. An observer must return immediately; its return value is ignored, so it can
        neither delay nor refuse a Command. Its exceptions are logged and counted like a handler's.
        Raises TypeError when it is not callable, or ``async def``.
        """
        if not callable(call) or iscoroutinefunction(call):
            raise TypeError(f"{call!r} cannot observe: it is not a plain callable")

        def observe(command: BaseCommand) -> None:
            call(command, self.origin)

        observer = update_wrapper(observe, call)
        self._observing = (*self._observing, observer)
        self._rebuild_called()
        add_cleanup(lambda: self._drop_observer(observer))

    def handlers_of(self, command: type[BaseCommand] | str) -> tuple[Handler, ...]:
        """Return the subscribers of a Command in order, without observers."""
        return self._handlers.get(self._name_of(command), ())

    def execute_command(
        self,
        command: BaseCommand,
        origin: Origin = INTERNAL,
        _handlers: tuple[Handler, ...] | None = None,
        _outcomes: list[Deferred[Any]] | None = None,
        _get_ident: Callable[[], int] = threading.get_ident,
    ) -> None:
        """Publish a Command; a handler's exception does not reach the caller."""
        # ``execute_and_wait`` gives the handlers, and the list for their failures and later
        # results: the only loop over handlers is here, because a call of it costs 30 ns.
        if (self._is_dispatching or _get_ident() != self._thread) and _outcomes is None:
            self._postpone(command, origin)
            return
        handlers = _handlers
        if handlers is None:
            try:
                handlers = self._called[command.NAME]
            except KeyError:
                if command.NAME in self._controlled:
                    self._execute_controlled(command, _publisher(command, origin))
                    return
                # A module may publish without subscribers; an unhandled Command from outside is
                # an error.
                if origin is not INTERNAL or self.registry.get(command.NAME) is None:
                    self._count_unhandled(command.NAME)
                handlers = self._observing
                if not handlers:
                    return
        self.origin = origin
        self._is_dispatching = True
        try:
            for handler in handlers:
                try:
                    result = handler(command)
                    if result is not None:
                        later = _later(result)
                        if later is not None:
                            later.addErrback(self._failed, handler, command, _outcomes)
                            if _outcomes is not None:
                                _outcomes.append(later)
                except _FAULTS:
                    failure = self._failed(Failure(), handler, command, _outcomes)
                    if failure is not None and _outcomes is not None:
                        _outcomes.append(fail(failure))
        finally:
            # Reset after any exception: a bus that is marked busy never delivers again.
            self._is_dispatching = False
        if self._waiting and not self._is_draining:
            self._drain()

    publish = execute_command

    def execute_and_wait(self, command: BaseCommand, origin: Origin) -> Deferred[None]:
        """Publish a Command from the reactor thread; the result is its outcome.

        Fires with None when every handler succeeded, fails with the first handler's exception. A
        Command without a handler fails with UnhandledCommandError. When called inside a handler,
        the Command waits its turn like any other.
        """
        done: Deferred[None] = Deferred()
        origin = _publisher(command, origin)
        if self._is_dispatching:
            self._waiting.append((command, origin, done))
        else:
            self._execute_awaited(command, origin, done)
        return done

    def _execute_awaited(self, command: BaseCommand, origin: Origin, done: Deferred[None]) -> None:
        refusal = command.NEEDS_CONTROL and self.control.refuses(origin.link, command.NAME)
        if refusal:
            done.errback(CommandRefusedError(refusal))
            return
        handlers = self._handlers.get(command.NAME, ())
        outcomes: list[Deferred[Any]] = []
        if not handlers:
            self._count_unhandled(command.NAME)
            outcomes.append(fail(UnhandledCommandError(command.NAME)))
        self.execute_command(command, origin, (*self._observing, *handlers), outcomes)
        DeferredList(outcomes, consumeErrors=True).addCallback(_settle, done)

    def _postpone(self, command: BaseCommand, origin: Origin) -> None:
        if origin is INTERNAL:
            origin = _publisher(command, origin)
        if threading.get_ident() == self._thread:
            self._waiting.append((command, origin, None))
        else:
            self._call_from_thread(self.execute_command, command, origin)

    def _drain(self) -> None:
        # One loop for all that wait: draining from within it would end in a RecursionError.
        waiting = self._waiting
        self._is_draining = True
        try:
            while waiting and not self._is_dispatching:
                command, origin, done = waiting.popleft()
                if done is not None:
                    self._execute_awaited(command, origin, done)
                elif command.NAME in self._controlled:
                    self._execute_controlled(command, origin)
                else:
                    self.execute_command(command, origin)
        finally:
            self._is_draining = False

    def _execute_controlled(self, command: BaseCommand, origin: Origin) -> None:
        if self.control.refuses(origin.link, command.NAME) is None:
            self.execute_command(command, origin, self._controlled[command.NAME])

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

    def _drop_observer(self, observer: Handler) -> None:
        self._observing = tuple(each for each in self._observing if each is not observer)
        self._rebuild_called()

    def _rebuild_called(self) -> None:
        self._called, self._controlled = {}, {}
        for name, handlers in self._handlers.items():
            needs_control = getattr(self.registry.get(name), "NEEDS_CONTROL", False)
            table = self._controlled if needs_control else self._called
            table[name] = (*self._observing, *handlers)

    def _count_unhandled(self, name: str) -> None:
        self.counters["unhandled"] += 1
        if name not in self._logged_names and len(self._logged_names) < _LOGGED_NAMES_LIMIT:
            self._logged_names.add(name)
            self.log.debug("no module handles {name}", name=name, code="command_unhandled")

    def _failed(
        self,
        failure: Failure,
        handler: Handler,
        command: BaseCommand,
        outcomes: list[Deferred[Any]] | None,
    ) -> Failure | None:
        """Log and count a failure; return it if the publisher waits for this handler's outcome."""
        owner = owner_of(handler)
        error = failure.value
        is_observer = handler in self._observing
        awaited = None if outcomes is None or is_observer else failure
        if isinstance(error, CommandRefusedError) and not is_observer:
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
            return awaited
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
                code="handler_failed",
            )
        self.on_handler_failed(owner)
        return awaited


def _ignore(owner: str) -> None:
    """Ignore a failed handler; the bus itself logs and counts it."""


def _publisher(command: BaseCommand, origin: Origin) -> Origin:
    """Return the origin with which a Command that needs control is published."""
    if command.NEEDS_CONTROL and origin is INTERNAL:
        return Origin(calling_publisher(), Role.INTERNAL)
    return origin


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


def _settle(results: list[tuple[bool, Any]], done: Deferred[None]) -> None:
    failures = [result for is_success, result in results if not is_success]
    if failures:
        done.errback(failures[0])
    else:
        done.callback(None)

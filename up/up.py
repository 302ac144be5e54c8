"""The assembled system: modules, bus, and their shared services (thesis 3.2.1)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeVar, cast

from twisted.logger import Logger

from up.base_module import BaseModule
from up.cleanup import CleanupStack, add_cleanup
from up.commands.base_command_handler import BaseCommandHandler
from up.commands.beacon import Beacons
from up.commands.builtin import BUILTIN_COMMANDS
from up.commands.command_executor import CommandExecutor
from up.commands.command_link import CommandLink
from up.commands.command_receiver import CommandReceiver
from up.commands.command_registry import CommandRegistry
from up.context import Context
from up.log.limits import Limited
from up.needs import discard_wanted, needed_by
from up.vetoes import Vetoes

if TYPE_CHECKING:
    from up.loading.plan import Plan

LOG_INTERVAL_S = 30.0
"""A refused Command or a thread's fault is logged immediately, then as a count per interval."""

_M = TypeVar("_M")


class Up:
    """The services that modules use: each other, the bus, the receiver, the vetoes.

    Built by UpLoader; ``initialize`` takes the modules through the initialization phase, and
    LifeCycle starts and stops them.
    """

    log = Logger()

    def __init__(self, plan: Plan, context: Context) -> None:
        self.context = context
        self.vetoes = Vetoes()
        self.beacons = Beacons(context.reactor, context.random)
        registry = CommandRegistry((*BUILTIN_COMMANDS, *plan.commands))
        self.command_executor = CommandExecutor(
            registry,
            context.reactor.callFromThread,
            Limited(context.reactor, LOG_INTERVAL_S),
            context.reactor.seconds,
        )
        self.command_receiver = CommandReceiver(
            self.command_executor, self.beacons, context.reactor
        )
        self.ports: dict[str, int] = {}
        self._counted: dict[str, Mapping[str, int]] = {}
        self.on_ports_changed: Callable[[], object] = lambda: None
        self._modules = list(plan.modules)
        self._cleanups = {id(module): CleanupStack() for module in self._modules}
        self._excluded: list[BaseModule] = []
        self._handlers: Sequence[BaseCommandHandler] = plan.handlers
        self.started_at_s = context.reactor.seconds()
        for problem in plan.problems:
            self.log.error(
                "{problem}",
                problem=str(problem),
                code="load_problem",
                reason=problem.code,
                **problem.fields,
            )
            self.vetoes.set(problem.name, problem.what)

    @property
    def modules(self) -> Sequence[BaseModule]:
        return self._modules

    def get_module(self, cls: type[_M]) -> _M | None:
        """Return the first module that is an instance of a class, or None."""
        return next((cast(_M, each) for each in self._modules if isinstance(each, cls)), None)

    def get_modules(self, cls: type[_M]) -> list[_M]:
        return [cast(_M, each) for each in self._modules if isinstance(each, cls)]

    @property
    def telemetry_controller(self) -> Any:
        from up.telemetry_controller import TelemetryController

        return self.get_module(TelemetryController)

    @property
    def mission_control_provider(self) -> Any:
        """Return the connection with the ground, or None."""
        from up.providers.base_mission_control_provider import BaseMissionControlProvider

        return self.get_module(BaseMissionControlProvider)

    @property
    def rx_provider(self) -> Any:
        from up.providers.base_rx_provider import BaseRXProvider

        return self.get_module(BaseRXProvider)

    @property
    def flight_control(self) -> Any:
        """Return the flight controller on this machine, or None."""
        from up.flight_controller.base_flight_controller import BaseFlightController

        return self.get_module(BaseFlightController)

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        executor = self.command_executor
        now_s = self.context.reactor.seconds()
        return {
            "vetoes": self.vetoes.all,
            "control": {"publisher": executor.control.owner},
            "system": {
                "uptime_s": round(now_s - self.started_at_s),
                "clock_ms": round(now_s * 1000),
            },
            "counters": {
                "bus": dict(executor.counters),
                "control": dict(executor.control.refused),
                "receiver": dict(self.command_receiver.counters),
                **{part: dict(counters) for part, counters in self._counted.items()},
            },
        }

    def advertise_port(self, name: str, port: int) -> None:
        """Set the port that a module bound; it is logged and reported to the supervisor."""
        self.ports[name] = port
        add_cleanup(lambda: self._withdraw_port(name, port))
        self.log.info("{name} listens on port {port}", name=name, port=port, code="port_open")
        self.on_ports_changed()

    def count(self, part: str, counters: Mapping[str, int]) -> None:
        """Show the counters of a part of the program in telemetry, ``counters.<part>.<name>``."""
        self._counted[part] = counters

    def counters_of(self, part: str) -> Mapping[str, int]:
        """Return the counters of a part of the program; empty if it has none."""
        return self._counted.get(part, {})

    def open_link(self, name: str, role: Any, send: Any, **more: Any) -> CommandLink:
        """Return the Command Receiver's view of a link that a module opens."""
        return CommandLink(name, role, send, self.context.reactor, **more)

    def initialize(self) -> None:
        """Run the initialization phase of every module, then of every handler.

        A module that raises is removed, with those that need it; it becomes an arming veto by name.
        """
        for module in list(self._modules):
            missing = self.missing_need(module)
            if missing is not None:
                self.exclude(module, f"needs {missing.class_name}, which failed")
                continue
            try:
                with self.cleanup_of(module).recording():
                    module.initialize(self)
            except (Exception, SystemExit) as error:  # noqa: BLE001 - a fault costs one module
                self.log.failure(
                    "{name} failed to initialize", name=module.path, code="initialize_failed"
                )
                self.exclude(module, f"failed to initialize: {type(error).__name__}: {error}")
        for handler in self._handlers:
            self._register(handler)

    def cleanup_of(self, module: BaseModule) -> CleanupStack:
        return self._cleanups[id(module)]

    def missing_need(self, module: BaseModule) -> BaseModule | None:
        """Return an excluded module that this one needs, or None."""
        return next((each for each in needed_by(module) if each in self._excluded), None)

    def exclude(self, module: BaseModule, reason: str) -> None:
        """Remove a failed module from the system; it is an arming veto by name.

        Removes its subscriptions, routes, ports and telemetry, and sets other modules' ``wants`` of
        it to None. The caller must exclude the modules that need it.
        """
        self._excluded.append(module)
        self.cleanup_of(module).unwind()
        self.command_executor.control.release(module.class_name)
        self._modules = [each for each in self._modules if each is not module]
        for each in self._modules:
            discard_wanted(each, self._excluded)
        self.log.error(
            "{name} is left out: {reason}", name=module.path, reason=reason, code="module_excluded"
        )
        self.vetoes.set(module.path, reason)

    def _register(self, handler: BaseCommandHandler) -> None:
        try:
            self.command_executor.register_command(handler.COMMAND, handler)
        except (ValueError, TypeError, NameError) as error:
            name = type(handler).__name__
            self.log.error(
                "{name} cannot be registered: {error}",
                name=name,
                error=error,
                code="handler_invalid",
            )
            self.vetoes.set(name, f"cannot be registered: {error}")

    def _withdraw_port(self, name: str, port: int) -> None:
        if self.ports.get(name) == port:
            del self.ports[name]
            self.on_ports_changed()

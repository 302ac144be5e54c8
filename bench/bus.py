"""The bus beside a dict of lists, pluggy and blinker: one publish, handlers that do nothing.

Only ours isolates a handler's fault and notes the origin.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from importlib import import_module
from typing import Any, ClassVar

from twisted.internet.task import Clock

from bench.table import Row, compared
from bench.timing import Limit, Work, rounds_ns
from up.commands.command import BaseCommand, value
from up.commands.command_executor import CommandExecutor
from up.commands.command_registry import CommandRegistry
from up.commands.origin import Origin
from up.commands.roles import Role
from up.log.limits import Limited

TARGETS = {1: 2.0, 10: 1.4, 100: 1.1}


@dataclass(frozen=True, slots=True)
class BenchCommand(BaseCommand):
    """Carries one number."""

    NAME: ClassVar[str] = "bench.tick"
    number: int = value(0)


class Subscriber:
    """Ignores its Commands, in a method, as modules have them."""

    def on_command(self, command: BenchCommand) -> None:
        """Receive a Command."""


def ours(count: int) -> Work:
    limited = Limited(Clock(), 10)
    bus = CommandExecutor(CommandRegistry(()), lambda call, *rest: call(*rest), limited)
    for _ in range(count):
        bus.register_command(BenchCommand, Subscriber().on_command)
    publish, command, origin = bus.execute_command, BenchCommand(1), Origin("bench", Role.BOARD)
    return lambda: publish(command, origin)


def dict_of_lists(count: int) -> Work:
    """Return the simplest possible bus: no isolation, no origin."""
    handlers = {BenchCommand.NAME: [Subscriber().on_command for _ in range(count)]}
    command = BenchCommand(1)

    def publish(command: BenchCommand) -> None:
        for handler in handlers[command.NAME]:
            handler(command)

    return lambda: publish(command)


def pluggy(count: int) -> Work | None:
    try:
        library = import_module("pluggy")
    except ImportError:
        return None
    spec: Any
    implementation: Any
    spec, implementation = library.HookspecMarker("bench"), library.HookimplMarker("bench")

    class Specification:
        @spec
        def on_command(self, command: BenchCommand) -> None:
            """Receive a Command."""

    class Plugin:
        @implementation
        def on_command(self, command: BenchCommand) -> None:
            """Receive a Command."""

    manager = library.PluginManager("bench")
    manager.add_hookspecs(Specification)
    for _ in range(count):
        manager.register(Plugin())
    hook, command = manager.hook.on_command, BenchCommand(1)
    return lambda: hook(command=command)


def blinker(count: int) -> Work | None:
    try:
        library = import_module("blinker")
    except ImportError:
        return None
    signal, command = library.Signal(), BenchCommand(1)
    subscribers = [Subscriber() for _ in range(count)]
    for each in subscribers:
        signal.connect(each.on_command)

    def send(_keep: object = subscribers) -> None:  # a signal holds its receivers weakly
        signal.send(command)

    return send


def rows(quick: bool = False) -> Iterable[Row]:
    makers: dict[str, Callable[[int], Work | None]] = {"pluggy": pluggy, "blinker": blinker}
    for count, target in TARGETS.items():
        what = f"publish to {count} subscriber{'s' * (count > 1)}"
        works = {"ours": ours(count), "dict of lists": dict_of_lists(count)}
        for name, make in makers.items():
            peer = make(count)
            if peer is not None:
                works[name] = peer
        rounds, calls = (5, 200) if quick else (20, max(500, 20_000 // count))
        times = dict(zip(works, rounds_ns(list(works.values()), rounds, calls), strict=True))
        for name in ("dict of lists", *makers):
            limit = Limit(target) if name == "dict of lists" else None
            yield compared(what, "ns", times["ours"], name, times.get(name, ()), limit)

"""How long a publish takes on the bus, beside a dict of lists, pluggy and blinker.

All figures are CPU time of this process for one publish, the best of several rounds in which ours
and the peers take turns. Only the bus isolates handlers, knows the origin and times the dispatch.
"""

import importlib.util
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from importlib import import_module
from typing import Any, ClassVar

from bench.codecs import cpu_us
from bench.table import Row, print_table
from up.commands.command import BaseCommand, value
from up.commands.command_executor import CommandExecutor
from up.commands.command_registry import CommandRegistry

TARGETS = {1: 2.6, 10: 1.6, 100: 1.3}
HANDLER_CALLS = 20_000

Work = Callable[[], int]


@dataclass(frozen=True, slots=True)
class SampleCommand(BaseCommand):
    """A Command of usual size."""

    NAME: ClassVar[str] = "bench.sample"
    number: int = value(0)


def handler(command: object) -> None:
    """Do nothing with a Command."""


def bus_work(subscribers: int, publishes: int) -> Work:
    """Return publishing on the bus."""
    bus = CommandExecutor(CommandRegistry((SampleCommand,)), lambda call, *more: call(*more))
    for _ in range(subscribers):
        bus.register_command(SampleCommand, handler)
    command, publish = SampleCommand(1), bus.execute_command

    def work() -> int:
        for _ in range(publishes):
            publish(command)
        return publishes

    return work


def dict_work(subscribers: int, publishes: int) -> Work:
    """Return publishing by a dict of lists, which isolates nothing."""
    subscribed: dict[str, list[Callable[[object], None]]] = {
        SampleCommand.NAME: [handler] * subscribers
    }
    command = SampleCommand(1)

    def publish(command: BaseCommand) -> None:
        for call in subscribed[command.NAME]:
            call(command)

    def work() -> int:
        for _ in range(publishes):
            publish(command)
        return publishes

    return work


def pluggy_work(subscribers: int, publishes: int) -> Work:
    """Return publishing by pluggy's hooks."""
    pluggy = import_module("pluggy")
    mark_spec, mark = pluggy.HookspecMarker("bench"), pluggy.HookimplMarker("bench")

    class Spec:
        @mark_spec  # type: ignore[untyped-decorator]
        def sample(self, command: Any) -> None:
            """Hear of a Command."""

    class Plugin:
        @mark  # type: ignore[untyped-decorator]
        def sample(self, command: Any) -> None:
            handler(command)

    manager = pluggy.PluginManager("bench")
    manager.add_hookspecs(Spec)
    for _ in range(subscribers):
        manager.register(Plugin())
    command, publish = SampleCommand(1), manager.hook.sample

    def work() -> int:
        for _ in range(publishes):
            publish(command=command)
        return publishes

    return work


def blinker_work(subscribers: int, publishes: int) -> Work:
    """Return publishing by a blinker signal."""
    signal = import_module("blinker").Signal()
    kept = [lambda command: handler(command) for _ in range(subscribers)]
    for each in kept:
        signal.connect(each)
    command, publish = SampleCommand(1), signal.send

    def work() -> int:
        for _ in range(publishes):
            publish(command)
        return publishes if kept else 0

    return work


PEERS = {"pluggy": pluggy_work, "blinker": blinker_work}


def rows() -> Iterable[Row]:
    """Measure and return the table's rows."""
    for subscribers, target in TARGETS.items():
        publishes = max(200, HANDLER_CALLS // subscribers)
        installed = [name for name in PEERS if importlib.util.find_spec(name)]
        works = [bus_work(subscribers, publishes), dict_work(subscribers, publishes)]
        works += [PEERS[name](subscribers, publishes) for name in installed]
        ours, base, *others = cpu_us(*works)
        what = f"publish to {subscribers}"
        yield Row(
            what, f"{ours * 1000:.0f} ns", "dict of lists", f"{base * 1000:.0f} ns",
            f"{ours / base:.2f}x", f"<= {target}x", ours <= target * base,
        )  # fmt: skip
        for name, figure in zip(installed, others, strict=True):
            yield Row(
                what, f"{ours * 1000:.0f} ns", name, f"{figure * 1000:.0f} ns",
                f"{ours / figure:.2f}x",
            )  # fmt: skip


if __name__ == "__main__":
    print_table(rows())

"""The three kinds of module: their declarations, and threads."""

import threading

import pytest
from twisted.internet.task import Clock

from tests.support.reactor import reactor, run_in_reactor, until
from tests.support.system import build_up, started
from tests.up.commands.samples import Log, NumberCommand
from up import base_thread_module
from up.base_module import BaseModule
from up.base_started_module import BaseStartedModule
from up.base_thread_module import BaseThreadModule
from up.needs import declared_needs, needs, wants


class Plain(BaseModule):
    """Says nothing."""


class Heir(Plain):
    """Needs what it says, and what its base says."""

    other = wants(Plain)


def test_what_a_module_says_of_itself():
    module = Plain()
    assert module.class_name == "Plain"
    assert module.path.endswith("test_base_modules.Plain")
    assert Heir().is_a("Plain") and not module.is_a("Heir")
    assert module.load() and module.telemetry_content is None
    with pytest.raises(AttributeError):
        _ = module.config


def test_references_before_initialization_say_when_they_come():
    class Needy(BaseModule):
        plain = needs(Plain)

    with pytest.raises(AttributeError):
        _ = Needy().plain
    assert [need.attribute for need in declared_needs(Needy)] == ["plain"]


def test_declarations_are_inherited_and_can_be_replaced():
    class Base(BaseModule):
        one = needs(Plain)
        two = needs(Plain)

    class Derived(Base):
        two = wants(Heir)

    found = {need.attribute: (need.wanted, need.optional) for need in declared_needs(Derived)}
    assert found == {"one": (Plain, False), "two": (Heir, True)}


class Worker(BaseThreadModule):
    """Publishes from its thread."""

    def on_init(self):
        self.rounds = 0

    def _loop(self):
        self.rounds += 1
        self.up.command_executor.execute_command(NumberCommand(1))
        self.stop_event.wait(0.01)


class Faulty(Worker):
    """Fails in its thread, in a different way each time."""

    def _loop(self):
        self.rounds += 1
        raise (RuntimeError("oops"), SystemExit(1))[self.rounds % 2]


def run(folder, cls, scenario):
    async def whole():
        up = build_up((cls,), reactor, folder, builtins=False)
        up.command_executor.adopt_thread()
        life = await started(up)
        module = up.get_module(cls)
        try:
            await scenario(up, module)
        finally:
            await life.stop()
        return module

    return run_in_reactor(whole)


def test_a_thread_publishes_to_the_reactor_and_ends_at_the_stop(tmp_path):
    heard = []

    async def scenario(up, module):
        up.command_executor.register_command(
            NumberCommand, lambda _: heard.append(threading.get_ident())
        )
        await until(lambda: len(heard) > 3)

    module = run(tmp_path, Worker, scenario)
    assert set(heard) == {threading.get_ident()}
    assert not module._thread.is_alive()
    assert module._thread.daemon


def test_a_loop_that_fails_is_counted_and_called_again(tmp_path, monkeypatch):
    monkeypatch.setattr(base_thread_module, "_PAUSE_AFTER_FAULT_S", 0.01)

    async def scenario(up, module):
        await until(lambda: module.faults >= 20)

    with Log() as log:
        module = run(tmp_path, Faulty, scenario)
    assert module.rounds >= 20
    faults = [event for event in log.failures if event["name"] == "Faulty"]
    # Two kinds: each is logged first, and as a count at the end.
    assert len(faults) == 4
    assert sum(event.get("more", 1) for event in faults) == module.faults


def test_a_thread_without_a_loop_is_named(tmp_path):
    class Empty(BaseThreadModule):
        pass

    up = build_up((Empty,), Clock(), tmp_path, builtins=False)
    with pytest.raises(NotImplementedError):
        up.get_module(Empty)._loop()


class OldBase(BaseStartedModule):
    """Overrides a hook by its deprecated name, as in the thesis."""

    def __init__(self):
        super().__init__()
        self.calls = []

    def _execute_start(self):
        super()._execute_start()
        self.calls.append("OldBase")


class NewMiddle(OldBase):
    def on_start(self):
        super().on_start()
        self.calls.append("NewMiddle")


class OldMixin:
    def _execute_start(self):
        super()._execute_start()
        self.calls.append("OldMixin")


class OldHeir(OldMixin, NewMiddle):
    def _execute_start(self):
        super()._execute_start()
        self.calls.append("OldHeir")


@pytest.mark.parametrize("name", ["on_start", "_execute_start"])
def test_deprecated_and_current_hook_names_can_be_mixed_in_one_hierarchy(name):
    module = OldHeir()
    getattr(module, name)()
    assert module.calls == ["OldBase", "NewMiddle", "OldMixin", "OldHeir"]

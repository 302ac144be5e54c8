"""Which module is stopped when the event loop is blocked again and again."""

from collections import Counter

import pytest
from twisted.internet.defer import Deferred
from twisted.internet.task import Clock
from twisted.logger import capturedLogs

from raspilot.failsafe.config import FailsafeConfig
from raspilot.modules.overload_guard import OverloadGuard
from tests.support.system import build_up, started
from up.base_started_module import BaseStartedModule
from up.commands.system_commands import LinkStateCommand
from up.needs import needs


class Base(BaseStartedModule):
    def __init__(self, config=None, silent=False):
        super().__init__(config, silent)
        self.heard, self.stops = 0, 0

    def on_init(self):
        self.up.command_executor.register_command(LinkStateCommand, self.on_link)

    def on_link(self, command):
        self.heard += 1

    def on_stop(self):
        self.stops += 1


class Early(Base):
    SHED_ORDER = 1


class Late(Base):
    SHED_ORDER = 2


class Needed(Base):
    SHED_ORDER = 0


class Control(Base):
    needed = needs(Needed)


class Rig:
    def __init__(self, folder):
        self.clock = Clock()
        modules = (OverloadGuard, Early, Late, Needed, Control)
        self.up = build_up(modules, self.clock, folder)
        self.blocks = Counter()
        self.up.count("reactor", self.blocks)
        self.guard = self.up.get_module(OverloadGuard)
        self.modules = {each.class_name: each for each in self.up.get_modules(Base)}
        self.busy = 1.0
        self.used_s = 0.0
        self.guard.processor_s = lambda: self.used_s
        Deferred.fromCoroutine(started(self.up)).addCallback(self._keep)

    def _keep(self, life):
        self.life = life

    def run(self, seconds, worst="Control", each_s=0):
        for _ in range(seconds):
            self.blocks[worst] += each_s
            self.used_s += self.busy
            self.clock.advance(1.0)

    @property
    def left(self):
        return {each.class_name for each in self.up.get_modules(Base)}


@pytest.fixture
def rig(tmp_path):
    with capturedLogs():
        yield Rig(tmp_path)


def test_optional_modules_are_stopped_in_their_order_while_it_lasts_and_never_control(rig):
    rig.run(20, each_s=0)
    assert (rig.left, rig.guard.failures) == (set(rig.modules), {"overload": False})
    rig.run(6, each_s=3)
    assert rig.guard.failures == {"overload": True}
    assert rig.left == {"Late", "Needed", "Control"}
    rig.run(7, each_s=3)
    assert rig.left == {"Late", "Needed", "Control"}, "it waits for the effect"
    rig.run(1, each_s=3)
    assert rig.left == {"Needed", "Control"}
    rig.run(40, each_s=3)
    assert rig.left == {"Needed", "Control"}
    assert rig.guard.failures == {"overload": True}
    rig.run(11, each_s=0)
    assert rig.guard.failures == {"overload": False}


def test_a_stopped_module_is_out_of_everything_and_forbids_arming(rig):
    rig.run(12, each_s=3)
    early = rig.modules["Early"]
    assert early.path in rig.up.vetoes.own
    rig.up.command_executor.execute_command(LinkStateCommand("any", True))
    assert [each.heard for each in rig.modules.values()] == [0, 1, 1, 1]
    rig.run(20)
    Deferred.fromCoroutine(rig.life.stop())
    assert [each.stops for each in rig.modules.values()] == [1, 1, 1, 1]
    assert rig.life.is_healthy


def test_the_one_to_blame_goes_first_even_if_it_only_waits(rig):
    rig.busy = 0.1
    rig.run(30, "Control", each_s=3)
    assert rig.left == set(rig.modules), "stopping others would not help"
    rig.blocks.clear()
    rig.run(30, "Late", each_s=3)
    assert rig.left == {"Early", "Needed", "Control"}


def test_a_block_now_and_then_is_no_overload(rig):
    for _ in range(20):
        rig.run(1, each_s=1)
        rig.run(1)
    assert rig.guard.failures == {"overload": False}


def test_its_failure_is_a_trigger_of_failsafe_yml():
    assert "overload" in FailsafeConfig().triggers

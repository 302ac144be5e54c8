"""Black Box Mode: wished for, or provisional while no Arduino answers."""

import pytest
from twisted.internet.defer import Deferred
from twisted.internet.task import Clock

from tests.support.system import build_up, started
from tests.up.commands.samples import Log
from up.base_module import BaseModule
from up.commands.origin import Origin
from up.commands.roles import Role
from up.commands.system_commands import LinkStateCommand
from up.mode import WITH_BOARD, Mode
from up.mode_monitor import ModeMonitor

built = []


class ForArduino(BaseModule):
    """Built only where an Arduino may be."""

    MODES = WITH_BOARD

    def __init__(self):
        built.append(self)


class Rig:
    """A started system."""

    def __init__(self, folder, mode, **config):
        self.clock = Clock()
        self.up = build_up((ForArduino,), self.clock, folder, mode=mode, config=config)
        self.monitor = self.up.get_module(ModeMonitor)
        got = []
        Deferred.fromCoroutine(started(self.up)).addBoth(got.append)
        self.life = got[0]

    def link(self, connected, role=Role.BOARD):
        origin = Origin("test", role)
        self.up.command_executor.execute_command(LinkStateCommand("test", connected), origin)

    @property
    def shown(self):
        return self.monitor.telemetry_content


@pytest.fixture
def rig(tmp_path):
    return Rig(tmp_path, Mode.AUTO)


def test_provisional_after_five_seconds_said_loudly_and_back(rig):
    rig.clock.advance(4.9)
    assert rig.shown["mode"] == "flight controller"
    with Log() as log:
        rig.clock.advance(0.2)
    assert rig.shown["mode"] == "black box (provisional)"
    assert [event["log_level"].name for event in log.events] == ["error"]
    with Log() as log:
        rig.link(True)
    assert rig.shown["mode"] == "flight controller"
    assert log.of("mode_restored")
    rig.clock.advance(60)
    assert rig.shown["mode"] == "flight controller"


def test_a_link_that_is_lost_counts_from_its_loss(rig):
    rig.link(True)
    rig.clock.advance(100)
    rig.link(False)
    rig.clock.advance(4.9)
    rig.link(False)
    assert rig.shown["mode"] == "flight controller"
    rig.clock.advance(0.2)
    assert rig.shown["mode"] == "black box (provisional)"


def test_a_sensor_is_not_a_board(rig):
    rig.link(True, Role.SENSOR)
    rig.clock.advance(6)
    assert rig.shown["mode"] == "black box (provisional)"
    rig.link(True, Role.SENSOR)
    assert rig.shown["mode"] == "black box (provisional)"


@pytest.mark.parametrize(
    ("mode", "shown", "controller"),
    [
        (Mode.BLACK_BOX, "black box", None),
        (Mode.FLIGHT_CONTROLLER, "flight controller", "arduino"),
    ],
)
def test_a_mode_that_was_asked_for_stays(tmp_path, mode, shown, controller):
    rig = Rig(tmp_path, mode)
    rig.clock.advance(60)
    rig.link(False)
    rig.clock.advance(60)
    assert rig.shown == {"mode": shown, "flight_controller": controller}


@pytest.mark.parametrize("mode", Mode)
def test_classes_for_the_arduino_are_not_even_built_in_black_box_mode(tmp_path, mode):
    built.clear()
    rig = Rig(tmp_path, mode)
    assert bool(built) == (mode is not Mode.BLACK_BOX) == bool(rig.up.get_module(ForArduino))


def test_nothing_is_left_after_the_stop(rig):
    Deferred.fromCoroutine(rig.life.stop())
    rig.link(False)
    assert not rig.clock.getDelayedCalls()

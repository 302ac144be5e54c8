"""A module's subscription to a reading: new readings of the followed source, and staleness."""

import math

import pytest
from twisted.internet.task import Clock

from tests.support.system import build_up
from up.base_module import BaseModule
from up.cleanup import CleanupStack
from up.commands.altitude_command import AltitudeCommand
from up.commands.orientation_command import OrientationCommand
from up.commands.origin import Origin
from up.commands.roles import Role
from up.needs import needs
from up.providers.up_altitude_provider import UpAltitudeProvider
from up.providers.up_orientation_provider import UpOrientationProvider

BOARD = Origin("arduino", Role.BOARD, 10)
PHONE = Origin("android", Role.SENSOR, 0)


class Listener(BaseModule):
    """Notes what a subscription reports."""

    altitude = needs(UpAltitudeProvider)
    orientation = needs(UpOrientationProvider)

    def on_init(self):
        self.got = []
        self.altitude.subscribe(self.on_altitude, lambda: self.got.append("stale"), 2.0)
        self.orientation.subscribe(
            lambda reading: self.got.append(reading.value.roll_deg),
            lambda: self.got.append("no attitude"),
        )

    def on_altitude(self, reading):
        if reading.value < 0:
            raise RuntimeError("below the sea")
        self.got.append((reading.value, reading.source))


class Rig:
    def __init__(self, folder):
        self.clock = Clock()
        self.up = build_up((Listener,), self.clock, folder)
        self.altitude = self.up.get_module(UpAltitudeProvider)

    def publish(self, command, origin=BOARD):
        self.up.command_executor.execute_command(command, origin)

    def got(self):
        """Return the reports since the last call."""
        got = self.up.get_module(Listener).got
        news = list(got)
        got.clear()
        return news


@pytest.fixture
def rig(tmp_path):
    return Rig(tmp_path)


def test_new_readings_of_the_followed_source_only(rig):
    rig.publish(AltitudeCommand(100.0))
    assert rig.got() == [(100.0, "arduino")]
    rig.publish(AltitudeCommand(300.0), PHONE)
    assert rig.got() == []
    rig.publish(AltitudeCommand(100.0))
    assert rig.got() == [(100.0, "arduino")]


def test_stale_once_when_the_newest_reading_is_older_than_the_limit(rig):
    rig.clock.pump([5.0])
    assert rig.got() == []
    rig.publish(AltitudeCommand(100.0))
    rig.clock.pump([1.5])
    rig.publish(AltitudeCommand(101.0))
    rig.clock.pump([1.0, 0.99])
    assert rig.got() == [(100.0, "arduino"), (101.0, "arduino")]
    rig.clock.pump([0.02])
    assert rig.got() == ["stale"]
    rig.clock.pump([10.0])
    assert rig.got() == [] and not rig.clock.getDelayedCalls()
    rig.publish(AltitudeCommand(102.0))
    rig.clock.pump([2.5])
    assert rig.got() == [(102.0, "arduino"), "stale"]


def test_an_invalid_reading_is_stale_immediately(rig):
    rig.publish(OrientationCommand(1.0, 0.0, 0.0))
    rig.publish(OrientationCommand(math.nan, 0.0, 0.0))
    rig.publish(OrientationCommand(math.nan, 0.0, 0.0))
    assert rig.got() == [1.0, "no attitude"]
    rig.publish(OrientationCommand(2.0, 0.0, 0.0))
    assert rig.got() == [2.0]


def test_the_modules_cleanup_ends_it(rig):
    got, stack = [], CleanupStack()
    with stack.recording():
        rig.altitude.subscribe(got.append, lambda: got.append("stale"))
    before = len(rig.clock.getDelayedCalls())
    rig.publish(AltitudeCommand(100.0))
    assert len(got) == 1 and len(rig.clock.getDelayedCalls()) == before + 2
    stack.unwind()
    assert len(rig.clock.getDelayedCalls()) == before + 1
    rig.publish(AltitudeCommand(101.0))
    rig.clock.pump([10.0])
    assert len(got) == 1


def test_a_fault_has_the_modules_name_and_stops_no_other(rig):
    failed, others = [], []
    rig.up.command_executor.on_handler_failed = failed.append
    rig.altitude.subscribe(others.append)
    rig.publish(AltitudeCommand(-1.0))
    assert failed == ["Listener"] and len(others) == 1

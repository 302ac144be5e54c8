import pytest
from load_guard_cog.config import LOAD_GUARD
from load_guard_cog.modules.load_guard import LoadGuard
from load_guard_cog.modules.system_state_provider import SystemStateProvider
from twisted.internet.defer import ensureDeferred
from twisted.internet.task import Clock

from tests.support.system import build_up, started
from up.commands.orientation_command import OrientationCommand
from up.commands.origin import Origin
from up.commands.panic_command import PanicCommand
from up.commands.roles import Role
from up.commands.system_commands import LinkStateCommand, SystemStateCommand
from up.config import ConfigErrors
from up.mode import Mode
from up.telemetry_controller import TelemetryController


class FakeMeter:
    """A load that the test sets: the thing measured is time and thresholds, not this machine."""

    load = 10.0

    def load_percent(self):
        return self.load

    def memory_percent(self):
        return 33.0


class Guard:
    def __init__(self, folder, modules=(LoadGuard,)):
        self.clock = Clock()
        self.up = build_up(modules, self.clock, folder)
        self.guard = self.up.get_module(LoadGuard)
        self.guard.meter = FakeMeter()
        self.panics = []
        self.up.command_executor.register_command(PanicCommand, self.panics.append)
        done = []
        ensureDeferred(started(self.up)).addCallback(done.append)
        assert done

    def run(self, seconds, load):
        self.guard.meter.load = load
        self.clock.pump([0.1] * round(seconds * 10))


@pytest.fixture
def system(tmp_path):
    return Guard(tmp_path)


def test_calm_leaves_panic_with_the_normal_delay(system):
    system.run(10, 100.0)
    system.run(20, 5.0)
    assert [(each.panic, each.delay_ms) for each in system.panics] == [(True, 150), (False, 20)]


def test_a_link_that_comes_during_panic_is_told(system):
    system.run(10, 100.0)
    system.up.command_executor.execute_command(LinkStateCommand("android", True))
    assert len(system.panics) == 2
    assert system.panics[1].panic


def test_telemetry_shows_the_load(system):
    system.run(10, 100.0)
    content = system.up.get_module(TelemetryController).collect()
    assert content["load"]["panic"] is True
    assert content["load"]["ram"] == 33.0
    assert content["load"]["cpu"] > 95
    assert content["load"]["delay_ms"] == 150


def test_the_state_of_the_system_tells_providers_and_the_arduino(tmp_path):
    system = Guard(tmp_path, (LoadGuard, SystemStateProvider))
    states = []
    executor = system.up.command_executor
    executor.register_command(SystemStateCommand, states.append)
    board = Origin("arduino", Role.BOARD, 10)
    executor.execute_command(LinkStateCommand("arduino", True), board)
    system.run(0.8, 10.0)
    executor.execute_command(OrientationCommand(1.0, 2.0, 3.0), board)
    system.run(0.3, 10.0)
    assert states[-1].providers == ("orientation",)
    assert states[-1].arduino_connected
    assert states[-1].mode == Mode.FLIGHT_CONTROLLER.value
    content = system.up.get_module(TelemetryController).collect()
    assert content["system"]["providers"] == ["orientation"]
    system.run(3, 10.0)
    assert states[-1].providers == ()


def test_telemetry_shows_a_published_state_whoever_publishes_it(tmp_path):
    system = Guard(tmp_path, (LoadGuard, SystemStateProvider))
    system.up.command_executor.execute_command(
        SystemStateCommand(1.0, 2.0, ("airspeed",), False, "x")
    )
    content = system.up.get_module(TelemetryController).collect()
    assert content["system"]["providers"] == ["airspeed"]


def test_the_real_meter_measures_this_machine():
    from load_guard_cog.modules.load_guard import PsutilMeter

    meter = PsutilMeter()
    assert 0 <= meter.load_percent() <= 100
    assert 0 < meter.memory_percent() <= 100


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("panic threshold: 50\n", "calm down threshold"),
        ("normal delay (ms): 200\n", "normal delay"),
        ("interval: 0\n", "interval"),
    ],
)
def test_settings_that_do_not_fit_are_refused(tmp_path, text, what):
    with pytest.raises(ConfigErrors, match=what):
        LOAD_GUARD.parse(text, tmp_path / "load_guard.yml")

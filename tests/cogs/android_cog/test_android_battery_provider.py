import pytest
from android_cog.commands.android_commands import (
    AndroidBatteryCommand,
    AndroidBatteryLowCommand,
)
from android_cog.modules.android_battery_provider import AndroidBatteryProvider
from twisted.internet.task import Clock

from tests.support.system import build_up
from up.commands.command import InvalidCommandError
from up.commands.origin import Origin
from up.commands.roles import Role

PHONE = Origin("android", Role.SENSOR)


def system(tmp_path, text=""):
    clock, events = Clock(), []
    up = build_up([AndroidBatteryProvider], clock, tmp_path, config={"android.yml": text})
    up.command_executor.register_command(AndroidBatteryLowCommand, events.append)
    return up, clock, events, up.get_module(AndroidBatteryProvider)


def level(up, percent):
    up.command_executor.execute_command(AndroidBatteryCommand(percent), PHONE)


def test_telemetry_tells_level_age_and_source(tmp_path):
    up, clock, _, battery = system(tmp_path)
    assert battery.telemetry_content == {
        "android": {"batteryLevel": None},
        "age_ms": {"battery": None},
        "source": {"battery": None},
    }
    level(up, 81.5)
    clock.advance(2.5)
    assert battery.telemetry_content == {
        "android": {"batteryLevel": 81.5},
        "age_ms": {"battery": 2500},
        "source": {"battery": "android"},
    }


def test_low_is_one_event_and_ends_with_hysteresis(tmp_path):
    up, _, events, battery = system(tmp_path)
    for percent in (50, 21, 20, 19, 21, 24.9, 18, 25, 30, 3):
        level(up, percent)
    assert events == [
        AndroidBatteryLowCommand(20, True),
        AndroidBatteryLowCommand(25, False),
        AndroidBatteryLowCommand(3, True),
    ]
    assert battery.is_low


def test_zero_means_never(tmp_path):
    up, _, events, _ = system(tmp_path, "low battery (percent): 0\n")
    level(up, 0)
    assert events == []


@pytest.mark.parametrize("given", [None, True, "50", -1, 100.5, float("nan"), [50], {}])
def test_only_a_percentage_is_a_level(given):
    with pytest.raises(InvalidCommandError, match="level"):
        AndroidBatteryCommand.from_data({"level": given})

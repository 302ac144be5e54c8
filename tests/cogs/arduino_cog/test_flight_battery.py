"""The flight battery: from the Arduino's status to telemetry, with limits from its file."""

from pathlib import Path

import pytest
from twisted.logger import globalLogPublisher

from raspilot.modules.flight_battery import FLIGHT_BATTERY, FlightBattery
from up.commands.flight_state_command import FlightBatteryCommand
from up.commands.origin import Origin
from up.commands.roles import Role
from up.config import ConfigErrors

LIMITS = {"flight_battery.yml": "low_v: 10.5\ncritical_v: 9.9\n"}


def shown(rig):
    arduino = rig.up.telemetry_controller.collect()["arduino"]
    return tuple(arduino[f"flight_battery_{name}"] for name in ("v", "low", "critical"))


@pytest.fixture
def codes():
    """The codes of the log."""
    found = []

    def observe(event):
        found.append(event.get("code"))

    globalLogPublisher.addObserver(observe)
    yield found
    globalLogPublisher.removeObserver(observe)


def say(rig, voltage_v):
    rig.battery_mv = round(voltage_v * 1000)
    rig.status()
    return shown(rig)


def test_the_voltage_is_in_telemetry_and_unknown_without_an_answer(rig):
    rig.connect()
    assert shown(rig) == (None, None, None)
    assert say(rig, 11.1449) == (11.14, None, None)
    rig.advance(5.0)
    assert shown(rig) == (None, None, None)


def test_limits_are_passed_downwards_and_left_only_above_a_margin(make_rig):
    rig = make_rig("checked", LIMITS)
    rig.connect()
    assert say(rig, 10.5) == (10.5, False, False)
    assert say(rig, 10.49) == (10.49, True, False)
    assert say(rig, 9.89) == (9.89, True, True)
    assert say(rig, 10.0) == (10.0, True, True)
    assert say(rig, 10.1) == (10.1, True, False)
    assert say(rig, 10.7) == (10.7, True, False)
    assert say(rig, 10.71) == (10.71, False, False)
    assert say(rig, 0.0) == (10.71, False, False)
    rig.alive(2.4)
    assert shown(rig) == (None, None, None)
    assert say(rig, 10.7) == (10.7, False, False), "without a voltage the margin is forgotten"


def test_an_older_firmware_has_a_status_without_a_voltage(rig):
    rig.connect()
    say(rig, 11.1)
    rig.battery_mv = 0
    rig.alive(2.4)
    rig.say("x", bytes.fromhex("016601cd080107d0003000030001004b000c0004"))
    assert shown(rig)[0] is None
    assert rig.arduino.status.uptime_s == 75


@pytest.mark.parametrize(("config", "count"), [({}, 0), (LIMITS, 1)])
def test_limits_without_a_voltage_are_logged_once(make_rig, codes, config, count):
    rig = make_rig("checked", config)
    rig.connect()
    rig.alive(2.0)
    assert codes.count("flight_battery_unknown") == 0
    rig.alive(2.0)
    assert codes.count("flight_battery_unknown") == count
    say(rig, 11.1)
    say(rig, 0.0)
    rig.alive(4.0)
    assert codes.count("flight_battery_unknown") == count


@pytest.mark.parametrize(
    ("text", "key"),
    [
        ("low_v: 9.9\ncritical_v: 9.9\n", "critical_v"),
        ("low_v: 0.5\n", "low_v"),
        ("critical_v: 66\n", "critical_v"),
        ("low_v: full\n", "low_v"),
    ],
)
def test_impossible_limits_are_refused(text, key):
    with pytest.raises(ConfigErrors) as caught:
        FLIGHT_BATTERY.parse(text, Path("flight_battery.yml"))
    assert [each.key for each in caught.value.problems] == [key]


@pytest.mark.parametrize("text", ["low_v: 10.5\n", "critical_v: 9.9\n", ""])
def test_one_limit_or_none_is_enough(text):
    FLIGHT_BATTERY.parse(text, Path("flight_battery.yml"))


def test_a_sag_is_a_failure_only_while_it_lasts(make_rig):
    rig = make_rig("checked", LIMITS)
    rig.connect()
    battery = rig.up.get_module(FlightBattery)
    seen = []
    for voltage_v in (0.0, 11.1, 10.4, 10.55, 9.8):
        say(rig, voltage_v)
        seen.append(tuple(battery.failures.values()))
    none = (False, False)
    assert seen == [none, none, (True, False), none, (True, True)]


def test_a_sensor_comes_before_the_arduino_until_it_is_silent(make_rig):
    rig = make_rig("checked", LIMITS)
    rig.connect()
    executor = rig.up.command_executor

    def measure(voltage_v, current_a, link="main", priority=20):
        origin = Origin(link, Role.SENSOR, priority)
        executor.execute_command(FlightBatteryCommand(voltage_v, current_a), origin)

    assert say(rig, 11.1) == (11.1, False, False)
    for _ in range(7):
        measure(10.4, 7.5)
        measure(12.0, 0.1, "spare", 10)
        rig.alive(0.2)
    assert say(rig, 11.1) == (10.4, True, False)
    assert rig.up.telemetry_controller.collect()["arduino"]["flight_battery_a"] == 7.5
    assert rig.up.get_module(FlightBattery).failures["flight_battery_low"]
    rig.advance(2.1)
    assert say(rig, 11.1) == (11.1, False, False)
    assert rig.up.telemetry_controller.collect()["arduino"]["flight_battery_a"] is None

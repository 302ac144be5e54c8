import re

import pytest

from up_ground.catalogue import (
    Catalogue,
    catalogue_message,
    command_fields,
    describe,
    fault_of,
)


@pytest.fixture(scope="module")
def catalogue():
    return Catalogue.installed()


def test_what_only_boards_sensors_and_modules_send_is_not_listed(catalogue):
    listed = {cls.NAME for cls in catalogue.sendable()}
    assert {"up.arm", "android.speak", "arduino.pids.tunings"} <= listed
    assert not {"up.system.stop", "up.rx.update", "android.battery", "up.ack"} & listed


def test_a_command_teaches_its_fields(catalogue):
    head, *_, field = describe(catalogue.get("up.telemetry.frequency"))
    assert "[operator" in head
    assert re.search(r"frequency .* 20 .* 10000 ms", field)
    assert len(list(describe(catalogue.get("up.arm")))) == 3


def test_a_mistyped_name_finds_its_neighbours(catalogue):
    assert catalogue.suggestions("up.flightmode.set")[0] == "up.flight_mode.set"
    assert "up.arm" in catalogue.suggestions("UP.ARM")
    assert "android.speak" in catalogue.suggestions("speak")
    assert catalogue.suggestions("zzzzzzzzzz") == []
    assert catalogue.suggestions("") == []


@pytest.mark.parametrize(
    ("name", "data", "sentence"),
    [
        ("up.flight_mode.set", {"mode": "FBW"}, ""),
        ("up.flight_mode.set", {"mode": 5}, "mode must be"),
        ("up.flight_mode.set", {}, "mode is missing"),
        ("up.flight_mode.set", {"mode": "FBW", "mood": 1}, "has no field mood"),
        ("up.telemetry.frequency", {"frequency": 5}, "between 20 and 10000 ms"),
        ("arduino.pids.tunings", {"pids": {"ratePIDs": {}}}, "stabPIDs is missing"),
    ],
)
def test_mistakes_are_found_before_anything_is_sent(catalogue, name, data, sentence):
    fault = fault_of(catalogue.get(name), data)
    assert sentence in fault
    assert bool(fault) == bool(sentence)


def test_roles(catalogue):
    commands = {each["name"]: each for each in catalogue_message(catalogue)["commands"]}
    assert (commands["up.arm"]["role"], commands["up.arm"]["role_where"]) == ("pilot", [])
    gains = commands["arduino.pids.tunings"]
    assert gains["role"] == "pilot"
    assert gains["role_where"] == [{"field": "request", "value": True, "role": "observer"}]
    assert "up.output.set" not in commands
    heading = command_fields(catalogue.get("up.heading.change"))
    assert heading["role"] == "operator"
    assert heading["role_where"] == [{"field": "mode", "value": "required", "role": "operator"}]


def test_two_commands_of_one_name_are_told_and_survived():
    from up.commands.arming_commands import ArmCommand
    from up.commands.command import BaseCommand

    class Impostor(BaseCommand):
        NAME = "up.arm"

    class Nameless(BaseCommand):
        pass

    catalogue = Catalogue([ArmCommand, Impostor, Nameless])
    assert catalogue.get("up.arm") is ArmCommand
    assert len(catalogue.problems) == 2

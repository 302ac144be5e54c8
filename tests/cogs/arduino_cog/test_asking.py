"""Arming, flight modes and panic: requests to the Arduino."""

import pytest
from arduino_cog.modules.arduino_provider import ArduinoProvider

from up.commands.arming_commands import ArmCommand, DisarmCommand
from up.commands.board_schema import VETOES, Reason
from up.commands.flight_state_command import FlightModeCommand
from up.commands.panic_command import PanicCommand
from up.commands.refusal import Code, CommandRefusedError


def refusal(outcome):
    assert isinstance(outcome[0], CommandRefusedError)
    return outcome[0]


def test_arming_follows_the_arduinos_answer(rig):
    rig.connect()
    assert rig.ask(ArmCommand()) == ["done"]
    assert rig.sent("a") == [b""]


def test_arming_waits_for_the_arduinos_answer(rig):
    rig.connect()
    rig.mute = {"a"}
    outcome = rig.ask(ArmCommand())
    assert outcome == []
    for _ in range(5):
        rig.advance(0.1)
        rig.status()
    rig.advance(0.1)
    assert refusal(outcome).code is Code.TIMEOUT
    assert len(rig.sent("a")) == 1, "arming is never repeated automatically"


def test_every_veto_of_this_program_refuses_arming_by_name(rig):
    rig.connect()
    rig.up.vetoes.set("pids.yml", "is corrupt")
    rig.up.vetoes.set("raspilot.modules.mine", "did not start: no wing")
    outcome = refusal(rig.ask(ArmCommand()))
    assert outcome.detail == "veto"
    assert all(name in outcome.reason for name in rig.up.vetoes.own)
    assert rig.sent("a") == [], "the Arduino is not even asked"
    rig.up.vetoes.clear("pids.yml")
    rig.up.vetoes.clear("raspilot.modules.mine")
    assert rig.ask(ArmCommand()) == ["done"]


def test_the_arduinos_own_veto_is_told_in_words(rig):
    rig.connect()
    rig.status(vetoes=0b1010)
    rig.refuse = {"a": Reason.VETO}
    outcome = refusal(rig.ask(ArmCommand()))
    assert outcome.detail == "veto"
    assert f"({VETOES[1]}, {VETOES[3]})" in outcome.reason


@pytest.mark.parametrize("command", [ArmCommand(), DisarmCommand(), FlightModeCommand("FBW")])
def test_without_an_arduino_nothing_can_be_asked(rig, command):
    rig.start_alone()
    assert refusal(rig.ask(command)).code is Code.UNAVAILABLE


@pytest.mark.parametrize("command", [ArmCommand(), DisarmCommand(), FlightModeCommand("FBW")])
def test_an_old_firmware_is_not_asked_and_the_reason_says_why(make_rig, command):
    rig = make_rig("thesis")
    rig.start()
    rig.say("o", b"\0" * 12)
    rig.forget()
    assert refusal(rig.ask(command)).detail == "old_firmware"
    rig.advance(1)
    assert rig.port.heard == []


def test_what_waits_fails_when_the_arduino_goes(rig):
    rig.connect()
    rig.mute = {"a"}
    outcome = rig.ask(ArmCommand())
    rig.port.unplug()
    rig.turn()
    assert refusal(outcome).code is Code.UNAVAILABLE


def test_disarming_is_asked_twice_if_need_be(rig):
    rig.connect()
    rig.mute = {"d"}
    outcome = rig.ask(DisarmCommand())
    rig.advance(0.4)
    rig.status()
    rig.mute = set()
    rig.advance(0.2)
    assert outcome == ["done"]
    assert len(rig.sent("d")) == 2


@pytest.mark.parametrize(
    ("controller", "mode", "letter"),
    [
        ("arduino", "RATE", b"r"),
        ("arduino", "FBW", b"f"),
        ("arduino", "AUTO", b"s"),
        ("raspberry", "RATE", b"r"),
        ("raspberry", "FBW", b"f"),
        ("raspberry", "AUTO", b"u"),
    ],
)
def test_flight_modes_have_their_letters(make_rig, controller, mode, letter):
    rig = make_rig(config={"config.yml": f"flight controller: {controller}\n"})
    rig.connect()
    assert rig.ask(FlightModeCommand(mode)) == ["done"]
    assert rig.sent("M") == [letter]


def test_a_flight_mode_is_refused_unless_the_switch_is_at_auto(rig):
    rig.connect()
    rig.refuse = {"M": Reason.NOT_AT_AUTO}
    assert refusal(rig.ask(FlightModeCommand("FBW"))).detail == "not_at_auto"


@pytest.mark.parametrize("framing", ["checked", "thesis"])
def test_panic_is_passed_on_in_both_framings(make_rig, framing):
    rig = make_rig(framing)
    rig.start()
    rig.say("r", b"\x05\xdc" * 4)
    rig.publish(PanicCommand(True, 150))
    rig.publish(PanicCommand(False, 50))
    assert rig.sent("p") == [bytes.fromhex("010096"), bytes.fromhex("000032")]


def test_a_board_that_was_reset_hears_of_the_panic_again(rig):
    rig.connect()
    rig.publish(PanicCommand(True, 150))
    rig.status(uptime_s=100)
    rig.forget()
    rig.status(uptime_s=0)
    assert rig.sent("p") == [bytes.fromhex("010096")]


def test_panic_without_an_arduino_is_told_when_it_comes(rig):
    rig.start_alone()
    rig.publish(PanicCommand(True, 150))
    assert rig.sent("p") == []
    rig.status()
    assert rig.sent("p") == [bytes.fromhex("010096")]


def test_a_panic_that_is_refused_harms_nothing(rig):
    rig.connect()
    rig.refuse = {"p": 3}
    rig.publish(PanicCommand(True, 150))
    rig.mute = {"p"}
    rig.publish(PanicCommand(False, 50))
    for _ in range(12):
        rig.advance(0.1)
        rig.status()
    assert rig.module(ArduinoProvider).connected
    assert not rig.up.command_executor.counters["failed_handlers"]

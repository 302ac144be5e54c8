"""Calibrating from the ground: only the board refuses."""

import math

import pytest
from arduino_cog.commands.arduino_commands import ArduinoCalibrateCommand, BatteryCalibrateCommand

from up.commands.board_schema import Reason
from up.commands.command import InvalidCommandError
from up.commands.refusal import Code, CommandRefusedError


@pytest.mark.parametrize(
    ("what", "number"), [("level", 0), ("receiver_begin", 1), ("receiver_end", 2), ("gyro", 3)]
)
def test_each_goes_to_the_board_whose_answer_is_the_answer(rig, what, number):
    rig.connect()
    assert rig.ask(ArduinoCalibrateCommand(what)) == ["done"]
    assert rig.sent("e") == [bytes((number,))]


@pytest.mark.parametrize(
    ("reason", "detail"),
    [(Reason.OUT_OF_RANGE, "out_of_range"), (Reason.NOT_STILL, "not_still")],
)
def test_the_arduinos_refusal_is_returned(rig, reason, detail):
    rig.connect()
    rig.refuse = {"e": reason}
    (error,) = rig.ask(ArduinoCalibrateCommand("gyro"))
    assert isinstance(error, CommandRefusedError)
    assert error.detail == detail


def test_the_batterys_voltage_goes_to_the_board_whose_answer_is_the_answer(rig):
    rig.connect()
    assert rig.ask(BatteryCalibrateCommand(12.345)) == ["done"]
    assert rig.sent("V") == [(12345).to_bytes(2, "big")]
    rig.refuse = {"V": Reason.BATTERY_NOT_MEASURED}
    assert rig.ask(BatteryCalibrateCommand(12.3))[0].detail == "battery_not_measured"
    rig.forget()
    rig.status(armed=True)
    assert rig.ask(BatteryCalibrateCommand(12.3))[0].detail == "in_flight"
    assert rig.sent("V") == []


@pytest.mark.parametrize("voltage", [None, -0.1, 65.1, "12", math.nan, True])
def test_what_is_no_voltage_is_no_command(voltage):
    with pytest.raises(InvalidCommandError, match="voltage"):
        BatteryCalibrateCommand.from_data({"voltage": voltage})


@pytest.mark.parametrize(("what", "asked"), [("level", 2), ("receiver_end", 1)])
def test_the_end_of_the_receivers_is_asked_once(rig, what, asked):
    rig.connect()
    rig.mute = {"e"}
    outcome = rig.ask(ArduinoCalibrateCommand(what))
    rig.alive(1.2)
    assert len(rig.sent("e")) == asked
    assert outcome[0].code is Code.TIMEOUT


def test_without_an_arduino_and_with_an_old_one_it_is_refused(make_rig):
    rig = make_rig()
    rig.start_alone()
    assert rig.ask(ArduinoCalibrateCommand("gyro"))[0].code is Code.UNAVAILABLE
    old = make_rig("thesis")
    old.start()
    assert "framing: thesis" in old.ask(ArduinoCalibrateCommand("gyro"))[0].reason


@pytest.mark.parametrize("data", [{}, {"what": "compass"}, {"what": 0}, {"what": None}])
def test_what_is_no_calibration_is_no_command(data):
    with pytest.raises(InvalidCommandError, match="what"):
        ArduinoCalibrateCommand.from_data(data)

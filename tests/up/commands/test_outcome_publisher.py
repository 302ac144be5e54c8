"""Outcomes of Commands are published on the bus for the flight's log, also for repetitions."""

import pytest

from tests.up.commands.samples import Border, NumberCommand
from up.commands.answer_commands import CommandAnsweredCommand
from up.commands.outcome_publisher import ANSWERS_HZ
from up.commands.refusal import CommandRefusedError
from up.protocols.general_message import MalformedMessage


@pytest.fixture
def border():
    border = Border()
    border.outcomes = []
    border.bus.add_observer(
        lambda command, origin: (
            border.outcomes.append((command, origin.link))
            if isinstance(command, CommandAnsweredCommand)
            else None
        )
    )
    return border


def outcomes(border):
    return [(each.name, each.command_id, each.outcome, each.code) for each, _ in border.outcomes]


def test_every_fate_is_told_once_also_the_tenth_of_its_kind(border):
    def refuse(command):
        if command.number:
            raise CommandRefusedError("not now")

    border.bus.register_command(NumberCommand, refuse)
    border.say("test.number", {"number": 0}, "a")
    for number in range(10):
        border.say("test.number", {"number": 1}, f"b{number}")
    border.say("no.such", {})
    border.say("test.number", {"number": "x"}, "c")
    border.say("test.number", {"number": 0}, "d", beacon=-7)
    assert outcomes(border) == [
        ("test.number", "a", "ack", ""),
        *(("test.number", f"b{number}", "nack", "refused") for number in range(10)),
        ("no.such", None, "nack", "unknown"),
        ("test.number", "c", "nack", "invalid"),
        ("test.number", "d", "nack", "unknown_beacon"),
    ]
    assert {link for _, link in border.outcomes} == {"internal"}
    assert {each.link for each, _ in border.outcomes} == {"ground"}
    assert border.outcomes[1][0].reason == "not now"


def test_what_nobody_asked_about_is_not_told(border):
    border.bus.register_command(NumberCommand, lambda command: None)
    for _ in range(100):
        border.say("test.number", {"number": 1})
    border.receiver.receive_malformed(MalformedMessage("nonsense", None), border.link)
    assert border.outcomes == []
    border.receiver.receive_malformed(MalformedMessage("nonsense", "a"), border.link)
    assert outcomes(border) == [("", "a", "nack", "malformed")]


def test_a_flood_of_refusals_is_told_in_part_and_counted(border):
    for number in range(500):
        border.say("no.such", {}, f"{number}")
    assert len(border.outcomes) == ANSWERS_HZ
    assert len(border.answers) == 500
    border.clock.advance(1)
    border.say("no.such" + "x" * 500, {}, "later")
    newest = border.outcomes[-1][0]
    assert (newest.command_id, newest.untold, len(newest.name)) == ("later", 480, 64)


def test_a_bus_without_a_recorder_counts_nothing_as_unhandled():
    border = Border()
    border.bus.register_command(NumberCommand, lambda command: None)
    border.say("test.number", {}, "a")
    border.say("test.number", {"number": "x"}, "b")
    assert border.bus.counters["unhandled"] == 0

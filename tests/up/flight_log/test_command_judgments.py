"""Requests of the ground without success, as the flight's log shows them."""

from tests.up.flight_log.flights import FlightMaker
from up.commands.answer_commands import CommandAnsweredCommand
from up.flight_log.wrongs import wrongs


def answered(name, code="", reason="", untold=0):
    outcome = "nack" if code else "ack"
    return CommandAnsweredCommand("mission_control", name, "1", outcome, code, reason, untold)


def test_each_kind_of_refusal_is_told_once_with_its_count(tmp_path):
    maker = FlightMaker()
    for number in range(10):
        maker.put(1 + number / 10, answered("up.disarm", "refused", "the throttle is not low"))
    maker.put(1.5, answered("up.disarm"))
    maker.put(1.6, answered("up.arm", "stale", "up.arm: too old"))
    # The same record in the program's log is not reported again.
    maker.line(1, 2, "CommandExecutor", "Arming refused up.disarm: the throttle is not low")
    maker.put(1.9, answered("up.arm", untold=480))
    found = wrongs(maker.log(tmp_path))
    assert [(round(each.time_s, 1), each.level, each.text) for each in found] == [
        (
            0.0,
            "info",
            "up.disarm of mission_control was refused: the throttle is not low, 10 times",
        ),
        (0.6, "info", "up.arm of mission_control was refused: too old"),
        (0.9, "info", "480 answers to Commands came too fast to be logged"),
    ]


def test_kinds_without_end_are_bounded(tmp_path):
    maker = FlightMaker()
    for number in range(300):
        maker.put(number / 300, answered("up.arm", "refused", f"reason {number}"))
    assert len(wrongs(maker.log(tmp_path))) <= 51

"""What happened, one line each."""

import pytest
from black_box_cog.report.events import MAX_ENTRIES, events_of

from tests.up.flight_log.flights import GROUND, FlightMaker, LinkStateCommand, PanicCommand
from tests.up.flight_log.flights import FlightStateCommand as State
from tests.up.flight_log.flights import PIDTuningsCommand as Tunings
from up.flight_log.flight_context import FlightContext


@pytest.fixture
def told(tmp_path):
    def told(maker):
        log = maker.log(tmp_path)
        return [(round(each.time_s, 1), each.text) for each in events_of(log, FlightContext(log))]

    return told


def test_a_state_is_an_event_when_it_changes(told):
    maker = FlightMaker()
    for time_s, is_there in ((0, False), (1, True), (2, True), (3, False)):
        maker.put(time_s, LinkStateCommand("android", is_there))
    for time_s, is_panic in ((0, False), (4, True), (5, True), (6, False)):
        maker.put(time_s, PanicCommand(is_panic, 150))
    assert told(maker) == [
        (1.0, "the phone is there"),
        (3.0, "the phone is gone"),
        (4.0, "Panic Mode: every 150 ms only"),
        (6.0, "Panic Mode ends"),
    ]


def test_each_set_of_gains_is_one(told):
    axes = {axis: {"p": 1.0, "i": 0.0, "d": 0.0} for axis in ("ailerons", "elevator", "rudder")}
    maker = FlightMaker()
    for time_s in (0, 1):
        maker.put(time_s, Tunings(pids={"ratePIDs": axes, "stabPIDs": axes}), GROUND)
    maker.put(2, Tunings(request=True), GROUND)
    text = "gains were set by the ground (through the proxy)"
    assert told(maker) == [(0.0, text), (1.0, text)]


def test_who_flies(told):
    maker = FlightMaker()
    for time_s, mode, is_armed, is_failsafe in (
        (0, "FBW", False, False),
        (1, "FBW", True, False),
        (2, "FBW", True, True),
        (3, "RTH", True, False),
        (4, "RTH", False, False),
    ):
        maker.put(time_s, State(mode, is_armed, False, is_failsafe))
    assert [text for _, text in told(maker)] == [
        "flight mode FBW",
        "armed",
        "failsafe: the receiver is lost",
        "flight mode RTH",
        "the receiver is back",
        "disarmed",
    ]


def test_a_page_stays_a_page(told):
    maker = FlightMaker()
    for number in range(MAX_ENTRIES + 5):
        maker.add(number, "black_box.mark", text=str(number))
    found = told(maker)
    assert len(found) == MAX_ENTRIES + 1 and found[-1][1] == "5 more events are not shown"

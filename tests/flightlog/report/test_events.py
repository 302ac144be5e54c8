import pytest

from tests.flightlog.flights import GROUND, FlightMaker, LinkStateCommand, PanicCommand
from tests.flightlog.flights import FlightStateCommand as State
from tests.flightlog.flights import PIDTuningsCommand as Tunings
from up_flightlog.findings.flight_context import FlightContext
from up_flightlog.report.events import MAX_ENTRIES, events_of


@pytest.fixture
def codes(tmp_path):
    def codes(maker):
        log = maker.log(tmp_path)
        return [(round(each.time_s, 1), each.code) for each in events_of(log, FlightContext(log))]

    return codes


def test_a_state_is_an_event_when_it_changes(codes):
    maker = FlightMaker()
    for time_s, is_there in ((0, False), (1, True), (2, True), (3, False)):
        maker.put(time_s, LinkStateCommand("android", is_there))
    for time_s, is_panic in ((0, False), (4, True), (5, True), (6, False)):
        maker.put(time_s, PanicCommand(is_panic, 150))
    assert codes(maker) == [
        (1.0, "connected"),
        (3.0, "disconnected"),
        (4.0, "panic"),
        (6.0, "panic_over"),
    ]


def test_each_set_of_gains_is_one(codes):
    axes = {axis: {"p": 1.0, "i": 0.0, "d": 0.0} for axis in ("ailerons", "elevator", "rudder")}
    maker = FlightMaker()
    for time_s in (0, 1):
        maker.put(time_s, Tunings(pids={"ratePIDs": axes, "stabPIDs": axes}), GROUND)
    maker.put(2, Tunings(request=True), GROUND)
    assert codes(maker) == [(0.0, "gains"), (1.0, "gains")]


def test_modes_arming_and_failsafe(codes):
    maker = FlightMaker()
    for time_s, mode, is_armed, is_failsafe in (
        (0, "FBW", False, False),
        (1, "FBW", True, False),
        (2, "FBW", True, True),
        (3, "RTH", True, False),
        (4, "RTH", False, False),
    ):
        maker.put(time_s, State(mode, is_armed, False, is_failsafe))
    assert [code for _, code in codes(maker)] == [
        "flight_mode",
        "armed",
        "failsafe",
        "flight_mode",
        "failsafe_over",
        "disarmed",
    ]


def test_events_are_bounded(codes):
    maker = FlightMaker()
    for number in range(MAX_ENTRIES + 5):
        maker.add(number, "black_box.mark", text=str(number))
    found = codes(maker)
    assert len(found) == MAX_ENTRIES + 1 and found[-1][1] == "more"

"""The age of known values."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.ground.aircraft import frame
from up.protocols.general_message import GeneralMessage
from up_ground.telemetry import LATE_S, NAME, Telemetry


def told(data=None, now_s=100.0, beacon=None):
    telemetry = Telemetry()
    telemetry.update(GeneralMessage(NAME, frame() if data is None else data, None, beacon), now_s)
    return telemetry


def test_nothing_is_known_before_the_first_frame():
    telemetry = Telemetry()
    assert telemetry.is_silent(0)
    assert telemetry.age_s(0) is None
    assert telemetry.reading_age_s("orientation", 0) is None
    assert telemetry.is_stale("orientation", 0)
    assert telemetry.rate_hz(0) is None


def test_the_age_of_a_reading_is_that_on_board_and_on_the_way_and_since():
    telemetry = told()
    telemetry.on_round_trip(200.0)
    assert telemetry.reading_age_s("orientation", 100.5) == pytest.approx(0.012 + 0.1 + 0.5)
    assert telemetry.reading_age_s("nothing", 100.5) is None


def clocked(telemetry, clock_ms, now_s, beacon=None):
    """Take a frame with the aircraft's clock; return its age."""
    data = frame(system={"clock_ms": clock_ms})
    telemetry.update(GeneralMessage(NAME, data, None, beacon), now_s)
    return telemetry.age_s(now_s)


def test_a_frame_that_was_held_up_is_old_when_it_comes():
    telemetry = Telemetry()
    telemetry.on_round_trip(40.0)
    assert clocked(telemetry, 1000, 10.0) == pytest.approx(0.02)
    assert not telemetry.is_stale("orientation", 10.0)
    # The next one has not left yet: the period is longer.
    assert clocked(telemetry, 5000, 17.0) == pytest.approx(3.02, abs=0.001)
    assert telemetry.is_silent(17.0)
    assert telemetry.is_late(17.0)
    assert telemetry.is_stale("orientation", 17.0)
    assert telemetry.reading_age_s("orientation", 17.0) == pytest.approx(3.032, abs=0.001)
    assert clocked(telemetry, 8100, 17.1) == pytest.approx(0.02, abs=0.001)
    assert not telemetry.is_late(17.1)


def test_after_a_cut_what_it_held_up_is_dropped():
    telemetry = Telemetry()
    # One frame each 100 ms; those of a second come together, 0.4 s after its end.
    came_s = {1000: 10.0, **{ms: 11.4 for ms in range(1100, 2400, 100)}, 2400: 11.41, 2500: 11.5}
    shown = []
    for number, (clock_ms, now_s) in enumerate(came_s.items()):
        message = GeneralMessage(NAME, frame(system={"clock_ms": clock_ms}), None, number)
        if telemetry.update(message, now_s):
            shown.append(clock_ms)
            assert telemetry.way_s <= LATE_S + 0.001
    assert shown == [1000, 2100, 2200, 2300, 2400, 2500]
    assert (telemetry.frames, telemetry.lost) == (6, 10)


def test_frames_that_stay_late_are_shown_as_late():
    telemetry = Telemetry()
    clocked(telemetry, 1000, 10.0)
    ages_s = [clocked(telemetry, 1100 + ms, 12.1 + ms / 1000) for ms in range(0, 1500, 100)]
    shown = [number for number, age_s in enumerate(ages_s) if age_s == pytest.approx(2, abs=0.001)]
    assert shown == list(range(10, 15))
    assert telemetry.is_late(13.5)


def test_a_queue_before_the_proxy_is_not_counted_twice():
    telemetry = Telemetry()
    telemetry.on_round_trip(40.0)
    clocked(telemetry, 1000, 10.0)
    telemetry.on_round_trip(2040.0)
    assert clocked(telemetry, 4000, 15.0) == pytest.approx(2.02, abs=0.001)


def test_an_aircraft_without_a_clock_is_judged_by_the_round_trip_alone():
    telemetry = told()
    for round_trip_ms, age_s in ((40.0, 0.02), (2040.0, 1.02), (None, 0.0)):
        telemetry.on_round_trip(round_trip_ms)
        assert telemetry.age_s(100.0) == pytest.approx(age_s)
    assert not telemetry.is_late(100.0)


def test_silence_is_not_lateness():
    telemetry = told()
    assert not Telemetry().is_late(0)
    assert not telemetry.is_late(105.0)


@pytest.mark.parametrize("clock_ms", [float("nan"), float("inf"), 10**30, "1000", True, None, [1]])
def test_a_clock_that_is_none_is_as_if_it_were_not_told(clock_ms):
    telemetry = Telemetry()
    telemetry.on_round_trip(40.0)
    clocked(telemetry, 1000, 10.0)
    assert clocked(telemetry, clock_ms, 14.0) == pytest.approx(0.02)


def test_an_aircraft_that_was_started_anew_has_another_clock():
    telemetry = Telemetry()
    clocked(telemetry, 1000, 10.0, beacon=5_000_000)
    # It looks like one that was held up for 12 s, but its beacons are others.
    assert clocked(telemetry, 2000, 23.0, beacon=900_000_000) == 0
    assert clocked(telemetry, 3000, 24.5, beacon=900_000_001) == pytest.approx(0.5, abs=0.001)
    assert clocked(telemetry, 100, 25.0, beacon=900_000_002) == 0


def test_everything_is_stale_before_a_second_of_silence_is_over():
    telemetry = told()
    assert not telemetry.is_stale("orientation", 100.5)
    assert not telemetry.is_stale("battery", 100.5)
    for reading in ("orientation", "rx", "location", "battery", "never told"):
        assert telemetry.is_stale(reading, 100.95)


@pytest.mark.parametrize(
    ("reading", "fresh_ms", "stale_ms"),
    [("orientation", 500, 950), ("location", 1100, 2000), ("battery", 60000, 130000)],
)
def test_a_dead_source_on_a_live_aircraft_is_stale(reading, fresh_ms, stale_ms):
    assert not told(frame(age_ms={reading: fresh_ms})).is_stale(reading, 100)
    assert told(frame(age_ms={reading: stale_ms})).is_stale(reading, 100)


def test_frames_that_did_not_come_are_counted():
    telemetry = told(beacon=10)
    for beacon in (11, 14, 5, 6, 5000):
        telemetry.update(GeneralMessage(NAME, {}, None, beacon), 101)
    assert (telemetry.frames, telemetry.lost, telemetry.beacon) == (6, 2, 5000)


def test_the_rate_is_measured_and_falls_in_silence():
    telemetry = Telemetry()
    for place in range(21):
        telemetry.update(GeneralMessage(NAME, {}), place / 10)
    assert telemetry.rate_hz(2.0) == pytest.approx(10)
    assert telemetry.rate_hz(4.0) == pytest.approx(5)
    assert telemetry.rate_hz(20.0) is None


def test_another_message_is_no_telemetry():
    telemetry = Telemetry()
    assert not telemetry.update(GeneralMessage("up.system.state"), 1)
    assert telemetry.frames == 0


def test_a_field_of_a_wrong_type_is_not_known():
    data = {"a": "1", "b": True, "c": [1], "d": 1e300, "e": 10**19, "f": {"g": None}, "h": float}
    telemetry = told(data)
    for path in (*("abcdeh"), "zz"):
        assert telemetry.number(path) is None
    assert telemetry.number("f", "g", "h") is None
    assert telemetry.number("a", "b") is None
    assert telemetry.flag("a") is None
    assert telemetry.flag("b") is True
    assert telemetry.text("b") is None
    assert telemetry.texts("a") is None
    assert told({"v": ["x\x1b", 1, "y"]}).texts("v") == ["x\\x1b", "y"]


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=20),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=8), inner),
    max_leaves=10,
)


@settings(deadline=None)
@given(st.dictionaries(st.sampled_from(["age_ms", "source", "a"]), JSON))
def test_no_data_break_it(data):
    telemetry = told(data)
    telemetry.is_stale("a", 101)
    telemetry.text("source", "a")
    telemetry.number("a", "b")

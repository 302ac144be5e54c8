"""What happened in a flight, at any moment of it."""

import pytest

from tests.ground.replay.flight import LENGTH_S, write_flight
from up.flight_log.flight_log import FlightLog
from up_ground.replay.story import Story


@pytest.fixture(scope="module")
def story(tmp_path_factory):
    path = write_flight(tmp_path_factory.mktemp("story") / "flight.mcap")
    return Story(FlightLog.read([path]), "kite")


def texts(events):
    return [each["text"] for each in events]


def test_events_up_to_a_moment_have_their_age_then(story):
    assert texts(story.events_until(4.0)) == []
    (event,) = story.events_until(8.0)
    assert (event["text"], event["age_ms"]) == ("armed", 3000)


def test_the_same_judge_tells_it(story):
    told = texts(story.events_until(LENGTH_S))
    for text in (
        "armed",
        "failsafe: the board flies without a receiver",
        "mark: thermal \\x1b[2J",
        "disarmed",
    ):
        assert text in told
    numbers = [each["number"] for each in story.events_until(LENGTH_S)]
    assert numbers == sorted(numbers)


def test_a_span_has_what_happened_in_it(story):
    assert texts(story.events_between(4.9, 5.1)) == ["armed"]
    assert story.events_between(5.1, 9.9) == []


def test_alarms_of_a_moment(story):
    def kinds(time_s):
        return [each["kind"] for each in story.alarms_at(time_s)["active"]]

    assert kinds(9.9) == []
    assert kinds(11.0) == ["failsafe"]
    assert kinds(14.5) == []
    assert kinds(28.0) == []


def test_the_track_grows(story):
    early, late = (story.track_until(each)["points"] for each in (5.0, LENGTH_S))
    assert 3 < len(early) < len(late)
    assert late[: len(early)] == early
    assert story.home is not None


def test_a_long_silence_is_told(tmp_path):
    path = write_flight(tmp_path / "flight.mcap", length_s=40.0, gap=(13.0, 38.0))
    story = Story(FlightLog.read([path]), "kite")
    told = texts(story.events_until(40.0))
    assert told.index("no telemetry any more") < told.index("telemetry comes again")
    assert [each["kind"] for each in story.alarms_at(35.0)["active"]] == ["silent"]

import pytest

from tests.flightlog.logs import LogMaker
from tests.ground.replay.flight import LENGTH_S, data_at, write_flight
from up_flightlog.read.flight_log import FlightLog
from up_ground.replay.timeline import ReplayTimeline, Reported


@pytest.fixture(scope="module")
def timeline(tmp_path_factory):
    path = write_flight(tmp_path_factory.mktemp("timeline") / "flight.mcap")
    return ReplayTimeline(FlightLog.read([path]), "kite")


def codes(events):
    return [each["code"] for each in events]


def test_events_up_to_a_moment_have_their_age_then(timeline):
    assert codes(timeline.events_until(4.0)) == []
    (event,) = timeline.events_until(8.0)
    assert (event["code"], event["age_ms"]) == ("armed", 3000)


def test_the_same_judge_tells_it(timeline):
    told = codes(timeline.events_until(LENGTH_S))
    assert told == ["armed", "failsafe", "failsafe_over", "mark", "disarmed"]
    (mark,) = (each for each in timeline.events if each["code"] == "mark")
    assert mark["fields"] == {"text": "thermal \\x1b[2J"}
    numbers = [each["number"] for each in timeline.events_until(LENGTH_S)]
    assert numbers == sorted(numbers)


def test_a_span_has_what_happened_in_it(timeline):
    assert codes(timeline.events_between(4.9, 5.1)) == ["armed"]
    assert timeline.events_between(5.1, 9.9) == []


def test_alarms_of_a_moment(timeline):
    def kinds(time_s):
        return [each["kind"] for each in timeline.alarms_at(time_s)["active"]]

    assert kinds(9.9) == []
    assert kinds(11.0) == ["failsafe"]
    assert kinds(14.5) == []
    assert kinds(28.0) == []


def test_the_track_grows(timeline):
    early, late = (timeline.track_until(each)["points"] for each in (5.0, LENGTH_S))
    assert 3 < len(early) < len(late)
    assert late[: len(early)] == early
    assert timeline.home is not None


def test_a_long_silence_is_told(tmp_path):
    path = write_flight(tmp_path / "flight.mcap", length_s=40.0, gap=(13.0, 38.0))
    timeline = ReplayTimeline(FlightLog.read([path]), "kite")
    told = codes(timeline.events_until(40.0))
    assert told.index("silent") < told.index("heard")
    assert [each["kind"] for each in timeline.alarms_at(35.0)["active"]] == ["silent"]


def test_a_silence_begins_with_the_last_frame_before_it(tmp_path):
    path = write_flight(tmp_path / "flight.mcap", gap=(13.0, 19.0))
    timeline = ReplayTimeline(FlightLog.read([path]), "kite")
    # A telemetry listener, and nothing else in the log: no event is made up.
    assert timeline.frame_time_s(17.0) == pytest.approx(13.0)
    assert [each["kind"] for each in timeline.alarms_at(14.1)["active"]] == ["silent"]
    assert [each["kind"] for each in timeline.alarms_at(17.0)["active"]] == ["silent"]
    assert timeline.frame_time_s(19.05) == pytest.approx(19.0)
    assert timeline.frame_time_s(-1.0) is None


def test_what_is_over_when_the_log_ends_is_no_alarm_for_ever(tmp_path):
    path = write_flight(tmp_path / "flight.mcap", length_s=13.0)
    timeline = ReplayTimeline(FlightLog.read([path]), "kite")
    assert [each["kind"] for each in timeline.alarms_at(11.9)["active"]] == ["failsafe"]
    assert timeline.alarms_at(13.0)["active"] == []
    path = write_flight(tmp_path / "flight.mcap", length_s=11.0)
    timeline = ReplayTimeline(FlightLog.read([path]), "kite")
    assert [each["kind"] for each in timeline.alarms_at(11.0)["active"]] == ["failsafe"]


def test_the_gains_that_flew_at_a_moment(tmp_path):
    def gains(p):
        return {"ratePIDs": {"ailerons": {"p": p, "i": 0, "d": 0}}}

    maker = LogMaker()
    maker.add(0.0, "up.telemetry.update", **data_at(0.0))
    maker.add(1.0, "arduino.pids.values", **gains(2), _origin="arduino (board)")
    maker.add(2.0, "arduino.pids.values", **gains(3), _origin="arduino (board)")
    (tmp_path / "flight.mcap").write_bytes(maker.finished())
    timeline = ReplayTimeline(FlightLog.read([tmp_path / "flight.mcap"]), "kite")
    told = [timeline.gains_at(time_s) for time_s in (0.5, 1.5, 2.5)]
    assert told == [None, Reported(1.0, gains(2)), Reported(2.0, gains(3))]


def test_gains_that_the_board_never_told_are_those_that_were_asked_for(tmp_path):
    pids = {"ratePIDs": {"ailerons": {"p": 4, "i": 0, "d": 0}}}
    maker = LogMaker()
    maker.add(0.0, "up.telemetry.update", **data_at(0.0))
    maker.add(1.0, "arduino.pids.tunings", request=True)
    maker.add(2.0, "arduino.pids.tunings", pids=pids, _origin="mission_control (pilot)")
    maker.add(3.0, "arduino.profile.values", switch={"low": "ACRO"}, _origin="arduino (board)")
    (tmp_path / "flight.mcap").write_bytes(maker.finished())
    timeline = ReplayTimeline(FlightLog.read([tmp_path / "flight.mcap"]), "kite")
    assert [timeline.gains_at(time_s) for time_s in (1.5, 2.5)] == [None, Reported(2.0, pids)]
    assert timeline.profile_at(2.9) is None
    assert timeline.profile_at(3.0).values == {"switch": {"low": "ACRO"}}


def test_an_alarm_is_over_when_its_cause_is(timeline):
    assert [each["kind"] for each in timeline.alarms_at(11.95)["active"]] == ["failsafe"]
    assert timeline.alarms_at(12.1)["active"] == []


def test_events_tell_the_flights_time_and_stand_in_its_order(tmp_path):
    maker = LogMaker()
    for number in range(81):
        time_s = number / 10 if number <= 40 else number / 10 + 6
        maker.add(time_s, "up.telemetry.update", **data_at(time_s))
        if number == 40:
            maker.add(5.5, "black_box.mark", text="in the silence")
    (tmp_path / "flight.mcap").write_bytes(maker.finished())
    timeline = ReplayTimeline(FlightLog.read([tmp_path / "flight.mcap"]), "kite")
    events = timeline.events_until(20.0)
    times_s = [each["time_s"] for each in events]
    assert times_s == sorted(times_s)
    assert dict(zip(codes(events), times_s, strict=True))["mark"] == 5.5
    assert codes(events).index("silent") < codes(events).index("mark")


def test_what_never_was_there_is_not_gone(tmp_path):
    maker = LogMaker()
    for number in range(100):
        data = data_at(0.0)
        there = number >= 50
        data["arduino"]["connected"] = data["android"]["connected"] = there
        if not there:
            data["age_ms"] = dict.fromkeys(data["age_ms"])
        maker.add(number / 10, "up.telemetry.update", **data)
    (tmp_path / "flight.mcap").write_bytes(maker.finished())
    timeline = ReplayTimeline(FlightLog.read([tmp_path / "flight.mcap"]), "kite")
    told = {each["code"]: each["level"] for each in timeline.events_until(10.0)}
    assert told["board_awaited"] == told["phone_awaited"] == "info"
    assert {"board_connected", "phone_connected"} <= set(told)
    assert not {"board_lost", "phone_lost"} & set(told)
    (alarm,) = timeline.alarms_at(2.0)["active"]
    assert (alarm["level"], alarm["code"]) == ("warning", "board_awaited")

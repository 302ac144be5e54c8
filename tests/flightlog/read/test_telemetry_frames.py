import json
from itertools import pairwise

import pytest

from tests.flightlog.flights import (
    ALL_VALID,
    BOARD,
    FAILSAFE,
    GOOD,
    GROUND,
    PHONE,
    AltitudeCommand,
    AndroidBatteryCommand,
    FlightMaker,
    FlightStateCommand,
    HeadingCommand,
    LinkStateCommand,
    LocationCommand,
    OrientationCommand,
    PanicCommand,
    RXCommand,
    ServoCommand,
    SystemStateCommand,
    TelemetryCommand,
    status,
)
from tests.up.flight_log.test_command_schema import fault_of
from up.commands.board_schema import VETOES
from up.earth import bearing_deg, distance_m
from up.flight_log.command_schema import schema_of
from up_flightlog.read.frame_state import PLACE, TOPICS
from up_flightlog.read.telemetry_frames import Frame, frames


def attitude(roll: float) -> OrientationCommand:
    return OrientationCommand(roll, 2.0, 3.0, 4.0, 5.0, 6.0, 7)


def test_logged_telemetry_is_given_as_it_was(tmp_path):
    maker = FlightMaker()
    maker.every(0, 2, 0.1, lambda time_s: TelemetryCommand({"armed": time_s > 1}, 40), GROUND)
    maker.every(0, 2, 0.05, attitude(9))
    given = list(frames(maker.log(tmp_path)))
    assert len(given) == 20
    assert given[0] == Frame(0.0, {"armed": False}, 40)
    assert given[-1].data == {"armed": True}
    assert [frame.time_s for frame in given] == pytest.approx([0.1 * n for n in range(20)])


def test_without_telemetry_the_tree_is_put_together(tmp_path):
    maker = FlightMaker()
    maker.put(0, attitude(1.5), BOARD)
    maker.put(0, RXCommand(1, 2, 3, 4, 5, 6, ALL_VALID), BOARD)
    maker.put(0, ServoCommand(11, 12, 13, 14), BOARD)
    maker.put(0, LocationCommand(50.0, 14.0, 300.0, satellites=9), PHONE)
    maker.put(0, AltitudeCommand(301.0), PHONE)
    maker.put(0, AltitudeCommand(400.0, "required"), GROUND)
    maker.put(0, HeadingCommand(-90.0, "actual"), PHONE)
    maker.put(0, HeadingCommand(45.0, "required"), GROUND)
    maker.put(0, FlightStateCommand("FBW", True, False, True), BOARD)
    maker.put(0, AndroidBatteryCommand(81.0), PHONE)
    maker.put(0, LinkStateCommand("android", True))
    maker.put(0, SystemStateCommand(12.5, 30.0, ("UpRXProvider",), True, "flight controller"))
    maker.put(0, PanicCommand(True, 150, 97.0))
    maker.put(0, status(flags=GOOD | FAILSAFE, vetoes=0b1001), BOARD)
    maker.put(0.5, attitude(2.5), BOARD)
    maker.put(0.5, LocationCommand(50.001, 14.0, 310.0), PHONE)
    maker.put(1.0, attitude(3.5), BOARD)
    given = list(frames(maker.log(tmp_path), period_s=0.25))
    assert [frame.time_s for frame in given] == [0.0, 0.25, 0.5, 0.75, 1.0]
    first, fourth = given[0].data, given[3].data
    assert first["orientation"] == {"yaw": 3.0, "pitch": 2.0, "roll": 1.5}
    assert first["rates"] == {"yaw": 6.0, "pitch": 5.0, "roll": 4.0}
    assert list(first["rx"].values()) == [1, 2, 3, 4, 5, 6]
    assert list(first["rx"]) == ["ailerons", "elevator", "throttle", "rudder", "aux1", "aux2"]
    assert list(first["servo"].values()) == [11, 12, 13, 14]
    assert first["location"] == {
        "latitude": 50.0, "longitude": 14.0, "altitude": 300.0, "satellites": 9,
        "accuracy": None, "fix": None, "pdop": None,
    }  # fmt: skip
    assert first["home"] == {"distance": 0.0, "bearing": 0.0}
    assert first["altitude"] == 301.0
    assert first["heading"] == {"actual": 270.0, "required": 45.0}
    assert (first["flight_mode"], first["armed"]) == ("FBW", True)
    assert first["android"] == {"batteryLevel": 81.0, "connected": True}
    assert first["load"] == {"cpu": 12.5, "ram": 30.0, "panic": True, "delay_ms": 150}
    assert first["mode"] == "flight controller"
    assert first["system"] == {"providers": ["UpRXProvider"]}
    assert first["arduino"]["connected"] is True
    assert first["arduino"]["failsafe"] is True
    assert first["arduino"]["switch"] == "middle"
    assert first["arduino"]["reset_cause"] == "power-on"
    assert first["vetoes"] == [f"arduino: {VETOES[bit]}" for bit in (0, 3)]
    assert fourth["orientation"]["roll"] == 2.5
    assert fourth["home"] == {
        "distance": distance_m(50.001, 14.0, 50.0, 14.0),
        "bearing": bearing_deg(50.001, 14.0, 50.0, 14.0),
    }
    assert fourth["age_ms"] == {
        "orientation": 250,
        "rx": 750,
        "servo": 750,
        "flight": 750,
        "location": 250,
        "altitude": 750,
        "heading": 750,
        "battery": 750,
        "navigation": None,
    }
    assert fourth["source"]["orientation"] == "arduino"
    assert fourth["source"]["battery"] == "android"
    # Later telemetry does not change a frame that was given out.
    assert first["orientation"]["roll"] == 1.5
    assert first["home"]["distance"] == 0.0
    json.dumps([frame.data for frame in given], allow_nan=False)


def test_frames_match_the_schema_of_telemetry(tmp_path):
    maker = FlightMaker()
    maker.quiet_flight()
    maker.put(1, AltitudeCommand(301.0), PHONE)
    maker.put(1, AndroidBatteryCommand(81.0), PHONE)
    maker.put(1, SystemStateCommand(12.5, 30.0, ("UpRXProvider",), True, "flight controller"))
    schema = schema_of(TelemetryCommand)
    given = list(frames(maker.log(tmp_path)))
    assert len(given) > 100
    for frame in given:
        assert fault_of(frame.data, schema) == ""
        assert frame.data.keys() <= schema["properties"].keys()
        assert frame.data["age_ms"].keys() == schema["properties"]["age_ms"]["properties"].keys()


def test_unknown_values_are_null_or_absent(tmp_path):
    maker = FlightMaker()
    maker.put(0, attitude(1.0), BOARD)
    (frame,) = frames(maker.log(tmp_path))
    assert frame.data["location"] == dict.fromkeys(PLACE)
    assert frame.data["altitude"] is frame.data["armed"] is frame.data["flight_mode"] is None
    assert "rx" not in frame.data
    assert frame.data["age_ms"]["location"] is None
    assert frame.beacon is None


def test_the_boards_attitude_wins_while_it_is_fresh(tmp_path):
    maker = FlightMaker()
    maker.every(0.0, 4.0, 0.1, attitude(10.0), PHONE)
    maker.every(0.0, 2.0, 0.1, attitude(20.0), BOARD)
    given = {round(f.time_s, 1): f.data for f in frames(maker.log(tmp_path))}
    assert given[1.5]["orientation"]["roll"] == 20.0
    assert given[1.5]["source"]["orientation"] == "arduino"
    assert given[2.2]["orientation"]["roll"] == 20.0
    assert given[2.2]["age_ms"]["orientation"] == pytest.approx(300, abs=2)
    assert given[2.8]["orientation"]["roll"] == 10.0
    assert given[2.8]["source"]["orientation"] == "android"


def test_a_gap_in_telemetry_is_filled_from_the_commands(tmp_path):
    # Telemetry had no receiver while the link to the ground was away.
    maker = FlightMaker()
    tree = {
        "orientation": {"roll": 1.0},
        "load": {"cpu": 33.0},
        "age_ms": {"orientation": 10, "battery": 5000},
        "source": {"battery": "android"},
    }
    maker.every(0, 1.1, 0.1, TelemetryCommand(tree, 1))
    maker.every(3, 4.1, 0.1, TelemetryCommand(tree, 2))
    maker.every(0, 4, 0.05, lambda time_s: attitude(100 * time_s), BOARD)
    given = list(frames(maker.log(tmp_path)))
    times_s = [frame.time_s for frame in given]
    assert times_s == sorted(times_s)
    assert max(b - a for a, b in pairwise(times_s)) < 0.501
    made = [frame for frame in given if frame.beacon is None]
    assert 1.4 < made[0].time_s < 1.6
    assert 2.8 < made[-1].time_s < 3.0
    assert len(made) == pytest.approx(15, abs=1)
    for frame in made:
        assert frame.data["orientation"]["roll"] == pytest.approx(100 * frame.time_s, abs=6)
        assert frame.data["age_ms"]["orientation"] <= 51
        assert frame.data["load"] == {"cpu": 33.0}
        # A value without new Commands grows old.
        assert frame.data["age_ms"]["battery"] == pytest.approx(4000 + 1000 * frame.time_s, abs=2)
        assert frame.data["source"]["battery"] == "android"


def test_a_flight_may_be_entered_later(tmp_path):
    maker = FlightMaker()
    maker.put(0, LocationCommand(50.0, 14.0, 300.0), PHONE)
    maker.every(0, 30, 0.1, lambda time_s: attitude(time_s), BOARD)
    maker.every(0.5, 30, 1.0, LocationCommand(50.01, 14.0, 300.0), PHONE)
    log = maker.log(tmp_path)
    everything = list(frames(log))
    late = list(frames(log, since_s=25.0))
    assert late[0].time_s >= 25.0
    assert late[-1].time_s == pytest.approx(everything[-1].time_s, abs=0.11)
    assert len(late) == pytest.approx(50, abs=2)
    # Home is the flight's first place, not the first one after the jump.
    assert late[0].data["home"]["distance"] > 1000
    assert late[0].data["orientation"]["roll"] == pytest.approx(25.0, abs=0.11)
    assert list(frames(log, since_s=99.0)) == []


def test_a_gap_in_everything_is_jumped_over(tmp_path):
    maker = FlightMaker()
    maker.put(0, attitude(1.0), BOARD)
    maker.put(400 * 365 * 86400.0, attitude(2.0), BOARD)
    given = list(frames(maker.log(tmp_path)))
    assert len(given) < 25
    assert given[-2].time_s < 1.6
    assert given[-2].data["age_ms"]["orientation"] > 1300
    assert given[-1].data["orientation"]["roll"] == 2.0


def test_strange_messages_make_no_fault(tmp_path):
    maker = FlightMaker()
    nonsense = [None, True, "x", [1], {"a": 1}, 10**30, -1]
    for topic in (*TOPICS, "up.telemetry.update"):
        for number, value in enumerate(nonsense):
            keys = ("roll", "latitude", "longitude", "heading", "mode", "link", "flags", "switch")
            more = ("age_ms", "source", "arduino", "load", "_origin", "_beacon", "vetoes")
            maker.add(number, topic, **dict.fromkeys(keys + more, value))
        maker.add(9, topic)
    log = maker.log(tmp_path)
    given = list(frames(log))
    assert len(given) >= 8
    json.dumps([frame.data for frame in given], allow_nan=False)


def test_an_empty_log_has_no_frames(tmp_path):
    assert list(frames(FlightMaker().log(tmp_path))) == []

"""A scenario's flight log by the official reader: its content, and its reproducibility."""

import errno
import json
import math
from itertools import pairwise
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mcap.reader import make_reader

from tests.simulator.scenario.minimal import log_of, scenario
from tests.support.firmware import build_firmware
from up_flightlog.findings.all_checks import findings
from up_flightlog.findings.flight_context import FlightContext
from up_flightlog.read.flight_log import FlightLog
from up_flightlog.read.telemetry_frames import frames
from up_simulator.cli import main
from up_simulator.scenario.event import CommandPart, Event
from up_simulator.scenario.expectation import Verdict
from up_simulator.scenario.flight_mcap import BEGIN_NS, write_flight
from up_simulator.scenario.flight_record import FlightRecord, PendingCommand
from up_simulator.scenario.result import Result
from up_simulator.scenario.sampler import columns_of

FLOWN = """\
title: Flown
duration_s: 4
weather: {wind_m_s: 5, wind_from_deg: 270}
sticks: [{at_s: 0, mode: FBW, arm: true, throttle: 0.5}, {at_s: 1, ailerons: 0.6}]
events: [{at_s: 2, mark: halfway}, {at_s: 2.5, receiver: lost}]
expect: [{name: It flies, signal: truth.height_m, above: 50}]
"""
PHONE = "raspilot: {runs: in process}\nphone: {}\nground: {}\n"


class Read:
    """The official reader's findings in a file."""

    def __init__(self, path):
        with path.open("rb") as file:
            reader = make_reader(file, validate_crcs=True)
            self.messages = {}
            self.schemas = {}
            for schema, channel, message in reader.iter_messages():
                time_s = (message.log_time - BEGIN_NS) / 1e9
                self.schemas[channel.topic] = (schema.name, json.loads(schema.data))
                found = self.messages.setdefault(channel.topic, [])
                found.append((time_s, json.loads(message.data)))
            self.metadata = {each.name: each.metadata for each in reader.iter_metadata()}
            self.attachments = {each.name: each.data for each in reader.iter_attachments()}

    def series(self, topic, field):
        return [data[field] for _, data in self.messages[topic]]


def read(tmp_path, columns, text="", **record):
    flown = FlightRecord(scenario(text), log_of(columns, 100), **record)
    path = tmp_path / "flight.mcap"
    write_flight("made-up", Result(flown, [Verdict("It holds", True, "3 deg", "at most 4")]), path)
    return Read(path)


@pytest.fixture(scope="module")
def flown(tmp_path_factory):
    build_firmware()
    folder = tmp_path_factory.mktemp("flown")
    (folder / "flown.yml").write_text(FLOWN)
    for output in ("first", "second"):
        words = ["fly", str(folder / "flown.yml"), "--no-picture", "--quiet"]
        assert main([*words, "--output", str(folder / output)]) == 0
    return folder


def test_the_same_flight_gives_the_same_file(flown):
    first, second = (flown / name / "flown/flight.mcap" for name in ("first", "second"))
    assert first.read_bytes() == second.read_bytes()


def test_estimate_and_truth_have_equal_times(flown):
    log = Read(flown / "first/flown/flight.mcap")
    truth = dict(log.messages["simulator.truth"])
    told = log.messages["up.orientation.update"]
    assert len(truth) == 201
    # Those that arrive between two samples of 20 ms: some get none, some two.
    assert len(told) > 150
    assert max(abs(data["roll"]) for _, data in told) > 20
    assert max(abs(data["roll"] - truth[time_s]["roll_deg"]) for time_s, data in told) < 3
    name, schema = log.schemas["up.orientation.update"]
    assert name == "up.orientation.update"
    assert schema["properties"]["roll"]["x-unit"] == "deg"
    units = log.schemas["simulator.truth"][1]["properties"]
    assert units["wind_east_m_s"]["x-unit"] == "m/s"
    assert log.series("simulator.truth", "wind_east_m_s")[-1] == pytest.approx(5.0, abs=0.01)


def test_a_lost_receiver_is_logged_as_the_board_reports_it(flown):
    log = Read(flown / "first/flown/flight.mcap")
    assert log.series("up.rx.update", "valid")[0] == 63
    assert log.series("up.rx.update", "valid")[-1] == 0
    states = log.messages["up.flight.state"]
    assert not states[0][1]["failsafe"] and states[0][1]["flight_mode"] == "FBW"
    statuses = log.messages["arduino.status"]
    assert 15 <= len(statuses) <= 23, "five a second"
    assert all(data["mode"] == ord("f") and data["flags"] & 0b1001 for _, data in statuses)
    assert not any(data["flags"] & 128 for _, data in statuses), "no Raspberry Pi is aboard"
    assert [bool(statuses[at][1]["flags"] & 4) for at in (0, -1)] == [True, False]
    assert "vetoes" not in statuses[0][1]
    first_s = next(time_s for time_s, data in states if data["failsafe"])
    assert 2.5 < first_s < 3.2
    events = [(round(time_s, 3), data["event"]) for time_s, data in log.messages["simulator.event"]]
    assert events == [(2.0, "halfway"), (2.5, "receiver lost")]
    assert any("halfway" in text for text in log.series("log", "message"))
    assert log.schemas["log"][0] == "foxglove.Log"


def test_metadata_name_aircraft_scenario_and_verdicts(flown):
    log = Read(flown / "first/flown/flight.mcap")
    assert log.metadata["flight"]["aircraft"] == "glider"
    assert log.metadata["scenario"]["title"] == "Flown"
    assert log.metadata["verdicts"]["It flies"].startswith("held: ")
    assert b"units: degrees per second" in log.attachments["config/pids.yml"]


def test_the_flight_log_finds_failures_and_telemetry_in_it(flown):
    log = FlightLog.read([flown / "first/flown/flight.mcap"])
    assert {"receiver_lost", "failsafe"} <= {finding.code for finding in findings(log)}
    assert [each.axis for each in FlightContext(log).estimate_errors] == ["roll", "pitch"]
    newest = list(frames(log))[-1].data
    assert newest["flight_mode"] and newest["arduino"]["failsafe"] is True
    assert newest["location"]["latitude"] == pytest.approx(50.0, abs=0.01)
    assert newest["source"]["orientation"] == "arduino"


def test_without_a_phone_the_position_is_the_true_one_by_its_origin(flown):
    log = Read(flown / "first/flown/flight.mcap")
    places = log.messages["up.location.update"]
    assert len(places) == 21
    truth = dict(log.messages["simulator.truth"])
    for time_s, data in places:
        assert data["latitude"] == truth[time_s]["latitude_deg"]
        assert data["_origin"] == "simulator (sensor)"


def test_with_a_phone_the_position_is_measured(tmp_path):
    columns = {
        "truth.latitude_deg": lambda _: 1.0,
        "truth.longitude_deg": lambda _: 2.0,
        "ground.frames": lambda time_s: round(time_s, 3) // 0.5,
        "ground.location.latitude": lambda time_s: None if time_s < 0.7 else 50.0,
        "ground.location.longitude": lambda _: 14.5,
        "ground.age_ms.location": lambda time_s: 30.0 if time_s < 1.4 else 530.0,
        "ground.android.batteryLevel": lambda _: 90.0,
        "ground.age_ms.battery": lambda time_s: 1000 * time_s,
        "ground.android.connected": lambda time_s: time_s < 1.2,
        "ground.load.panic": lambda time_s: time_s > 0.6,
        "ground.load.delay_ms": lambda time_s: 300.0 if time_s > 0.6 else 20.0,
    }
    log = read(tmp_path, columns, PHONE)
    places = log.messages["up.location.update"]
    assert [round(time_s, 2) for time_s, _ in places] == [1.0], "at 1.5 s it is an old one"
    assert all(data["latitude"] == 50.0 for _, data in places)
    assert all(data["_origin"] == "android (sensor)" for _, data in places)
    assert log.series("android.battery", "level") == [90]
    links = [(data["link"], data["connected"]) for _, data in log.messages["up.link.state"]]
    assert links == [("android", True), ("android", False)]
    assert log.series("up.panic", "delay_ms") == [20, 300]


def test_a_silent_board_leaves_a_gap(tmp_path):
    def age_s(time_s):
        return 0.005 if time_s < 0.5 or time_s > 1.5 else time_s - 0.495

    columns = {"board.orientation_age_s": age_s}
    for axis in ("roll", "pitch", "yaw"):
        columns[f"board.{axis}_deg"] = columns[f"board.{axis}_rate_deg_s"] = lambda _: 1.0
    times_s = [time_s for time_s, _ in read(tmp_path, columns).messages["up.orientation.update"]]
    gaps = [later - earlier for earlier, later in pairwise(times_s)]
    assert max(gaps) == pytest.approx(1.04, abs=0.021)
    assert sorted(gaps)[-2] < 0.021


def test_only_executed_commands_of_the_ground_are_logged(tmp_path):
    def asked(name, at_s, answer):
        command = CommandPart(name, {"mode": "FBW"})
        return PendingCommand(Event(at_s=at_s, command=command), command, "1", at_s, answer)

    pending_commands = [asked("up.flight_mode.set", 0.5, ""), asked("up.arm", 0.2, "forbidden")]
    log = read(
        tmp_path, {"truth.roll_deg": lambda _: 0.0}, PHONE, pending_commands=pending_commands
    )
    ((time_s, data),) = log.messages["up.flight_mode.set"]
    assert (round(time_s, 6), data) == (0.5, {"mode": "FBW", "_origin": "ground (pilot)"})
    assert "up.arm" not in log.messages
    (refused,) = log.series("log", "message")
    assert "up.arm" in refused and "forbidden" in refused


def test_the_end_of_the_flight_is_the_last_log_entry(tmp_path):
    columns = {"truth.roll_deg": lambda _: 0.0}
    log = read(tmp_path, columns, crash="crash", failure="failure")
    assert [(data["level"], data["message"]) for _, data in log.messages["log"]] == [
        (4, "failure"),
        (4, "crash"),
    ]


NUMBERS = st.floats() | st.none()
FLOWN_WITH_ALL = scenario(PHONE)


@given(st.lists(st.tuples(NUMBERS, NUMBERS, st.text(max_size=5)), min_size=1, max_size=4))
def test_any_signals_give_a_valid_file(tmp_path_factory, rows):
    path = tmp_path_factory.mktemp("any") / "flight.mcap"
    columns = columns_of(FLOWN_WITH_ALL)
    made = log_of({name: [None] for name in columns if name not in ("time_s", "event")}, 1)
    for at, (first, second, word) in enumerate(rows):
        values = {name: (first, second)[index % 2] for index, name in enumerate(columns)}
        words = {name: word for name in columns if made.has_text(name)}
        made.append({**values, **words, "time_s": 0.02 * (at + 1)})
    write_flight("any", Result(FlightRecord(FLOWN_WITH_ALL, made), []), path)
    log = Read(path)
    assert len(log.messages["simulator.truth"]) == len(rows) + 1
    assert all(math.isfinite(time_s) for each in log.messages.values() for time_s, _ in each)


def test_a_full_disk_is_an_os_error():
    flown = FlightRecord(scenario(), log_of({"truth.roll_deg": lambda _: 0.0}, 5))
    with pytest.raises(OSError) as caught:
        write_flight("full", Result(flown, []), Path("/dev/full"))
    assert caught.value.errno == errno.ENOSPC

"""The flight log of the whole system, read by the official reader: whole after a stop, readable
to its last second after ``kill -9``."""

import json
import os
import signal
import struct
from bisect import bisect_left

import pytest
from mcap.exceptions import McapError
from mcap.reader import make_reader
from mcap.records import Attachment, Channel, Message, Metadata
from mcap.stream_reader import StreamReader

from tests.support.firmware import build_firmware
from tests.support.showcase import Showcase
from tests.support.waiting import DEADLINE_S, until

FLOWN_S = 8.0
LOST_S = 1.0
OFF_DEG = 2.0
MEANWHILE_S = 0.1
"""How late one of two processes may be heard on a busy machine."""


class Log:
    """All that the official package finds in a file, from its beginning until it is cut off."""

    def __init__(self, path):
        self.messages = {}
        self.metadata = {}
        self.attachments = {}
        self.is_cut = False
        topics = {}
        with path.open("rb") as file:
            records = StreamReader(file, validate_crcs=True).records
            while True:
                try:
                    record = next(records)
                except StopIteration:
                    break
                except (McapError, struct.error):
                    # A cut in the middle of a number is a struct.error to it.
                    self.is_cut = True
                    break
                if isinstance(record, Channel):
                    topics[record.id] = record.topic
                elif isinstance(record, Message):
                    found = self.messages.setdefault(topics[record.channel_id], [])
                    found.append((record.log_time / 1e9, json.loads(record.data)))
                elif isinstance(record, Metadata):
                    self.metadata[record.name] = record.metadata
                elif isinstance(record, Attachment):
                    self.attachments[record.name] = record.data

    def series(self, topic, field):
        return [(time_s, data[field]) for time_s, data in self.messages[topic]]


class Flight:
    """A run whose daemon was killed in the air; the state a moment before."""

    def __init__(self, folder):
        self.showcase = showcase = Showcase(folder).ready()
        sent = showcase.ground("send", "up.telemetry.frequency", "frequency=200")
        assert sent.returncode == 0, sent.stderr
        until(lambda: float(showcase.truth()[-1]["time_s"]) > FLOWN_S, "it has flown for a while")
        self.killed_s = float(showcase.truth()[-1]["time_s"])
        os.kill(showcase.daemon_pid(), signal.SIGKILL)
        until(lambda: "signal 9" in showcase.said(), "the demo sees that it was killed")
        # The daemon that is started again records into the next file.
        self.log = Log(min((folder / "flights").glob("*.mcap")))
        assert showcase.stop(signal.SIGTERM) == 0


@pytest.fixture(scope="module")
def flight(tmp_path_factory):
    build_firmware()
    return Flight(tmp_path_factory.mktemp("log"))


def test_a_daemon_that_is_killed_leaves_a_log_to_its_last_second(flight):
    """What the state log had when the daemon died, by the flight's own time.

    The truth has that time; what it is now and then told by is slowed in Panic Mode, and what the
    board says never.
    """
    assert "signal 9" in flight.showcase.said()
    assert flight.log.is_cut, "it was not finished"
    for topic in ("simulator.truth", "up.orientation.update", "up.servo.update"):
        times_s = [time_s for time_s, _ in flight.log.messages[topic]]
        assert times_s == sorted(times_s)
    logged_s, flown_s = flight.log.series("simulator.truth", "time_s")[-1]
    for topic in ("up.orientation.update", "up.servo.update", "up.rx.update"):
        newest_s = flown_s + flight.log.messages[topic][-1][0] - logged_s
        assert flight.killed_s - newest_s < LOST_S, (topic, flight.killed_s, newest_s)


def test_commands_and_outputs_are_in_it_with_their_origins(flight):
    messages = flight.log.messages
    for topic, origin in (
        ("up.orientation.update", "arduino (board)"),
        ("up.servo.update", "arduino (board)"),
        ("up.rx.update", "arduino (board)"),
        ("up.location.update", "android (sensor)"),
    ):
        assert {data["_origin"] for _, data in messages[topic]} == {origin}, topic
    assert len({data["ailerons"] for _, data in messages["up.servo.update"]}) > 5
    assert all(1000 <= data["throttle"] <= 2000 for _, data in messages["up.servo.update"])
    (sent,) = messages["up.telemetry.frequency"]
    assert sent[1]["frequency"] == 200 and "pilot" in sent[1]["_origin"]
    assert messages["up.flight.state"][-1][1]["flight_mode"] == "FBW"
    assert len(messages["up.telemetry.update"]) > 3
    assert "board_connected" in {data.get("code") for _, data in messages["log"]}


def test_the_truth_is_beside_the_estimate(flight):
    """At equal times of the log the firmware reported the true roll; Panic limits their number."""
    truth = flight.log.series("simulator.truth", "roll_deg")
    told = flight.log.series("up.orientation.update", "roll")
    assert max(abs(roll) for _, roll in truth) > 5, "it banks"
    off_deg = []
    for time_s, roll in truth:
        first, last = (bisect_left(told, (time_s + by_s,)) for by_s in (-MEANWHILE_S, MEANWHILE_S))
        meanwhile = [each for _, each in told[first:last]]
        if meanwhile:
            off_deg.append(max(min(meanwhile) - roll, roll - max(meanwhile), 0.0))
    assert len(off_deg) > 3
    assert sorted(off_deg)[int(0.95 * len(off_deg))] < OFF_DEG


def test_the_configuration_that_flew_is_attached(flight):
    config = flight.showcase.folder / "config"
    for name in ("mission_control.yml", "arduino.yml", "black_box.yml"):
        assert flight.log.attachments[f"config/{name}"] == (config / name).read_bytes()
    assert b"degrees per second" in flight.log.attachments["config/pids.yml"]
    assert flight.log.metadata["flight"]["flight_controller"] == "arduino"
    assert flight.log.metadata["versions"]["arduino_cog"]


def test_a_run_that_is_stopped_leaves_a_whole_log(tmp_path):
    showcase = Showcase(tmp_path, "--no-page", "--seconds", "3")
    assert showcase.process.wait(DEADLINE_S) == 0, showcase.said()
    assert "  page " not in showcase.said()
    (path,) = (tmp_path / "flights").glob("*.mcap")
    with path.open("rb") as file:
        reader = make_reader(file, validate_crcs=True)
        summary = reader.get_summary()
        topics = {channel.topic for channel in summary.channels.values()}
        count = sum(1 for _ in reader.iter_messages())
    assert summary.statistics.message_count == count > 100
    assert {"up.orientation.update", "simulator.truth", "log"} <= topics

import pytest
from black_box_cog import throttle
from black_box_cog.ingest_queue import LogLine, Recorded
from black_box_cog.pre_trigger_buffer import CAPACITY
from black_box_cog.recorder import IDLE_END_S, IDLE_S

from tests.cogs.black_box_cog.flights import (
    BOARD,
    GROUND,
    PHONE,
    START_UNIX_S,
    Flight,
    codes_of,
    lines_in,
    messages,
)
from tests.up.commands.samples import Log
from up.commands.command import BaseCommand
from up.commands.location_command import LocationCommand
from up.commands.origin import INTERNAL
from up.commands.telemetry_commands import TelemetryCommand
from up_flightlog.read.flight_log import FlightLog


@pytest.fixture
def flight(tmp_path):
    return Flight(tmp_path)


class FloodedError(Exception):
    """Raised by a Command that cannot return its data."""


# When it records


@pytest.mark.parametrize("origin", [BOARD, PHONE, GROUND])
def test_a_flight_begins_with_the_first_external_command_and_those_before(flight, origin):
    flight.fly(5, origin=INTERNAL)
    assert flight.files == [] and flight.disk.calls == []
    assert not flight.status.recording and flight.recorder.round_s == IDLE_S
    flight.say(50, origin)
    flight.recorder.work()
    flight.recorder.finish()
    assert flight.numbers == list(range(51))


def test_what_is_held_for_a_flight_is_bounded(flight):
    flight.fly(60, rate_hz=100, origin=INTERNAL)
    flight.say(6000)
    flight.recorder.finish()
    assert flight.numbers == list(range(6001 - CAPACITY, 6001))
    assert flight.status.dropped == 0


def test_a_flight_is_over_when_nothing_comes_and_the_next_has_the_next_number(flight):
    flight.fly(2)
    flight.pass_s(IDLE_END_S - 1)
    flight.recorder.work()
    assert flight.status.recording
    flight.pass_s(2)
    flight.recorder.work()
    assert not flight.status.recording and flight.status.problem is None
    flight.fly(3, origin=INTERNAL)
    assert len(flight.files) == 1
    flight.fly(1)
    flight.recorder.finish()
    assert [path.name for path in flight.files] == [
        "0001-20260814T093000Z-kite.mcap",
        "0002-20260814T094006Z-kite.mcap",
    ]
    assert all(FlightLog.read([path]).is_complete for path in flight.files)


def test_always_records_from_the_start_to_the_end(tmp_path):
    flight = Flight(tmp_path, always=True)
    flight.recorder.work()
    assert flight.status.recording
    flight.pass_s(10 * IDLE_END_S)
    flight.recorder.work()
    assert flight.status.recording


# What a file holds


def test_time_is_the_wall_clock_at_the_start_and_seconds_since(flight):
    flight.fly(2)
    flight.wall_s += 86_400
    flight.fly(2, first=20)
    flight.recorder.finish()
    found = [ns for topic, ns, _ in messages(flight.files[0]) if topic == "up.orientation.update"]
    since = [(ns - START_UNIX_S * 10**9) / 1e9 for ns in found]
    assert since == pytest.approx([number / 10 for number in range(40)], abs=1e-6)


def test_each_jump_of_the_wall_clock_is_reported_once(flight):
    flight.fly(3)
    for jump_s in (86_400, 0, 30, -7200, 0):
        flight.wall_s += jump_s
        flight.fly(3)
    flight.recorder.finish()
    lines = [line for line in lines_in(flight.files[0]) if line.get("code") == "clock_jumped"]
    assert [round(line["fields"]["jump_s"]) for line in lines] == [86400, 79230]


def test_the_configuration_is_attached(flight, tmp_path):
    (tmp_path / "config.yml").write_text("mode: auto\n")
    (tmp_path / "huge.yml").write_text("#" * 300_000)
    (tmp_path / "notes.txt").write_text("no\n")
    (tmp_path / "gone.yml").symlink_to(tmp_path / "nowhere")
    flight.fly(1)
    flight.recorder.finish()
    log = FlightLog.read(flight.files)
    assert list(log.attachments) == ["config/config.yml"]
    assert log.attachments["config/config.yml"].read() == b"mode: auto\n"


def test_places_are_on_the_map_too(flight):
    place = LocationCommand(47.5, 19.25, 120.0, accuracy_m=3.0)
    flight.queue.observe(place, PHONE)
    flight.queue.observe(LocationCommand(47.5, 19.25), PHONE)
    flight.recorder.finish()
    found = [(topic, data) for topic, _, data in messages(flight.files[0])]
    fix, without_altitude = [data for topic, data in found if topic == "/location"]
    assert "altitude" not in without_altitude
    assert (fix["latitude"], fix["longitude"], fix["altitude"]) == (47.5, 19.25, 120.0)
    assert fix["position_covariance"][0] == 9.0
    assert dict(found)["up.location.update"]["_origin"] == "android (sensor)"
    assert FlightLog.read(flight.files).schema("/location")["title"] == "foxglove.LocationFix"


def test_lines_records_and_telemetry_have_their_topics(flight):
    flight.queue.put(LogLine(3, "Uplink", "lost", "link_lost", {"s": 2.5}))
    flight.queue.put(Recorded("companion.air", '{"speed": 12.5}'), PHONE)
    flight.queue.observe(TelemetryCommand({"mode": "auto"}, 9), INTERNAL)
    flight.recorder.finish()
    found = {topic: data for topic, _, data in messages(flight.files[0])}
    assert found["companion.air"] == {"speed": 12.5, "_origin": "android (sensor)"}
    assert found["up.telemetry.update"]["mode"] == "auto"
    line = next(data for topic, _, data in messages(flight.files[0]) if topic == "log")
    assert (line["level"], line["name"], line["message"]) == (3, "Uplink", "lost")
    assert (line["code"], line["fields"]) == ("link_lost", {"s": 2.5})
    assert line["timestamp"] == {"sec": START_UNIX_S, "nsec": 0}


def test_a_command_that_cannot_be_encoded_is_skipped(flight):
    class Broken(BaseCommand):
        NAME = "test.broken"

        @property
        def data(self):
            raise FloodedError

    with Log() as log:
        for number in range(30):
            flight.queue.observe(Broken(), BOARD)
            flight.fly(0.1, first=number)
    flight.recorder.finish()
    assert flight.numbers == list(range(30))
    assert codes_of(log).count("encoding_failed") == 1


# Bounds


def test_a_large_flight_continues_in_parts(tmp_path):
    flight = Flight(tmp_path, file_size_mb=0.02, total_size_mb=100.0)
    flight.fly(40)
    flight.recorder.finish()
    assert [path.name.partition("kite")[2] for path in flight.files] == [
        ".mcap",
        ".2.mcap",
        ".3.mcap",
        ".4.mcap",
    ]
    assert flight.numbers == list(range(400))
    for path in flight.files:
        assert FlightLog.read([path]).is_complete
        assert path.stat().st_size < 0.03e6
    assert flight.status.megabytes == pytest.approx(
        sum(path.stat().st_size for path in flight.files) / 1e6, abs=0.01
    )


def test_the_total_is_kept_and_the_newest_stays(tmp_path):
    flight = Flight(tmp_path, file_size_mb=0.02, total_size_mb=0.07)
    flight.fly(120)
    assert sum(path.stat().st_size for path in flight.files) < 0.1e6
    flight.recorder.finish()
    assert flight.numbers[-1] == 1199
    assert flight.numbers == list(range(flight.numbers[0], 1200))


def test_a_full_queue_drops_counts_and_reports(tmp_path):
    flight = Flight(tmp_path, limit=100)
    flight.fly(2)
    for number in range(20, 1000):
        flight.say(number)
    with Log() as log:
        flight.fly(2, first=1000)
    flight.recorder.finish()
    assert flight.numbers == [*range(120), *range(1001, 1020)]
    assert flight.status.dropped == 881
    (event,) = [each for each in log.events if each.get("code") == "messages_dropped"]
    assert event["count"] == 881


def test_a_long_queue_is_written_in_batches_with_pauses(flight):
    flight.fly(1)
    for number in range(10, 5010):
        flight.say(number)
    flight.recorder.work()
    assert flight.numbers == list(range(5010))
    assert flight.paused >= 1


def test_the_begin_of_a_file_is_written_in_pieces_with_pauses(flight, tmp_path, monkeypatch):
    # As if each piece took longer than the interpreter may be held.
    monkeypatch.setattr(throttle, "BATCH_S", -1.0)
    for number in range(9):
        (tmp_path / f"{number}.yml").write_text("a: 1\n")
    flight.fly(2, origin=INTERNAL)
    flight.say(20)
    flight.recorder.work()
    metadata, attached, said = 2, 9, 21
    assert flight.paused == metadata + attached + said
    flight.recorder.prepare(range(5))
    assert flight.paused == metadata + attached + said + 5
    flight.recorder.finish()
    assert len(FlightLog.read(flight.files).attachments) == 9


def test_the_end_of_the_program_waits_for_no_pause(flight):
    flight.fly(1)
    for number in range(10, 5010):
        flight.say(number)
    before = flight.paused
    flight.recorder.finish()
    assert flight.paused == before
    assert flight.numbers == list(range(5010))


# Synchronised data


def test_it_is_forced_onto_the_disk_every_second_and_at_the_end(flight):
    flight.fly(10)
    assert 9 <= flight.disk.calls.count("sync") <= 14
    assert flight.disk.calls.count("sync_folder") == 1
    before = flight.disk.calls.count("sync")
    flight.pass_s(5)
    flight.recorder.work()
    flight.pass_s(5)
    flight.recorder.work()
    assert flight.disk.calls.count("sync") == before + 1
    flight.recorder.finish()
    assert flight.disk.calls[-2:] == ["sync", "close"]

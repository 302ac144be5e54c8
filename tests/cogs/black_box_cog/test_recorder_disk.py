import errno
import os
import shutil

import pytest
from black_box_cog.recorder import STALLED_S

from tests.cogs.black_box_cog.flights import (
    Flight,
    HalfFullDisk,
    TestedDisk,
    codes_in,
    codes_of,
    numbers_in,
)
from tests.up.commands.samples import Log
from up_flightlog.read.flight_log import FlightLog


def logged_errors(log):
    return [event for event in log.events if event["log_level"].name == "error"]


@pytest.mark.parametrize(
    ("call", "number"),
    [
        ("write", errno.ENOSPC),
        ("write", errno.EIO),
        ("sync", errno.EIO),
        ("make_folder", errno.EROFS),
    ],
)
def test_a_disk_error_is_reported_once_and_retried_each_minute(tmp_path, call, number):
    flight = Flight(tmp_path)
    said = flight.fly(15)
    with Log() as log:
        flight.disk.refuse[call] = number
        said = flight.fly(200, first=said)
    assert not flight.status.recording
    assert flight.status.problem is not None and flight.status.dropped > 0
    assert [event["log_namespace"] for event in logged_errors(log)] == ["BlackBox"]
    tried = flight.disk.calls.count(call)
    flight.fly(30, first=said)
    assert flight.disk.calls.count(call) - tried <= 1
    del flight.disk.refuse[call]
    with Log() as log:
        said = flight.fly(61, first=said + 300)
    assert flight.status.recording and flight.status.problem is None
    assert codes_of(log).count("recording_resumed") == 1
    flight.recorder.finish()
    log = FlightLog.read(flight.files)
    assert {each.code for each in log.problems} <= {"cut_off"}
    codes = [code for path in flight.files for code in codes_in(path)]
    assert codes.count("recording_stopped") == 1
    numbers = flight.numbers
    assert numbers == sorted(numbers) and numbers[-1] == said - 1


@pytest.mark.parametrize("room", range(0, 3000, 397))
def test_a_disk_full_at_any_byte_leaves_whole_records(tmp_path, room):
    disk = HalfFullDisk()
    flight = Flight(tmp_path, disk)
    flight.fly(2)
    disk.room = room
    said = flight.fly(65, first=20)
    disk.room = None
    flight.fly(65, first=said)
    flight.recorder.finish()
    first, second = flight.files
    assert second.name.endswith("kite.2.mcap")
    cut, whole = FlightLog.read([first]), FlightLog.read([second])
    assert whole.is_complete
    assert not cut.is_complete
    assert ends_with_a_whole_record(first)
    numbers = numbers_in(first)
    assert numbers == list(range(len(numbers)))


def ends_with_a_whole_record(path):
    data = path.read_bytes()
    place = 8
    while place < len(data):
        place += 9 + int.from_bytes(data[place + 1 : place + 9], "little")
    return place == len(data)


def test_a_try_without_success_leaves_no_file(tmp_path):
    flight = Flight(tmp_path, HalfFullDisk())
    flight.disk.room = 100
    flight.fly(200)
    assert flight.status.problem.endswith(os.strerror(errno.ENOSPC))
    assert flight.files == []


def test_with_too_little_free_space_it_ends_and_continues_later(tmp_path):
    flight = Flight(tmp_path, keep_free_mb=200.0)
    flight.disk.free = 300_000_000
    flight.fly(15)
    flight.disk.free = 100_000_000
    with Log() as log:
        said = flight.fly(100, first=150)
        flight.disk.free = 90_000_000
        said = flight.fly(100, first=said)
    assert len(logged_errors(log)) == 1
    assert flight.status.problem.startswith("90 MB ")
    assert FlightLog.read(flight.files).is_complete
    flight.disk.free = 300_000_000
    flight.fly(61, first=said)
    assert flight.status.recording and len(flight.files) == 2


def test_what_could_not_be_written_is_counted(tmp_path):
    flight = Flight(tmp_path)
    flight.fly(5)
    flight.disk.refuse["write"] = errno.EIO
    for number in range(50, 150):
        flight.say(number)
    said = flight.fly(300, first=150)
    del flight.disk.refuse["write"]
    flight.fly(61, first=said)
    flight.recorder.finish()
    total = 50 + 100 + 3000 + 610
    assert len(flight.numbers) + flight.status.dropped == pytest.approx(total, abs=3)


@pytest.mark.parametrize("what", ["file", "folder"])
def test_one_whose_file_is_removed_in_flight_begins_another(tmp_path, what):
    flight = Flight(tmp_path)
    flight.fly(5)
    if what == "file":
        flight.files[0].unlink()
    else:
        shutil.rmtree(flight.path)
    with Log() as log:
        flight.fly(5, first=50)
    flight.recorder.finish()
    assert codes_of(log).count("recording_removed") == 1
    (path,) = flight.files
    assert path.name.endswith("kite.2.mcap")
    numbers = flight.numbers
    assert numbers[0] <= 60 and numbers == list(range(numbers[0], 100))


def test_a_folder_that_is_a_file_is_reported(tmp_path):
    flight = Flight(tmp_path)
    flight.path.write_text("no folder")
    with Log() as log:
        flight.fly(5)
    assert flight.status.problem == f"{flight.path}: File exists"
    assert len(logged_errors(log)) == 1
    flight.recorder.finish()


class HangingDisk(TestedDisk):
    """A disk whose sync runs a callback before it ends."""

    meanwhile = None

    def sync(self, descriptor):
        if self.meanwhile is not None:
            self.meanwhile()
        super().sync(descriptor)


def test_a_disk_that_hangs_is_a_problem_while_it_does(tmp_path):
    disk = HangingDisk()
    flight = Flight(tmp_path, disk, limit=100)
    told = []

    def hang():
        for _ in range(5):
            flight.pass_s(STALLED_S / 2)
            for number in range(60):
                flight.say(number)
            told.append((flight.status.problem, flight.status.dropped))

    flight.fly(5)
    disk.meanwhile = hang
    flight.pass_s(1)
    flight.recorder.work()
    problems, dropped = zip(*told, strict=True)
    assert problems[0] is None
    assert problems[-1] is not None
    assert dropped[-1] == 200
    assert flight.status.problem is None and flight.status.recording


def test_a_failed_round_is_a_problem_and_its_entries_are_counted(tmp_path, monkeypatch):
    flight = Flight(tmp_path)
    flight.fly(5)

    def fail():
        raise RuntimeError("a fault of the recorder's own")

    with monkeypatch.context() as broken:
        broken.setattr(flight.recorder._segment.file, "flush", fail)
        for number in range(8):
            flight.say(number)
            flight.pass_s(1)
            with pytest.raises(RuntimeError):
                flight.recorder.work()
    assert flight.status.problem is not None
    flight.recorder.work()
    assert (flight.status.problem, flight.status.dropped) == (None, 8)


def test_a_finished_recorder_has_no_problem(tmp_path):
    flight = Flight(tmp_path)
    flight.fly(1)
    flight.recorder.finish()
    flight.pass_s(1000)
    assert flight.status.problem is None

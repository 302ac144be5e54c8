import fcntl
import os
import subprocess
import sys

import pytest
from black_box_cog.disk import Disk
from black_box_cog.flight_folder import FlightFolder, NoRoomError

from tests.cogs.black_box_cog.flights import START_UNIX_S, TestedDisk
from up.flight_log.flight_file import flight_files

STRANGERS = ("holiday.mcap", "0001-notes.txt", "0000-20260101T000000Z-kite.mcap.bak")


def folder_in(path, total=1e9, keep_free=0.0, disk=None):
    return FlightFolder(disk or Disk(), path, total, keep_free)


def old(path, number, size=100, part=1, aircraft="kite"):
    name = f"{number:04d}-20260101T000000Z-{aircraft}{'' if part == 1 else f'.{part}'}.mcap"
    (path / name).write_bytes(bytes(size))
    return name


def names(path):
    return sorted(each.name for each in path.iterdir())


def test_numbers_increase_whatever_the_clock(tmp_path):
    folder = folder_in(tmp_path / "deep" / "flights")
    made = []
    for start_unix_s in (START_UNIX_S, 0, START_UNIX_S):
        file, descriptor = folder.create(start_unix_s, "kite")
        os.close(descriptor)
        made.append((file.number, file.stamp))
    assert made == [
        (1, "20260814T093000Z"),
        (2, "19700101T000000Z"),
        (3, "20260814T093000Z"),
    ]


def test_an_existing_file_is_never_overwritten(tmp_path):
    folder = folder_in(tmp_path)
    first, descriptor = folder.create(START_UNIX_S, "kite")
    os.close(descriptor)
    assert (folder.create_part(first)[0].part, folder.create_part(first)[0].part) == (2, 3)


def test_daemons_that_start_at_once_get_numbers_of_their_own(tmp_path):
    code = (
        "import sys; from pathlib import Path; from black_box_cog.disk import Disk;"
        "from black_box_cog.flight_folder import FlightFolder;"
        "folder = FlightFolder(Disk(), Path(sys.argv[1]), 1e9, 0);"
        "sys.stdin.readline();"
        "[folder.create(0, sys.argv[2]) for _ in range(20)]"
    )
    running = [
        subprocess.Popen(
            [sys.executable, "-c", code, tmp_path / "flights", name], stdin=subprocess.PIPE
        )
        for name in ("kite", "kite", "crane", "swift")
    ]
    for each in running:
        each.stdin.write(b"go\n")
        each.stdin.flush()
    for each in running:
        each.communicate(timeout=60)
        assert each.returncode == 0
    numbers = [each.number for each in flight_files(tmp_path / "flights")]
    assert sorted(numbers) == list(range(1, 81))


def test_beyond_the_total_the_oldest_flights_go_whole(tmp_path):
    for number, part in ((1, 1), (1, 2), (2, 1), (3, 1), (10, 1)):
        old(tmp_path, number, part=part)
    gone = folder_in(tmp_path, total=350).make_room()
    assert [(each.number, each.part) for each in gone] == [(1, 1), (1, 2)]
    assert [each.number for each in flight_files(tmp_path)] == [2, 3, 10]


def test_nothing_goes_that_has_room(tmp_path):
    old(tmp_path, 1)
    assert folder_in(tmp_path, total=100).make_room() == []


def test_what_the_recorder_did_not_write_stays(tmp_path):
    for name in STRANGERS:
        (tmp_path / name).write_bytes(bytes(1000))
    (tmp_path / "0002-20260101T000000Z-kite.mcap").mkdir()
    (tmp_path / "0003-20260101T000000Z-kite.mcap").symlink_to(tmp_path / "holiday.mcap")
    before = names(tmp_path)
    old(tmp_path, 1)
    folder_in(tmp_path, total=10).make_room()
    assert names(tmp_path) == before


def test_of_the_current_flight_the_oldest_parts_go_and_never_the_current_file(tmp_path):
    old(tmp_path, 1)
    for part in (1, 2, 3):
        old(tmp_path, 2, part=part)
    current = flight_files(tmp_path)[-1]
    gone = folder_in(tmp_path, total=10).make_room(current)
    assert [(each.number, each.part) for each in gone] == [(1, 1), (2, 1), (2, 2)]
    assert flight_files(tmp_path) == [current]


def test_a_file_that_another_daemon_records_into_stays(tmp_path):
    old(tmp_path, 1)
    _, descriptor = folder_in(tmp_path).create(START_UNIX_S, "crane")
    os.write(descriptor, bytes(100))
    old(tmp_path, 3)
    folder_in(tmp_path, total=10).make_room()
    assert [each.aircraft for each in flight_files(tmp_path)] == ["crane"]
    os.close(descriptor)
    folder_in(tmp_path, total=10).make_room()
    assert flight_files(tmp_path) == []


def test_without_locks_it_goes_by_names(tmp_path, monkeypatch):
    def refuse(descriptor, operation):
        raise OSError(37, "No locks available")

    monkeypatch.setattr(fcntl, "flock", refuse)
    old(tmp_path, 1)
    folder = folder_in(tmp_path, total=10)
    file, descriptor = folder.create(START_UNIX_S, "kite")
    os.close(descriptor)
    assert file.number == 2
    assert [each.number for each in folder.make_room(file)] == [1]


def test_flights_are_deleted_for_the_space_to_keep_free(tmp_path):
    disk = TestedDisk()
    disk.free = 500
    remove = disk.remove
    for number in (1, 2, 3):
        old(tmp_path, number)

    def free(path):
        remove(path)
        disk.free += 100

    disk.remove = free
    gone = folder_in(tmp_path, keep_free=650, disk=disk).make_room()
    assert [each.number for each in gone] == [1, 2]


def test_too_little_space_is_an_error(tmp_path):
    disk = TestedDisk()
    disk.free = 50_000_000
    old(tmp_path, 1)
    with pytest.raises(NoRoomError, match="50 MB"):
        folder_in(tmp_path, keep_free=200e6, disk=disk).make_room()

import json
import os
import threading

import pytest
from hypothesis import given
from hypothesis import strategies as st
from twisted.logger import Logger, LogLevel
from twisted.python.failure import Failure

from up.log.json_lines import JsonLinesObserver, RotatingFile, line_of


@pytest.fixture
def failures():
    return []


@pytest.fixture
def make(tmp_path, failures):
    observers = []

    def make(path=tmp_path / "log.jsonl", rotate_bytes=1_000_000, keep=2):
        observer = JsonLinesObserver(
            RotatingFile(path, rotate_bytes, keep), LogLevel.info, failures.append
        )
        observer.start()
        observers.append(observer)
        return observer, Logger(namespace="gps", observer=observer)

    yield make
    for observer in observers:
        observer.stop()


def records(path):
    return [json.loads(line) for line in path.read_text().splitlines()]


def test_an_event_is_one_object_a_line(make, tmp_path):
    _, log = make()
    log.info("at {place}", place="ž\n", height_m=3.5, fix=True, other=object())
    log.debug("left out")
    [record] = records(tmp_path / "log.jsonl")
    assert record.pop("time").endswith("+00:00")
    assert record == {
        "level": "info",
        "source": "gps",
        "text": "at ž\\n",
        "fields": {"place": "ž\n", "height_m": 3.5, "fix": True},
    }


def test_a_bug_brings_its_traceback(make, tmp_path):
    _, log = make()
    try:
        raise ZeroDivisionError
    except ZeroDivisionError:
        log.failure("a bug")
        log.error("expected", log_failure=Failure())
    bug, expected = records(tmp_path / "log.jsonl")
    assert "test_json_lines.py" in bug["traceback"]
    assert "traceback" not in expected
    assert expected["text"] == "expected: ZeroDivisionError"


def test_lines_are_added_to_what_is_there_and_a_torn_line_is_ended(make, tmp_path):
    path = tmp_path / "deep" / "log.jsonl"
    path.parent.mkdir()
    path.write_bytes(b'{"a": 1}\n{"torn')
    _, log = make(path)
    log.info("new")
    lines = path.read_bytes().splitlines()
    assert lines[:2] == [b'{"a": 1}', b'{"torn']
    assert json.loads(lines[2])["text"] == "new"


def test_the_file_rotates_and_loses_no_line_that_it_should_keep(make, tmp_path):
    _, log = make(rotate_bytes=1000, keep=2)
    for number in range(100):
        log.info("{number}", number=number)
    names = ["log.jsonl.2", "log.jsonl.1", "log.jsonl"]
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(names)
    assert all((tmp_path / name).stat().st_size <= 1000 for name in names)
    numbers = [r["fields"]["number"] for name in names for r in records(tmp_path / name)]
    assert numbers == list(range(numbers[0], 100))
    assert len(numbers) > 10


def test_without_old_files_to_keep_the_file_begins_anew(make, tmp_path):
    _, log = make(rotate_bytes=500, keep=0)
    for number in range(50):
        log.info("{number}", number=number)
    assert [path.name for path in tmp_path.iterdir()] == ["log.jsonl"]
    assert records(tmp_path / "log.jsonl")[-1]["text"] == "49"
    assert (tmp_path / "log.jsonl").stat().st_size <= 500


def test_a_line_longer_than_the_limit_is_written_whole(make, tmp_path):
    _, log = make(rotate_bytes=10)
    log.info("one")
    log.info("two")
    assert records(tmp_path / "log.jsonl")[0]["text"] == "two"
    assert records(tmp_path / "log.jsonl.1")[0]["text"] == "one"


def test_a_full_disk_stops_it_and_is_said_once(make, failures, monkeypatch, tmp_path):
    _, log = make()
    log.info("before")

    def full(descriptor, data):
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(os, "write", full)
        log.info("lost")
        log.info("lost too")
    log.info("after")
    assert len(failures) == 1
    assert str(tmp_path / "log.jsonl") in failures[0]
    assert [record["text"] for record in records(tmp_path / "log.jsonl")] == ["before"]


@pytest.mark.parametrize("obstacle", ["folder", "file as folder", "full"])
def test_a_place_that_cannot_be_written_is_said_once_and_nothing_raised(
    make, failures, tmp_path, obstacle
):
    path = tmp_path / "log.jsonl"
    if obstacle == "folder":
        path.mkdir()
    elif obstacle == "file as folder":
        path.write_text("")
        path = path / "log.jsonl"
    else:
        path.symlink_to("/dev/full")
    _, log = make(path)
    log.info("lost")
    log.info("lost")
    assert len(failures) == 1
    assert str(path) in failures[0]


def test_a_pipe_that_nobody_reads_never_makes_it_wait(make, failures, tmp_path):
    os.mkfifo(tmp_path / "log.jsonl")
    _, log = make()
    for _ in range(2000):
        log.info("x" * 1000)
    assert len(failures) == 1


def test_a_folder_that_goes_away_stops_it_at_the_next_rotation(make, failures, tmp_path):
    folder = tmp_path / "logs"
    _, log = make(folder / "log.jsonl", rotate_bytes=10)
    log.info("one")
    (folder / "log.jsonl").unlink()
    folder.rmdir()
    folder.write_text("")
    log.info("two")
    log.info("three")
    assert len(failures) == 1


def test_threads_do_not_mix_their_lines(make, tmp_path):
    _, log = make(rotate_bytes=3000, keep=200)
    threads = [
        threading.Thread(target=lambda n=n: [log.info("{n}", n=n, i=i) for i in range(100)])
        for n in range(4)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    found = [
        (record["fields"]["n"], record["fields"]["i"])
        for path in tmp_path.iterdir()
        for record in records(path)
    ]
    assert sorted(found) == [(n, i) for n in range(4) for i in range(100)]


def test_after_stop_nothing_is_written(make, tmp_path):
    observer, log = make()
    observer.stop()
    observer.stop()
    log.info("late")
    assert (tmp_path / "log.jsonl").read_bytes() == b""


@given(
    st.dictionaries(
        st.text(min_size=1),
        st.none()
        | st.booleans()
        | st.integers()
        | st.floats()
        | st.text(st.characters(exclude_categories=()))
        | st.binary(),
    ),
    st.text(),
)
def test_any_fields_give_one_line_of_strict_json(fields, text):
    event = {**fields, "log_format": "{text}", "text": text, "log_time": 1.0}
    line = line_of(event, LogLevel.info)
    assert line.endswith(b"\n")
    assert line.count(b"\n") == 1

    def refuse(constant):
        raise AssertionError(constant)

    json.loads(line, parse_constant=refuse)

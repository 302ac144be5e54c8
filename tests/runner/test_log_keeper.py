"""Logs that stay small during writes, and traces that do not pile up."""

import os

import pytest

from up_runner.log_keeper import LogKeeper
from up_runner.log_maintenance import prune

BOOT = b"12:00:00.000 INFO     Program: boots\n"
WARNING = b"12:00:00.001 WARNING  Load: high\n"
ERROR = b"12:00:00.002 ERROR    Arduino: no board\n"
STOP = b"12:00:00.003 INFO     Program: stopping: the boot was stopped\n"


def files(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def test_after_a_rotation_the_log_starts_empty(tmp_path):
    keeper = LogKeeper(tmp_path, 10, 2)
    log = keeper.open("a")
    assert keeper.rotate("a") is False
    for number in range(4):
        os.write(log, b"%d" % number * 12)
        assert keeper.rotate("a") is True
        assert keeper.rotate("a") is False
    os.write(log, b"new")
    os.close(log)
    # Only the end of the long log, and no hole at the beginning of the new one.
    assert files(tmp_path) == {"a.log": b"new", "a.log.1": b"3" * 10, "a.log.2": b"2" * 10}


def test_without_older_logs_the_log_is_truncated(tmp_path):
    keeper = LogKeeper(tmp_path, 10, 0)
    os.write(log := keeper.open("a"), b"x" * 10)
    os.close(log)
    assert keeper.rotate("a") is True
    assert files(tmp_path) == {"a.log": b""}


def test_a_full_disk_gets_its_space_back(tmp_path):
    keeper = LogKeeper(tmp_path, 10, 1)
    os.write(log := keeper.open("a"), b"x" * 10)
    os.close(log)
    (tmp_path / "a.log.1").mkdir()
    with pytest.raises(OSError, match="directory"):
        keeper.rotate("a")
    assert (tmp_path / "a.log").read_bytes() == b""


def test_a_log_that_is_a_link_is_not_followed(tmp_path):
    (tmp_path / "a.log").symlink_to(tmp_path / "elsewhere")
    with pytest.raises(OSError, match="symbolic links"):
        LogKeeper(tmp_path, 10, 1).open("a")
    assert not (tmp_path / "elsewhere").exists()


@pytest.mark.parametrize(
    ("text", "line"),
    [
        (b"", None),
        (b"\n \n", None),
        (b"one\ntwo\n\n", "one; two"),
        (b"1\n2\n3\n4", "2; 3; 4"),
        (b"Traceback (most recent call last):\n  File\nValueError: x", "ValueError: x"),
        (BOOT + b"port 1 is taken\nuse another\n" + STOP, "port 1 is taken; use another"),
        (b"old\n" + BOOT + b"new\n" + STOP, "new"),
        (BOOT + ERROR + b"    a traceback\n" + STOP, "Arduino: no board"),
        (BOOT + ERROR + WARNING + STOP, "Arduino: no board"),
        (BOOT + WARNING + STOP, "Load: high"),
        (BOOT + STOP, "Program: stopping: the boot was stopped"),
        (b"<3>Arduino: no board\n<6>Program: stopping", "Arduino: no board"),
        (b"x" * 5000, "x" * 197 + "..."),
        (b"\x1b[31mred\xff", "?[31mred\ufffd"),
    ],
)
def test_the_last_log_line_is_the_cause(tmp_path, text, line):
    (tmp_path / "a.log").write_bytes(text)
    assert LogKeeper(tmp_path, 10, 1).last_log_line("a") == line


def test_without_a_log_there_is_no_last_line(tmp_path):
    assert LogKeeper(tmp_path / "nowhere", 10, 1).last_log_line("a") is None


def test_names_with_dots_are_distinguished(tmp_path):
    for name in ("a.log", "a.log.1", "a.log.1.log", "a.log.log.2", "a.b.log", "other.txt"):
        (tmp_path / name).write_text("")
    keeper = LogKeeper(tmp_path, 10, 1)
    keeper.remove("a")
    assert sorted(files(tmp_path)) == ["a.b.log", "a.log.1.log", "a.log.log.2", "other.txt"]


def test_the_files_of_the_oldest_ended_instances_are_removed(tmp_path):
    run, state, logs = tmp_path / "run", tmp_path / "state", LogKeeper(tmp_path / "logs", 10, 1)
    for age, name in enumerate(["a", "b", "c", "d", "e"]):
        os.close(logs.open(name))
        for folder in (run, state):
            (folder / name).mkdir(parents=True)
            (folder / name / "profile").write_text("")
            os.utime(folder / name, (1000 + age, 1000 + age))
        os.utime(logs.path(name), (1000 + age, 1000 + age))
    (run / ".runner.pid").write_text("")
    prune([run, state], logs, {"a", "c"}, 1)
    assert sorted(path.name for path in run.iterdir()) == [".runner.pid", "a", "c", "e"]
    assert sorted(path.name for path in state.iterdir()) == ["a", "c", "e"]
    assert sorted(files(logs.folder)) == ["a.log", "c.log", "e.log"]


def test_foreign_files_in_the_same_folders_are_never_removed(tmp_path):
    logs = LogKeeper(tmp_path, 10, 1)
    (tmp_path / "photos").mkdir()
    (tmp_path / "photos" / "state.json").write_text("")
    (tmp_path / "photos" / "holiday.jpg").write_text("")
    (tmp_path / "dpkg.log").write_text("")
    (tmp_path / "bad name").mkdir()
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "elsewhere" / "profile").write_text("")
    (tmp_path / "ours").mkdir()
    (tmp_path / "ours" / "config").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "elsewhere")
    prune([tmp_path], logs, ["elsewhere"], 0)
    left = {"photos", "dpkg.log", "bad name", "elsewhere", "link"}
    assert {path.name for path in tmp_path.iterdir()} == left

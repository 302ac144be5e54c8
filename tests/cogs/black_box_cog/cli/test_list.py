"""``up log list``."""

import fcntl
import json
import os

import pytest
from black_box_cog.cli.list_verb import lines_of
from black_box_cog.cli.overview_cache import MAX_ENTRIES, OverviewCache
from black_box_cog.cli.progress import Progress

from tests.cogs.black_box_cog.logbook import START_UNIX_S, write_flight
from up.flight_log.flights import flights_in


def test_each_flight_is_a_line(log, flights):
    write_flight(flights, 1)
    write_flight(flights, 2, aircraft="glider-2")
    outcome = log("list")
    assert outcome.status == 0 and not outcome.err
    head, first, second = outcome.out.splitlines()
    assert head.split() == ["no.", "start", "length", "aircraft", "armed", "highest", "size"]
    for line, number, name in ((first, "1", "kite"), (second, "2", "glider-2")):
        words = line.split()
        assert words[0] == number and name in words
        assert "20 s" in line and "10 s" in line and "320 m" in line and line.endswith("MB")


def test_for_programs(log, flights):
    path = write_flight(flights, 7)
    write_flight(flights, 7, part=2, start_unix_s=START_UNIX_S)
    found = json.loads(log("list", "--json").out)
    assert found["folder"] == str(flights)
    (flight,) = found["flights"]
    assert flight["number"] == 7 and flight["files"][0] == str(path) and len(flight["files"]) == 2
    assert flight["bytes"] == sum(each.stat().st_size for each in flights.iterdir())
    assert flight["start_unix_s"] == pytest.approx(START_UNIX_S)
    assert flight["armed_s"] == pytest.approx(10.0)
    assert flight["is_complete"] and flight["is_clock_right"] and not flight["is_recording"]


def test_what_was_cut_off_and_what_cannot_be_read_is_said(log, flights):
    write_flight(flights, 1, is_finished=False)
    write_flight(flights, 2).write_bytes(b"no log at all")
    lines = log("list").out.splitlines()
    assert lines[1].endswith("cut off")
    assert "no flight log: it does not begin as MCAP does" in lines[2]


def test_a_flight_that_is_being_recorded(log, flights):
    path = write_flight(flights, 1, is_finished=False)
    with path.open("ab") as recorder:
        fcntl.flock(recorder, fcntl.LOCK_EX)
        assert log("list").out.splitlines()[1].endswith("being recorded")
    assert log("list").out.splitlines()[1].endswith("cut off")


def test_a_clock_that_was_wrong(log, flights):
    write_flight(flights, 1, start_unix_s=3600)
    outcome = log("list")
    assert "1970-01-01 01:00:00 (the clock was wrong)" in outcome.out
    assert "The numbers tell the order" in outcome.err


def test_no_flight(log, flights, tmp_path):
    assert log("list").out == f"no flight is in {flights}\n"
    flights.rmdir()
    assert log("list").out == f"no flight is in {flights}\n"
    outcome = log("list", "--folder", "nowhere")
    assert outcome.status == 1 and outcome.err == "nowhere is no folder\n"


def test_the_folder_of_the_configuration(log, tmp_path):
    write_flight(tmp_path / "elsewhere", 3)
    plane = tmp_path / "plane"
    (plane / "config").mkdir(parents=True)
    (plane / "UpFile").write_text("")
    (plane / "config" / "black_box.yml").write_text(f"folder: {tmp_path}/elsewhere\n")
    assert log("list", cwd=plane).out.splitlines()[1].split()[0] == "3"
    assert log("list", "--config", plane / "config").out.splitlines()[1].split()[0] == "3"
    (plane / "config" / "black_box.yml").write_text("foldr: x\n")
    outcome = log("list", cwd=plane)
    assert outcome.status == 2 and "black_box.yml:1:1" in outcome.err
    assert "did you mean 'folder'" in outcome.err.replace('"', "'")
    assert log("list", "--folder", tmp_path / "elsewhere", cwd=plane).status == 0


def test_a_name_is_no_command_for_the_terminal(log, flights):
    write_flight(flights, 1, aircraft="a\x1b[2Jb\u202e")
    assert "a\\x1b[2Jb\\u202e" in log("list").out


def test_a_flight_is_read_once(flights, tmp_path):
    paths = [write_flight(flights, number) for number in range(1, 4)]
    cache = tmp_path / "cache.json"
    first = lines_of(flights_in(flights), OverviewCache(cache))
    sizes = [path.stat() for path in paths]
    # What has the same size and time of change is not looked into again.
    paths[0].write_bytes(b"x" * sizes[0].st_size)
    os.utime(paths[0], ns=(sizes[0].st_atime_ns, sizes[0].st_mtime_ns))
    assert lines_of(flights_in(flights), OverviewCache(cache)) == first
    os.utime(paths[0])
    again = lines_of(flights_in(flights), OverviewCache(cache))
    assert again[0].overview.fault and again[1:] == first[1:]


@pytest.mark.parametrize(
    "content",
    [b"", b"{", b"[]", b'{"format": 1}', b'{"format": 1, "flights": []}', b"\xff", b"[" * 9999],
)
def test_a_damaged_cache_is_none(flights, tmp_path, content):
    write_flight(flights, 1)
    cache = tmp_path / "cache.json"
    cache.write_bytes(content)
    (line,) = lines_of(flights_in(flights), OverviewCache(cache))
    assert line.overview.aircraft == "kite"
    assert json.loads(cache.read_bytes())["flights"]


def test_entries_of_another_kind_are_not_believed(flights, tmp_path):
    write_flight(flights, 1)
    cache = tmp_path / "cache.json"
    first = lines_of(flights_in(flights), OverviewCache(cache))
    document = json.loads(cache.read_bytes())
    (entry,) = document["flights"].values()
    for wrong in ({"nonsense": 1}, None, 5):
        entry["overview"] = wrong
        cache.write_text(json.dumps(document))
        assert lines_of(flights_in(flights), OverviewCache(cache)) == first


def test_the_cache_is_bounded(flights, tmp_path):
    write_flight(flights, 1)
    cache = tmp_path / "cache.json"
    entries = {f"/{number}": {} for number in range(MAX_ENTRIES + 10)}
    cache.write_text(json.dumps({"format": 1, "flights": entries}))
    lines_of(flights_in(flights), OverviewCache(cache))
    kept = json.loads(cache.read_bytes())["flights"]
    assert len(kept) == MAX_ENTRIES and any("kite" in key for key in kept)


def test_a_cache_that_cannot_be_written_stops_nothing(flights, tmp_path):
    write_flight(flights, 1)
    (tmp_path / "file").write_text("")
    assert lines_of(flights_in(flights), OverviewCache(tmp_path / "file" / "cache.json"))


class Terminal:
    def __init__(self, is_terminal):
        self.said = ""
        self._is_terminal = is_terminal

    def isatty(self):
        return self._is_terminal

    def write(self, text):
        self.said += text

    def flush(self):
        pass


@pytest.mark.parametrize(("is_terminal", "after_s", "speaks"), [(1, 0, 1), (1, 1e9, 0), (0, 0, 0)])
def test_long_work_is_told_to_who_watches(monkeypatch, is_terminal, after_s, speaks):
    monkeypatch.setattr("black_box_cog.cli.progress.AFTER_S", after_s)
    terminal = Terminal(bool(is_terminal))
    with Progress("reading flight", 300, terminal) as progress:
        progress.at(12)
    assert ("reading flight 12 of 300" in terminal.said) == bool(speaks)
    assert terminal.said.endswith("\r\x1b[K") == bool(speaks)

import fcntl
import io
import json
import os

import pytest

from tests.flightlog.logbook import START_UNIX_S, write_flight
from up_flightlog.cli.list_verb import lines_of
from up_flightlog.cli.overview import MAX_ENTRIES, OverviewCache
from up_flightlog.cli.terminal import Progress
from up_flightlog.read.flights import flights_in


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


def test_json(log, flights):
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


def test_damaged_flights(log, flights):
    write_flight(flights, 1, is_finished=False)
    write_flight(flights, 2).write_bytes(b"no log at all")
    lines = log("list").out.splitlines()
    assert lines[1].endswith("cut off")
    assert "0002-" in lines[2]


def test_a_flight_during_its_recording(log, flights):
    path = write_flight(flights, 1, is_finished=False)
    with path.open("ab") as recorder:
        fcntl.flock(recorder, fcntl.LOCK_EX)
        assert log("list").out.splitlines()[1].endswith("being recorded")
        assert "log_damaged" not in codes_of_info(log)
    assert log("list").out.splitlines()[1].endswith("cut off")
    assert "log_damaged" in codes_of_info(log)


def codes_of_info(log) -> list[str]:
    return [each["code"] for each in json.loads(log("info", "1", "--json").out)["findings"]]


def test_a_wrong_clock(log, flights):
    write_flight(flights, 1, start_unix_s=3600)
    outcome = log("list")
    assert "1970-01-01 01:00:00" in outcome.out
    assert outcome.err


def test_no_flight(log, flights, tmp_path):
    for _ in range(2):
        outcome = log("list")
        assert outcome.status == 0 and str(flights) in outcome.out
        if flights.exists():
            flights.rmdir()
    outcome = log("list", "--folder", "nowhere")
    assert outcome.status == 2 and "nowhere" in outcome.err


def test_the_flights_of_make_run_are_hinted_at(log, flights, tmp_path):
    demo = tmp_path / "run/demo/flights"
    for verb in (["list"], ["info", "last"]):
        said = log(*verb)
        assert "--folder" not in said.out + said.err
    write_flight(demo, 1)
    for verb in (["list"], ["info", "last"]):
        said = log(*verb)
        assert "--folder run/demo/flights" in said.out + said.err
    assert log("info", "last", "--folder", "run/demo/flights").status == 0


def test_control_characters_are_escaped(log, flights):
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
def test_a_damaged_cache_is_ignored(flights, tmp_path, content):
    write_flight(flights, 1)
    cache = tmp_path / "cache.json"
    cache.write_bytes(content)
    (line,) = lines_of(flights_in(flights), OverviewCache(cache))
    assert line.overview.aircraft == "kite"
    assert json.loads(cache.read_bytes())["flights"]


def test_the_cache_is_bounded(flights, tmp_path):
    write_flight(flights, 1)
    cache = tmp_path / "cache.json"
    entries = {f"/{number}": {} for number in range(MAX_ENTRIES + 10)}
    cache.write_text(json.dumps({"format": 1, "flights": entries}))
    lines_of(flights_in(flights), OverviewCache(cache))
    kept = json.loads(cache.read_bytes())["flights"]
    assert len(kept) == MAX_ENTRIES and any("kite" in key for key in kept)


def test_a_cache_that_cannot_be_written(flights, tmp_path):
    write_flight(flights, 1)
    (tmp_path / "file").write_text("")
    assert lines_of(flights_in(flights), OverviewCache(tmp_path / "file" / "cache.json"))


class Terminal(io.StringIO):
    def __init__(self, is_terminal):
        super().__init__()
        self.isatty = lambda: is_terminal


@pytest.mark.parametrize(("is_terminal", "delay_s", "shown"), [(1, 0, 1), (1, 1e9, 0), (0, 0, 0)])
def test_progress_is_shown_on_a_terminal_after_a_while(monkeypatch, is_terminal, delay_s, shown):
    monkeypatch.setattr("up_flightlog.cli.terminal._DELAY_S", delay_s)
    terminal = Terminal(bool(is_terminal))
    monkeypatch.setattr("sys.stderr", terminal)
    with Progress("reading flight") as progress:
        progress.show("12 of 300")
    assert ("12 of 300" in terminal.getvalue()) == bool(shown)
    assert terminal.getvalue().endswith("\r\x1b[K") == bool(shown)

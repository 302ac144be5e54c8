"""``up log info``, ``report``, and the folder that every verb reads."""

import json

import pytest

from tests.flightlog.logbook import EVIL, eventful, write_flight


def test_a_flight(log, flights):
    write_flight(flights, 12)
    outcome = log("info", 12)
    assert outcome.status == 0 and not outcome.err
    lines = outcome.out.splitlines()
    assert lines[0].startswith("Flight 12, kite, 2026-04-24 03:06:40, 20 s, 0.")
    assert "faults" in lines
    words = [line.split() for line in lines]
    for row in (
        "armed 10 s",
        "altitude 300 to 320 m",
        "0:00.0 FBW 20 s",
        "config/config.yml",
        "serial_cog 1.0.0",
        "up.orientation.update 200 10.1",
    ):
        assert row.split() in words


def test_faults_come_first(log, flights):
    write_flight(flights, 1, eventful, is_finished=False)
    out = log("info", "last").out
    assert "cut off" in out.splitlines()[0]
    titles = [line for line in out.splitlines() if line and not line.startswith(" ")][1:]
    assert titles[0] == "faults" and titles[-1] == "file problems"
    assert f"look {EVIL}" in out
    found = json.loads(log("info", "last", "--json").out)
    assert found["is_complete"] is False and found["number"] == 1
    assert {"level", "code", "time_s", "fields"} <= set(found["findings"][0])


def test_control_characters_are_escaped(log, flights):
    def fill(maker):
        maker.add(0, "a\x1b[2Jtopic", x=1)
        maker.add(1, "black_box.mark", text="mark\x1b[2J\nnext")
        maker.writer.add_metadata("versions", {"a\x07": "b\x1b[1m"})

    write_flight(flights, 1, fill, aircraft="kite\x1b]0;title\x07")
    out = log("info", 1).out
    assert "\x1b" not in out and "\x07" not in out
    # A line break would forge a row.
    assert "\\nnext" in out
    assert "kite\\x1b]0;title\\x07" in out


def test_a_flight_without_messages(log, flights):
    write_flight(flights, 1, lambda maker: None)
    outcome = log("info", 1)
    assert outcome.status == 0 and "no time" in outcome.out and "never" in outcome.out
    assert log("list").status == 0


def test_a_file_that_is_not_a_flight(log, tmp_path):
    (tmp_path / "x.mcap").write_bytes(b"nonsense")
    outcome = log("info", "x.mcap")
    assert outcome.status == 1 and outcome.err.startswith("x.mcap: ")
    for arguments in (["info"], ["info", "1", "2"], ["info", "--nonsense", "1"]):
        assert log(*arguments).status == 2


def test_log_alone_shows_its_verbs(log):
    outcome = log()
    assert outcome.status == 2
    for verb in ("list", "info", "export", "plot", "report"):
        assert f"    {verb} " in outcome.out
        assert f"usage: up log {verb}" in log(verb, "--help").out


def test_a_report_without_a_named_folder_is_beside_its_flight(log, flights, tmp_path):
    write_flight(flights, 1, lambda maker: maker.add(0, "a", x=1))
    assert log("report", 1, "-o", tmp_path / "nodir" / "mine").status == 1
    assert not (tmp_path / "nodir").exists()
    outcome = log("report", 1)
    assert outcome.status == 0
    (page,) = flights.glob("*-report/report.html")
    assert str(page) in outcome.out
    assert not list(tmp_path.glob("*report*"))


@pytest.fixture
def plane(tmp_path):
    """An application whose flights are in ``elsewhere``."""
    plane = tmp_path / "plane"
    (plane / "config").mkdir(parents=True)
    (plane / "UpFile").write_text("")
    (plane / "config" / "black_box.yml").write_text(f"folder: {tmp_path}/elsewhere\n")
    write_flight(tmp_path / "elsewhere", 3)
    return plane


@pytest.mark.parametrize("verb", ["info", "replay"])
def test_the_folder_is_that_of_black_box_yml_or_of_the_options(log, plane, tmp_path, flights, verb):
    """``replay`` is the ground's verb."""
    assert f"{tmp_path}/elsewhere" in log(verb, 9, cwd=plane).err
    assert f"{tmp_path}/elsewhere" in log(verb, 9, "--config", plane / "config").err
    assert f"{tmp_path}/other" in log(verb, 9, "--folder", tmp_path / "other", cwd=plane).err
    assert str(flights) in log(verb, 9, cwd=flights).err
    (plane / "config" / "black_box.yml").write_text("foldr: x\n")
    outcome = log(verb, 9, cwd=plane)
    assert outcome.status == 2 and "black_box.yml:1:1" in outcome.err

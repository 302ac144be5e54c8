"""``up-sim tune`` as users type it: its output, its files and its errors."""

import subprocess
import sys

import pytest

from tests.simulator.picture.flights import made_up
from tests.support.waiting import HANG_S
from up.flight_controller.pids_file import PIDS
from up_simulator.cli import main


@pytest.fixture
def log(tmp_path):
    """Return the log of a flight that never was, with steps of roll in FBW."""
    path = tmp_path / "flight.csv"
    made_up(30.0).write(path)
    return path


def tune(*arguments):
    return main(["tune", *(str(each) for each in arguments)])


def test_one_axis_is_tuned_shown_and_written(bench, tmp_path, monkeypatch, capsys):
    pids = tmp_path / "new" / "pids.yml"
    monkeypatch.chdir(tmp_path)
    status = tune("--axis", "roll", "--quick", "--write", pids, "--processes", 1)
    said = capsys.readouterr().out
    assert status == 0
    assert "roll in FBW" in said
    assert "->  rate" in said
    assert (tmp_path / "run/tuning/glider-roll.png").read_bytes().startswith(b"\x89PNG")
    values = PIDS.parse(pids.read_bytes(), pids)
    assert f"ailerons: {{p: {values.rate.ailerons.p:g}, i: 0, d: 0}}" in said
    assert 0 < values.rate.ailerons.p < 6
    # Axes that were not requested keep their values.
    assert values.rate.elevator.p == bench.airframe.gains["rate"]["elevator"]["p"]


def test_a_log_is_looked_at_without_flying(log, tmp_path, capsys):
    assert tune("--log", log, "--pictures", tmp_path) == 0
    said = capsys.readouterr().out
    rows = [line.split() for line in said.splitlines() if " FBW " in line and "roll" in line]
    assert [(row[0], row[3], row[4]) for row in rows[:3]] == [
        ("10.00", "0", "30"),
        ("16.00", "30", "0"),
        ("18.00", "0", "-25"),
    ]
    assert "roll in FBW: " in said
    picture = tmp_path / f"{tmp_path.name}-flight-steps.png"
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_an_unwritable_picture_is_reported_and_removed(log, tmp_path, capsys):
    (tmp_path / "file").write_text("no folder")
    assert tune("--log", log, "--pictures", tmp_path / "file") == 0
    told = capsys.readouterr()
    assert "-steps.png: " in told.err and told.err.count("\n") == 1
    assert "[Errno" not in told.err and "picture: " not in told.out
    tuning = f'"{sys.executable}" -m up_simulator tune'
    command = f'ulimit -f 1; exec {tuning} --log "$0" --pictures "$1"'
    words = ["sh", "-c", command, str(log), str(tmp_path / "new")]
    done = subprocess.run(words, capture_output=True, text=True, timeout=HANG_S, check=False)
    assert (done.returncode, list((tmp_path / "new").iterdir())) == (0, [])
    assert "-steps.png: " in done.stderr and done.stderr.count("\n") == 1


def test_a_log_without_steps_is_reported(tmp_path, capsys):
    path = tmp_path / "flight.csv"
    made_up(8.0).write(path)
    assert tune("--log", path, "--pictures", tmp_path) == 1
    assert str(path) in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (["--airframe", "gilder"], "gilder"),
        (["--log", "none.csv"], "none.csv: "),
        (["--log", "none.csv", "--write", "x"], "--write "),
        (["--log", __file__], "time_s"),
        (["--from", "none.yml"], "none.yml"),
    ],
)
def test_wrong_input_ends_with_one_line(arguments, named, capsys):
    assert tune(*arguments) == 2
    said = capsys.readouterr().err
    assert named in said
    assert said.count("\n") == 1


def test_invalid_gains_are_reported_with_their_place(tmp_path, capsys):
    path = tmp_path / "pids.yml"
    path.write_text("rate:\n  ailerons: {p: 99}\n")
    assert tune("--from", path) == 2
    assert f"{path}:2:" in capsys.readouterr().err


def test_a_file_that_is_no_pids_yml_is_not_written_over(tmp_path, capsys):
    path = tmp_path / "letter.txt"
    path.write_text("dear: friend\n")
    status = tune("--write", path)
    assert status == 2
    assert path.read_text() == "dear: friend\n"
    told = capsys.readouterr()
    assert f"{path}:1:" in told.err
    assert told.out == "", "before anything is flown"

"""Where the files of a flight go: tried before it flies; a full disk costs no verdict."""

from pathlib import Path

import pytest

from tests.support.firmware import build_firmware
from tools.tuning.cli import main as tune
from up_simulator.cli import main
from up_simulator.verbs.catalogue import shipped_paths

GOOD = """\
title: Good
duration_s: 1
sticks: [{at_s: 0, mode: FBW, arm: true, throttle: 0.5}]
expect: [{name: It flies, signal: truth.height_m, above: 50}]
"""


@pytest.fixture(autouse=True)
def in_a_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("good.yml").write_text(GOOD)
    Path("file").write_text("no folder")


def never(*_arguments, **_options):
    raise AssertionError("it was flown in vain")


@pytest.mark.parametrize("output", ["/proc/x", "file", "file/below"])
@pytest.mark.parametrize("words", [["fly", "good.yml"], ["all"]])
def test_a_place_that_takes_no_files_is_told_before_the_flight(words, output, capsys, monkeypatch):
    monkeypatch.setattr("up_simulator.verbs.fly.fly_scenario", never)
    monkeypatch.setattr("up_simulator.verbs.all.Fleet", never)
    assert main([*words, "--output", output]) == 2
    told = capsys.readouterr().err
    assert told.startswith(f"up-sim: --output {output}: nothing can be written there: ")
    assert told.count("\n") == 1
    assert len(shipped_paths()) > 1


def test_gains_that_cannot_be_written_are_not_looked_for(monkeypatch):
    monkeypatch.setattr("tools.tuning.cli.Workers", never)
    with pytest.raises(OSError, match="/proc/x"):
        tune(["--write", "/proc/x/pids.yml"])


FILES = ["log.csv", "flight.mcap", "picture.png", "summary.json", "report.txt"]


@pytest.mark.parametrize("full", FILES)
def test_a_full_disk_costs_no_verdict(full, capsys):
    build_firmware()
    Path("out/good").mkdir(parents=True)
    Path("out/good", full).symlink_to("/dev/full")
    if full == "picture.png":
        pytest.importorskip("matplotlib")
    assert main(["fly", "good.yml", "--output", "out"]) == 1
    told = capsys.readouterr()
    assert "good: held (2 of 2 expectations)" in told.out
    assert told.err == f"up-sim: out/good/{full} is not written: No space left on device\n"
    # Nothing is there that looks whole and is not.
    assert not Path("out/good", full).exists()
    assert Path("/dev/full").exists()
    assert full == "log.csv" or Path("out/good/log.csv").is_file()

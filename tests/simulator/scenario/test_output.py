"""The output folder is checked before the flight; a full disk changes no verdict."""

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
    raise AssertionError("it has flown")


@pytest.mark.parametrize("output", ["/proc/x", "file", "file/below"])
@pytest.mark.parametrize("words", [["fly", "good.yml"], ["all"]])
def test_a_folder_that_is_not_writable_is_reported_before_the_flight(
    words, output, capsys, monkeypatch
):
    monkeypatch.setattr("up_simulator.verbs.fly.fly_scenario", never)
    monkeypatch.setattr("up_simulator.verbs.all.Batch", never)
    assert main([*words, "--output", output]) == 2
    printed = capsys.readouterr().err
    assert printed.startswith(f"up-sim: --output {output}: ")
    assert printed.count("\n") == 1
    assert len(shipped_paths()) > 1


def test_a_file_of_gains_that_is_not_writable_is_reported_before_the_tuning(monkeypatch):
    monkeypatch.setattr("tools.tuning.cli.Workers", never)
    with pytest.raises(OSError, match="/proc/x"):
        tune(["--write", "/proc/x/pids.yml"])


FILES = ["log.csv", "flight.mcap", "picture.png"]


@pytest.mark.parametrize("full", FILES)
def test_a_full_disk_changes_no_verdict(full, capsys):
    build_firmware()
    Path("out/good").mkdir(parents=True)
    Path("out/good", full).symlink_to("/dev/full")
    if full == "picture.png":
        pytest.importorskip("matplotlib")
    assert main(["fly", "good.yml", "--output", "out"]) == 1
    printed = capsys.readouterr()
    assert "2 of 2" in printed.out
    assert printed.err.startswith(f"up-sim: out/good/{full}") and printed.err.count("\n") == 1
    # An incomplete file is removed.
    assert not Path("out/good", full).exists()
    assert Path("/dev/full").exists()
    assert full == "log.csv" or Path("out/good/log.csv").is_file()

"""The program: verbs, exit statuses, its output, and sentences for mistakes."""

import json
import os
import pty
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.support.firmware import build_firmware
from up_simulator.cli import VERBS, main
from up_simulator.scenario.log import read_log
from up_simulator.verbs.catalogue import shipped_paths

GOOD = """\
title: Good
duration_s: 1
sticks: [{at_s: 0, mode: FBW, arm: true, throttle: 0.5}]
expect: [{name: It flies, signal: truth.height_m, above: 50}]
"""
BAD = GOOD.replace("above: 50", "above: 5000").replace("Good", "Bad")
# In its own words a process needs more than a check of the parser.
LIMIT_S = 120.0


@pytest.fixture(autouse=True)
def in_a_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def write(name, text):
    Path(name).write_text(text, encoding="utf-8")
    return name


def test_without_a_verb_it_helps(capsys):
    assert main([]) == 2
    told = capsys.readouterr().out
    assert all(f"  {verb}" in told for verb in VERBS)


@pytest.mark.parametrize(
    ("words", "what"),
    [
        (["fyl"], "there is no verb 'fyl', did you mean 'fly'?"),
        (["xyzzy"], "('up-sim --help' lists them)"),
        (["fly", "reciever-lost"], "no scenario 'reciever-lost', did you mean 'receiver-lost'?"),
        (["fly", "nowhere.yml"], "there is no file nowhere.yml"),
        (["fly", "receiver-lost", "--set", "seed"], "not of the form key=value"),
        (["check", "xyzzy"], "there is no scenario 'xyzzy'"),
        (["signals", "tooth"], "there is no group 'tooth'"),
        (["new", "nowhere/flight"], "there is no folder nowhere"),
        (["new", "a flight!"], "is no name for a file"),
    ],
)
def test_a_wrong_word_is_one_sentence_and_status_2(words, what, capsys):
    assert main(words) == 2
    told = capsys.readouterr().err
    assert what in told and told.count("\n") == 1


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["fly", "save", "--board", "hots"], "did you mean 'host'?"),
        (["fly", "save", "--sed", "7"], "unrecognized arguments: --sed 7, did you mean --seed?"),
        (["list", "--tga", "step"], "did you mean --tag?"),
        (["tune", "--axis", "rol"], "did you mean 'roll'?"),
        (["all", "--xyzzy"], "('up-sim all --help' lists them)"),
        (["check"], "required: FILE"),
        (["--versoin"], "did you mean --version?"),
    ],
)
def test_a_wrong_option_is_one_sentence_and_status_2(words, said, capsys):
    with pytest.raises(SystemExit) as end:
        main(words)
    told = capsys.readouterr().err
    assert end.value.code == 2
    assert told.startswith("up-sim") and said in told and told.count("\n") == 1


def test_every_verb_of_ours_helps_with_examples(capsys):
    for verb in ("fly", "list", "new", "check", "signals", "all"):
        with pytest.raises(SystemExit) as end:
            main([verb, "--help"])
        assert end.value.code == 0
        told = capsys.readouterr().out
        assert "examples:" in told and f"up-sim {verb}" in told


def test_the_list_names_every_scenario(capsys):
    assert main(["list"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines[::2]] == [path.stem for path in shipped_paths()]
    assert all(line.split()[0] == "guards:" for line in lines[1::2])
    assert main(["list", "--tag", "step"]) == 0
    assert "fbw-roll-step" in capsys.readouterr().out


@pytest.mark.parametrize("verb", ["list", "all"])
def test_a_tag_that_nothing_has_is_wrong_input(verb, capsys):
    assert main([verb, "--tag", "stpe"]) == 2
    assert "no scenario has the tag 'stpe': did you mean 'step'?" in capsys.readouterr().err


@pytest.mark.parametrize("closed", [">&-", "2>&-", ">&- 2>&-", "<&- >&- 2>&-"])
@pytest.mark.parametrize(("words", "status"), [("list", 0), ("fyl", 2), ("new", 2)])
def test_closed_streams_are_no_trouble(closed, words, status):
    command = f'"{sys.executable}" -m up_simulator {words} {closed}'
    done = subprocess.run(["sh", "-c", command], capture_output=True, timeout=LIMIT_S, check=False)
    assert done.returncode == status
    assert b"Traceback" not in done.stderr and b"Exception" not in done.stderr


def test_check_tells_mistakes_with_their_places(capsys):
    assert main(["check", write("good.yml", GOOD)]) == 0
    assert "Good: 1 s, 1 expectations, no mistake" in capsys.readouterr().out
    wrong = write("wrong.yml", GOOD.replace("above", "abov").replace("arm", "amr"))
    assert main(["check", wrong, "good.yml"]) == 2
    told = capsys.readouterr()
    lines = told.err.splitlines()
    assert lines[0].startswith("wrong.yml:3:") and lines[1].startswith("wrong.yml:4:")
    assert "good.yml" in told.out


@pytest.mark.parametrize("verb", ["list", "check"])
def test_what_a_terminal_would_carry_out_is_escaped(verb, capsys):
    write("odd.yml", GOOD.replace("title: Good", 'title: "a\\e[31m\\n"'))
    assert main([verb, "odd.yml" if verb == "check" else "."]) == 0
    told = capsys.readouterr().out
    assert told.removesuffix("\n").isprintable() and "a\\x1b[31m" in told


def test_a_flight_that_holds_leaves_its_files(capsys, in_a_folder):
    build_firmware()
    assert main(["fly", write("good.yml", GOOD), "--seed", "4"]) == 0
    told = capsys.readouterr()
    assert "good: held (2 of 2 expectations)" in told.out
    assert "seed 4" in told.out and "times as fast as real time" in told.out
    folder = in_a_folder / "run" / "flights" / "good"
    names = {path.name for path in folder.iterdir()}
    assert {"log.csv", "flight.mcap", "report.txt", "summary.json"} <= names
    assert (folder / "picture.png").stat().st_size > 10_000
    assert len(read_log(folder / "log.csv")) == 51
    assert (folder / "report.txt").read_text() == told.out
    assert json.loads((folder / "summary.json").read_text())["held"] is True


def test_no_file_of_an_earlier_flight_is_left(in_a_folder):
    build_firmware()
    folder = in_a_folder / "run" / "flights" / "good"
    folder.mkdir(parents=True)
    for name in ("picture.png", "control.csv", "report.txt"):
        (folder / name).write_text("of an earlier flight")
    (folder / "black-box").mkdir()
    (folder / "black-box" / "0001-20260101T000000Z-default.mcap").write_text("of an earlier flight")
    (folder / "notes.txt").write_text("the user's own")
    assert main(["fly", write("good.yml", GOOD), "--no-picture", "--quiet"]) == 0
    names = {path.name for path in folder.iterdir()}
    assert names == {"log.csv", "flight.mcap", "report.txt", "summary.json", "notes.txt"}
    assert "of an earlier" not in (folder / "report.txt").read_text()


def test_a_flight_that_does_not_hold_is_status_1(capsys):
    build_firmware()
    words = ["fly", write("bad.yml", BAD), write("good.yml", GOOD), "--no-picture"]
    assert main([*words, "--output", "elsewhere"]) == 1
    told = capsys.readouterr().out
    assert "NOT HELD It flies" in told and "at least 5000 m" in told
    assert "1 of 2 scenarios held" in told
    assert Path("elsewhere/good/log.csv").is_file()


def test_an_aircraft_that_is_none_is_a_sentence(capsys):
    write("good.yml", GOOD + "airframe: ./nothing\n")
    assert main(["fly", "good.yml"]) == 2
    told = capsys.readouterr().err
    assert "up-sim: good: ./nothing" in told and "Traceback" not in told


def test_a_new_scenario_flies_and_holds(capsys):
    build_firmware()
    assert main(["new", "first-flight"]) == 0
    assert main(["new", "first-flight"]) == 2
    assert "is there already" in capsys.readouterr().err
    assert main(["check", "first-flight.yml"]) == 0
    assert "First flight" in capsys.readouterr().out
    assert main(["fly", "first-flight.yml", "--no-picture"]) == 0


def test_a_new_scenario_is_found_as_it_says(capsys):
    assert main(["new", "first-flight"]) == 0
    said = Path("first-flight.yml").read_text().partition("up-sim list ")[2].splitlines()[0]
    capsys.readouterr()
    assert main(["list", *said.split()]) == 0
    assert "first-flight " in capsys.readouterr().out


def test_a_new_scenario_that_cannot_be_written_is_named_and_not_left(in_a_folder):
    command = f'ulimit -f 0; exec "{sys.executable}" -m up_simulator new first-flight'
    words = ["sh", "-c", command]
    done = subprocess.run(words, capture_output=True, text=True, timeout=LIMIT_S, check=False)
    assert done.returncode == 1
    assert done.stderr == "up-sim: first-flight.yml is not written: File too large\n"
    assert list(in_a_folder.iterdir()) == []


def test_real_speed_is_no_faster_than_real_time():
    build_firmware()
    began_s = time.monotonic()
    assert main(["fly", write("good.yml", GOOD), "--speed", "real", "--no-picture"]) == 0
    assert time.monotonic() - began_s >= 0.98


def test_ctrl_c_is_a_line_and_a_partial_report():
    build_firmware()
    write("long.yml", GOOD.replace("duration_s: 1", "duration_s: 3000"))
    own, other = pty.openpty()
    command = [sys.executable, "-m", "up_simulator.cli", "fly", "long.yml", "--no-picture"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=other)
    try:
        shown = b""
        while b"x real time" not in shown:
            shown += os.read(own, 1000)
        process.send_signal(signal.SIGINT)
        told = process.communicate(timeout=LIMIT_S)[0].decode()
    finally:
        process.kill()
        process.wait()
        os.close(own)
        os.close(other)
    assert process.returncode == 130
    assert "the flight was interrupted at" in told and "Traceback" not in told
    assert "long: NOT held" in told


def test_all_flies_everything_and_counts(capsys, monkeypatch, in_a_folder):
    build_firmware()
    monkeypatch.setattr("up_simulator.verbs.catalogue.SHIPPED", in_a_folder)
    write("good.yml", GOOD)
    write("bad.yml", BAD)
    assert main(["all"]) == 1
    told = capsys.readouterr().out
    assert "1 of 2 scenarios held" in told and "MiB in one process" in told
    assert "bad: It flies:" in told and "at least 5000 m" in told
    (in_a_folder / "bad.yml").unlink()
    assert main(["all"]) == 0
    assert "1 of 1 scenarios held" in capsys.readouterr().out
    write("wrong.yml", GOOD.replace("above", "abov"))
    assert main(["all"]) == 2
    assert "wrong.yml:4:" in capsys.readouterr().err

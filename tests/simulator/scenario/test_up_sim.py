import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.firmware import build_firmware
from tests.support.program_output import fields_of
from up_simulator.cli import VERBS, main
from up_simulator.scenario.log import read_log
from up_simulator.scenario.result import NO_CRASH
from up_simulator.scenario.signals import SIGNALS
from up_simulator.verbs.catalogue import shipped_paths

GOOD = """\
title: Good
duration_s: 1
sticks: [{at_s: 0, mode: FBW, arm: true, throttle: 0.5}]
expect: [{name: It flies, signal: truth.height_m, above: 50}]
"""
BAD = GOOD.replace("above: 50", "above: 5000").replace("Good", "Bad")
LIMIT_S = 120.0


@pytest.fixture(autouse=True)
def in_a_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def write(name, text):
    Path(name).write_text(text, encoding="utf-8")
    return name


def test_without_a_verb_it_prints_the_help(capsys):
    assert main([]) == 2
    printed = capsys.readouterr().out
    assert all(f"  {verb}" in printed for verb in VERBS)


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (["fyl"], "'fly'"),
        (["xyzzy"], "--help"),
        (["fly", "reciever-lost"], "'receiver-lost'"),
        (["fly", "nowhere.yml"], "nowhere.yml"),
        (["fly", "receiver-lost", "--set", "seed"], "--set seed"),
        (["check", "xyzzy"], "'xyzzy'"),
        (["signals", "tooth"], "'tooth'"),
        (["new", "nowhere/flight"], "nowhere"),
        (["new", "a flight!"], "a flight!"),
        (["list", "--tag", "stpe"], "'step'"),
        (["all", "--tag", "stpe"], "'step'"),
    ],
)
def test_a_wrong_argument_is_one_line_and_status_2(words, named, capsys):
    assert main(words) == 2
    printed = capsys.readouterr().err
    assert printed.startswith("up-sim: ") and named in printed and printed.count("\n") == 1


@pytest.mark.parametrize(
    ("name", "code"),
    [
        ("", "no_such_scenario"),
        ("reciever-lost", "no_such_scenario"),
        ("folder", "not_a_file"),
        ("../notes", "not_a_scenario"),
        ("../nowhere", "no_such_file"),
        ("nowhere.yml", "no_such_file"),
    ],
)
def test_a_name_that_is_not_a_scenarios_has_a_code(in_a_folder, monkeypatch, capsys, name, code):
    write("notes", "not a scenario")
    (in_a_folder / "sub/folder").mkdir(parents=True)
    monkeypatch.chdir("sub")
    monkeypatch.setenv("UP_LOG_FORMAT", "json")
    for verb in ("fly", "check"):
        assert main([verb, name]) == 2
        assert [each["code"] for each in fields_of(capsys.readouterr().err)] == [code]


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (["fly", "save", "--board", "hots"], "'host'"),
        (["fly", "save", "--sed", "7"], "--seed"),
        (["list", "--tga", "step"], "--tag"),
        (["tune", "--axis", "rol"], "'roll'"),
        (["all", "--xyzzy"], "'up-sim all --help'"),
        (["check"], "FILE"),
        (["--versoin"], "--version"),
    ],
)
def test_a_wrong_option_is_one_line_and_status_2(words, named, capsys):
    with pytest.raises(SystemExit) as end:
        main(words)
    printed = capsys.readouterr().err
    assert end.value.code == 2
    assert printed.startswith("up-sim") and named in printed and printed.count("\n") == 1


def test_the_help_of_every_verb_has_examples(capsys):
    for verb in ("fly", "list", "new", "check", "signals", "all"):
        with pytest.raises(SystemExit) as end:
            main([verb, "--help"])
        assert end.value.code == 0
        printed = capsys.readouterr().out
        assert "examples:" in printed and f"up-sim {verb}" in printed


def test_the_list_names_every_scenario(capsys):
    assert main(["list"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines[::2]] == [path.stem for path in shipped_paths()]
    assert all(line.split()[0] == "guards:" for line in lines[1::2])
    assert main(["list", "--tag", "step"]) == 0
    assert "fbw-roll-step" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "names"),
    [(["list"], [path.stem for path in shipped_paths()]), (["signals"], list(SIGNALS))],
)
def test_an_answer_for_programs_is_one_document(words, names, capsys, monkeypatch):
    assert main([*words, "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert [each["name"] for each in document] == names
    monkeypatch.setenv("UP_LOG_FORMAT", "json")
    assert main(words) == 0
    assert json.loads(capsys.readouterr().out) == document


@pytest.mark.parametrize("closed", [">&-", "2>&-", ">&- 2>&-", "<&- >&- 2>&-"])
@pytest.mark.parametrize(("words", "status"), [("list", 0), ("fyl", 2), ("new", 2)])
def test_closed_streams_are_tolerated(closed, words, status):
    command = f'"{sys.executable}" -m up_simulator {words} {closed}'
    done = subprocess.run(["sh", "-c", command], capture_output=True, timeout=LIMIT_S, check=False)
    assert done.returncode == status
    assert b"Traceback" not in done.stderr and b"Exception" not in done.stderr


def test_check_reports_problems_with_their_lines(capsys):
    assert main(["check", write("good.yml", GOOD)]) == 0
    assert "good.yml" in capsys.readouterr().out
    wrong = write("wrong.yml", GOOD.replace("above", "abov").replace("arm", "amr"))
    assert main(["check", wrong, "good.yml"]) == 2
    printed = capsys.readouterr()
    lines = printed.err.splitlines()
    assert lines[0].startswith("wrong.yml:3:") and lines[1].startswith("wrong.yml:4:")
    assert "good.yml" in printed.out


@pytest.mark.parametrize("verb", ["list", "check"])
def test_terminal_controls_are_escaped(verb, capsys):
    write("odd.yml", GOOD.replace("title: Good", 'title: "a\\e[31m\\n"'))
    assert main([verb, "odd.yml" if verb == "check" else "."]) == 0
    printed = capsys.readouterr().out
    assert printed.removesuffix("\n").isprintable() and "a\\x1b[31m" in printed


def test_a_flight_writes_its_files(capsys, in_a_folder):
    build_firmware()
    assert main(["fly", write("good.yml", GOOD), "--seed", "4"]) == 0
    printed = capsys.readouterr()
    assert "seed 4" in printed.out and "2 of 2" in printed.out
    folder = in_a_folder / "run" / "flights" / "good"
    names = {path.name for path in folder.iterdir()}
    assert {"log.csv", "flight.mcap", "report.txt", "summary.json"} <= names
    assert (folder / "picture.png").stat().st_size > 10_000
    assert len(read_log(folder / "log.csv")) == 51
    assert (folder / "report.txt").read_text() == printed.out
    summary = json.loads((folder / "summary.json").read_text())
    assert summary["held"] is True and {each["code"] for each in summary["expectations"]} == {""}


def test_files_of_an_earlier_flight_are_removed(in_a_folder):
    build_firmware()
    folder = in_a_folder / "run" / "flights" / "good"
    folder.mkdir(parents=True)
    for name in ("picture.png", "control.csv", "report.txt"):
        (folder / name).write_text("stale")
    (folder / "black-box").mkdir()
    (folder / "black-box" / "0001-20260101T000000Z-default.mcap").write_text("stale")
    (folder / "notes.txt").write_text("the user's own")
    assert main(["fly", write("good.yml", GOOD), "--no-picture", "--quiet"]) == 0
    names = {path.name for path in folder.iterdir()}
    assert names == {"log.csv", "flight.mcap", "report.txt", "summary.json", "notes.txt"}
    assert "stale" not in (folder / "report.txt").read_text()


def test_a_failed_flight_is_status_1(capsys):
    build_firmware()
    words = ["fly", write("bad.yml", BAD), write("good.yml", GOOD), "--no-picture"]
    assert main([*words, "--output", "elsewhere"]) == 1
    printed = capsys.readouterr().out
    assert "5000 m" in printed and "1 of 2" in printed
    summary = json.loads(Path("elsewhere/bad/summary.json").read_text())
    codes = {each["name"]: each["code"] for each in summary["expectations"]}
    assert codes == {"It flies": "out_of_limits", NO_CRASH: ""}
    assert Path("elsewhere/good/log.csv").is_file()


def test_an_unknown_airframe_is_status_2(capsys):
    write("good.yml", GOOD + "airframe: ./nothing\n")
    assert main(["fly", "good.yml"]) == 2
    printed = capsys.readouterr().err
    assert "up-sim: good: ./nothing" in printed and "Traceback" not in printed


def test_a_new_scenario_is_listed_by_its_tag_and_holds(capsys):
    build_firmware()
    assert main(["new", "first-flight"]) == 0
    assert main(["new", "first-flight"]) == 2
    assert main(["check", "first-flight.yml"]) == 0
    assert main(["fly", "first-flight.yml", "--no-picture"]) == 0
    options = Path("first-flight.yml").read_text().partition("up-sim list ")[2].splitlines()[0]
    capsys.readouterr()
    assert main(["list", *options.split()]) == 0
    assert "first-flight " in capsys.readouterr().out


def test_a_new_scenario_that_cannot_be_written_is_removed(in_a_folder):
    command = f'ulimit -f 0; exec "{sys.executable}" -m up_simulator new first-flight'
    words = ["sh", "-c", command]
    done = subprocess.run(words, capture_output=True, text=True, timeout=LIMIT_S, check=False)
    assert done.returncode == 1
    assert "first-flight.yml" in done.stderr and done.stderr.count("\n") == 1
    assert list(in_a_folder.iterdir()) == []


@pytest.mark.parametrize(
    ("name", "path", "code"),
    [
        ("betaflight-loiter", "", "board_unavailable"),
        ("uplink-failover", os.environ["PATH"], "paths_unavailable"),
    ],
)
def test_a_flight_that_this_machine_cannot_fly_is_named_and_left_out(
    name, path, code, capsys, monkeypatch, tmp_path
):
    build_firmware()
    shipped = shipped_paths()[0].with_name(f"{name}.yml")
    monkeypatch.setattr("up_simulator.verbs.catalogue.SHIPPED", tmp_path)
    (tmp_path / shipped.name).write_bytes(shipped.read_bytes())
    monkeypatch.setenv("PATH", path)
    monkeypatch.setattr("os.geteuid", lambda: 1000)
    assert main(["all", "--output", str(tmp_path)]) == 0
    printed = capsys.readouterr()
    assert "0 of 0" in printed.out and name in printed.err
    monkeypatch.setenv("UP_LOG_FORMAT", "json")
    assert main(["fly", name, "--output", str(tmp_path)]) == 1
    assert [each["code"] for each in fields_of(capsys.readouterr().err)][-1] == code


def test_all_flies_every_scenario_and_counts(capsys, monkeypatch, in_a_folder):
    build_firmware()
    monkeypatch.setattr("up_simulator.verbs.catalogue.SHIPPED", in_a_folder)
    write("good.yml", GOOD)
    write("bad.yml", BAD)
    assert main(["all"]) == 1
    printed = capsys.readouterr().out
    assert "1 of 2" in printed and "at least 5000 m" in printed
    (in_a_folder / "bad.yml").unlink()
    assert main(["all"]) == 0
    assert "1 of 1" in capsys.readouterr().out
    write("wrong.yml", GOOD.replace("above", "abov"))
    assert main(["all"]) == 2
    assert "wrong.yml:4:" in capsys.readouterr().err

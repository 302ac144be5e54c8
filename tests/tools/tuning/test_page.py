"""docs/tuning.md: its commands work as stated, its rules and options are those of the code."""

import re
from pathlib import Path

import pytest

from tests.support.firmware import build_firmware
from tools.tuning.cli import _parser
from tools.tuning.evaluation import Rules
from tools.tuning.margins import Multisine
from up_simulator.cli import main

PAGE = Path(__file__).parents[3] / "docs" / "tuning.md"
TEXT = PAGE.read_text(encoding="utf-8")
WORDS = " ".join(TEXT.split())
RUNS = re.findall(r"<!-- run: up-sim -->\n```\n(.*?)```", TEXT, re.DOTALL)


@pytest.mark.usefixtures("bench")
def test_the_commands_of_the_page_work(tmp_path, monkeypatch, capsys):
    build_firmware()
    monkeypatch.chdir(tmp_path)
    tuned, flown = RUNS
    # tests/tools/tuning/test_cli.py runs this one with more options.
    assert tuned == "up-sim tune --axis roll --quick\n"
    for line in flown.splitlines():
        program, *arguments = line.split()
        assert program == "up-sim"
        assert main(arguments) == 0, (line, capsys.readouterr())
    assert list((tmp_path / "run" / "tuning").glob("*.png"))


def test_the_rules_of_the_page_are_those_of_the_code():
    rules = Rules()
    assert (
        f"{rules.gain_margin_db:g} dB of gain, {rules.phase_margin_deg:g} degrees of phase,"
        f" {rules.delay_margin_ms:g} ms of delay and a peak sensitivity of"
        f" {rules.peak_sensitivity:g}; overshoots {rules.overshoot_percent:g} % at most; and lacks"
        f" {rules.steady_error_percent:g} % at most"
    ) in WORDS
    hz = Multisine().frequencies_hz
    assert f"a sum of {len(hz)} small sines, {hz[0]:g} to {hz[-1]:.0f} Hz" in WORDS


def test_every_option_that_the_page_names_is_one():
    known = {option for action in _parser()._actions for option in action.option_strings}
    table = TEXT.partition("| option |")[2].partition("\n\n")[0]
    named = set(re.findall(r"`(--[a-z]+)", table))
    assert named <= known
    assert known - named == {"-h", "--help", "--quick", "--processes"}

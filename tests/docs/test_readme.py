"""README.md: the flight that it shows is flown so."""

import json
import re

from tests.support.firmware import build_firmware
from tests.support.virtual_environment import REPOSITORY
from up_simulator.cli import main

TEXT = (REPOSITORY / "README.md").read_text(encoding="utf-8")


def test_the_figures_of_the_flight_are_its_own(tmp_path, capsys):
    build_firmware()
    (command,) = re.findall(r"by `up-sim (fly \w+)`", TEXT)
    assert main([*command.split(), "--no-picture", "--output", str(tmp_path)]) == 0
    capsys.readouterr()
    summary = json.loads((tmp_path / "save" / "summary.json").read_text(encoding="utf-8"))
    found = {each["name"]: each["figure"] for each in summary["expectations"]}
    wings_s, nose_s, load_g = re.search(
        r"wings are level after\s([\d.]+) s, the nose after ([\d.]+) s, at ([\d.]+) g", TEXT
    ).groups()
    assert f"{float(found['The wings are level again'].split()[0]):.1f}" == wings_s
    assert f"{float(found['The nose is up again'].split()[0]):.1f}" == nose_s
    assert f"{float(found['The wing is not overloaded'].split()[2]):.1f}" == load_g

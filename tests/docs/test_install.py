"""docs/install.md: what its commands leave in the configuration's folder."""

import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
COPIES = re.findall(
    r"sudo (cp \S+ \S*config\S*) /etc/raspilot", (ROOT / "docs/install.md").read_text()
)


@pytest.mark.parametrize("copy", COPIES)
def test_the_templates_join_those_of_the_cogs(copy, tmp_path):
    etc = tmp_path / "etc"
    etc.mkdir()
    # As `up gather` has made it, and then its user has changed it.
    (etc / "pids.yml").write_text("mine")
    shutil.copytree(ROOT / "config", tmp_path / "config")
    program, options, source = copy.split()
    words = [program, options, f"config{source.partition('config')[2]}", str(etc)]
    subprocess.run(words, cwd=tmp_path, check=True)
    assert {each.name for each in etc.iterdir()} == {p.name for p in (ROOT / "config").iterdir()}
    assert (etc / "pids.yml").read_text() == "mine"


def test_both_ways_of_installing_are_tried():
    assert len(COPIES) == 2

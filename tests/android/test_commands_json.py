"""The forms that the app shows are those of the Commands of this installation."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from tools.phone_commands import ASSET, asset_text
from up_ground.catalogue import Catalogue


def test_the_asset_is_up_to_date():
    said = ASSET.read_text(encoding="ascii") if ASSET.exists() else ""
    assert said == asset_text(Catalogue.installed()), (
        f"{ASSET.name} is not what the Commands say now: run tools/phone_commands.py, commit it"
    )


def test_the_tool_writes_the_same_bytes_each_time(tmp_path):
    for name, seed in (("one.json", "1"), ("two.json", "2")):
        done = subprocess.run(
            [sys.executable, "-m", "tools.phone_commands", str(tmp_path / name)],
            env={**os.environ, "PYTHONHASHSEED": seed},
            cwd=ASSET.parents[3],
            capture_output=True,
            text=True,
            timeout=60,
        )
        assert (done.returncode, done.stderr) == (0, "")
    assert (tmp_path / "one.json").read_bytes() == (tmp_path / "two.json").read_bytes()
    assert (tmp_path / "one.json").read_bytes() == ASSET.read_bytes()


def test_a_catalogue_that_is_not_whole_is_not_written():
    with pytest.raises(ValueError, match="broken_cog"):
        asset_text(Catalogue([], ["without broken_cog"]))


def test_another_python_is_told_which_one_it_takes():
    done = subprocess.run(
        [sys.executable, "-I", "-S", str(ASSET.parents[3] / "tools" / "phone_commands.py")],
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.returncode == 1
    assert "Traceback" not in done.stderr
    assert ".venv/bin/python tools/phone_commands.py" in done.stderr

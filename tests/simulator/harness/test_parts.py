"""A board that was requested by name and is missing: what to install or leave out."""

import argparse
import shutil

import pytest

from up_rig.build import build_host_library
from up_simulator.aircraft import load_airframe
from up_simulator.firmware import build
from up_simulator.firmware.build import BoardUnavailableError
from up_simulator.harness.user_log import no_log
from up_simulator.harness.virtual_aircraft import make_board

OPTIONS = {"framing": "checked", "elf": None, "gains": None, "seed": 1}


@pytest.fixture
def no_compiler(monkeypatch, tmp_path):
    build_host_library.cache_clear()
    (tmp_path / "bin").mkdir()
    for name in ("make", "sh"):
        (tmp_path / "bin" / name).symlink_to(shutil.which(name))
    monkeypatch.setenv("PATH", str(tmp_path / "bin"))
    monkeypatch.setattr(build, "HOST_LIBRARY", tmp_path / "nothing.so")


def test_a_missing_compiler_names_the_package_and_the_option_to_leave_out(no_compiler):
    options = argparse.Namespace(board="host", **OPTIONS)
    with pytest.raises(BoardUnavailableError) as error:
        make_board(options, load_airframe("glider"), no_log)
    text = str(error.value)
    assert text.startswith("--board host: ") and "apt-get install g++" in text
    assert "leave --board out" in text

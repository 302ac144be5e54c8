"""The whole system with another controller, and where compilers, models and ports are missing."""

import os
import shutil
import signal
import socket
import subprocess
import sys
from pathlib import Path

from tests.support.firmware import build_firmware
from tests.support.program_output import AS_JSON, fields_of
from tests.support.showcase import Showcase, steepest
from tests.support.waiting import DEADLINE_S

ROOT = Path(__file__).parents[1]
WITHOUT_MODEL_AND_PAGE = """
import sys


class Without:
    def find_spec(self, name, path=None, target=None):
        if name in ("autobahn", "jsbsim"):
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)


sys.meta_path.insert(0, Without())
"""


def test_moving_the_controller_to_the_pi_is_configuration_only(tmp_path):
    build_firmware()
    showcase = Showcase(tmp_path, "--controller", "raspberry").ready()
    try:
        assert any(each["flies"] for each in showcase.events("raspilot", "control_changed"))
        frames = showcase.telemetry(60)
    finally:
        assert showcase.stop(signal.SIGTERM) == 0
    assert all(frame["flight_mode"] == "OUTPUT" for frame in frames)
    assert all(frame["flight_control"]["mode"] == "FBW" for frame in frames)
    assert steepest(frames) < 45
    counters = [frame["counters"].get("flight_control", {}) for frame in frames]
    published = [each.get("published", 0) for each in counters]
    assert published[-1] - published[0] > 60


def test_without_jsbsim_and_autobahn_the_built_in_model_flies_and_no_page(tmp_path):
    (tmp_path / "sitecustomize.py").write_text(WITHOUT_MODEL_AND_PAGE)
    showcase = Showcase(tmp_path, PYTHONPATH=str(tmp_path)).ready()
    try:
        (line,) = (each for each in showcase.said().splitlines() if each.startswith("  page "))
        assert "autobahn" in line and "http:" not in showcase.said()
        (model,) = showcase.events("aircraft", "flight_selected")
        assert model["source"] == "built-in"
        # The circling pilot holds a bank.
        frames = showcase.telemetry(60)
        assert 5 < steepest(frames) < 45
    finally:
        assert showcase.stop(signal.SIGTERM) == 0


def clone_with_nothing_built(folder):
    """The files of a user who never could build the firmware."""
    ignored = shutil.ignore_patterns("__pycache__", "build", "build-*")
    for name in ("up", "raspilot", "simulator", "arduino"):
        shutil.copytree(ROOT / name, folder / name, ignore=ignored)
    shutil.copy(ROOT / "main.py", folder)
    return [folder, folder / "simulator", folder / "arduino" / "bench"]


def test_without_any_compiler_the_error_names_the_packages(tmp_path):
    """Where neither avr-gcc nor g++ is found; the search path leads to make alone."""
    tools = tmp_path / "bin"
    tools.mkdir()
    (tools / "make").symlink_to(shutil.which("make"))
    packages = clone_with_nothing_built(tmp_path / "clone")
    showcase = Showcase(tmp_path, path=str(tools), PYTHONPATH=os.pathsep.join(map(str, packages)))
    assert showcase.process.wait(60) == 1
    assert "needs a C++ compiler" in showcase.said().splitlines()[-1]
    assert "Traceback" not in showcase.said()


def test_without_any_port_there_is_nothing_to_run_for(tmp_path):
    taken = socket.socket()
    taken.bind(("", 0))
    taken.listen()
    port = taken.getsockname()[1]
    (tmp_path / "arduino.yml").write_text(f"port: {tmp_path / 'nothing'}\n")
    (tmp_path / "android.yml").write_text(f"general port: {port}\norientation port: 0\n")
    (tmp_path / "discovery.yml").write_text("port: 0\n")
    result = subprocess.run(
        [sys.executable, str(ROOT / "main.py"), "--config", str(tmp_path)],
        capture_output=True, text=True, timeout=DEADLINE_S, check=False,
        env={**os.environ, **AS_JSON},
    )  # fmt: skip
    taken.close()
    assert result.returncode == 1
    assert "no_source" in [each.get("code") for each in fields_of(result.stderr)]

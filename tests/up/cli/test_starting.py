"""The user's whole road: a cog from outside, gathered or registered, started and stopped."""

import selectors
import signal
import subprocess
import time
from pathlib import Path

import pytest

from tests.support.program_output import AS_JSON, fields_of
from tests.support.virtual_environment import VirtualEnvironment

LIMIT_S = 120


@pytest.fixture
def environment(tmp_path):
    return VirtualEnvironment(tmp_path / "environment")


def start(environment: VirtualEnvironment, *arguments: str, cwd: Path) -> subprocess.Popen[bytes]:
    return subprocess.Popen(
        [environment.python, *arguments],
        cwd=cwd,
        env=environment.environ(AS_JSON),
        stdin=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
    )


def read_until(process: subprocess.Popen[bytes], text: bytes) -> bytes:
    """Return the process's output on stderr up to a text."""
    assert process.stderr is not None
    said = b""
    deadline = time.monotonic() + LIMIT_S
    with selectors.DefaultSelector() as selector:
        selector.register(process.stderr, selectors.EVENT_READ)
        while text not in said:
            assert selector.select(deadline - time.monotonic()), said
            chunk = process.stderr.read1()
            assert chunk, said
            said += chunk
    return said


def stop(process: subprocess.Popen[bytes]) -> int:
    process.send_signal(signal.SIGTERM)
    process.communicate(timeout=LIMIT_S)
    return process.returncode


@pytest.mark.parametrize("road", ["gather", "register"])
def test_a_cog_from_outside_flies(environment, tmp_path, road):
    environment.up("create", "new", "-n", "plane", cwd=tmp_path)
    environment.up("create", "cog", "-n", "lidar", cwd=tmp_path)
    plane = tmp_path / "plane"
    if road == "gather":
        (plane / "Cogfile.yml").write_text("lidar_cog: {path: ../lidar_cog}\n")
        environment.up("gather", cwd=plane)
    else:
        build = "from setuptools import build_meta\nbuild_meta.build_wheel('dist')\n"
        environment.run("-c", build, cwd=tmp_path / "lidar_cog")
        wheel = next((tmp_path / "lidar_cog/dist").glob("*.whl"))
        environment.run("-m", "pip", "install", "--quiet", "--no-deps", str(wheel), cwd=tmp_path)
        environment.up("register", "-n", "lidar_cog", cwd=plane)
    assert "LidarModule" in environment.up("modules", cwd=plane).stdout
    environment.up("check", cwd=plane)

    # Each road starts one of the two entries.
    entry = ("-m", "up.cli", "start") if road == "gather" else ("main.py",)
    process = start(environment, *entry, cwd=plane)
    said = read_until(process, b'"started"')
    assert b"veto" not in said and b"traceback" not in said
    assert stop(process) == 0

    environment.run("-m", "pip", "uninstall", "--yes", "raspilot-lidar-cog", cwd=tmp_path)
    done = environment.up("start", cwd=plane, environ=AS_JSON, status=2)
    (problem,) = fields_of(done.stderr)
    assert (problem["code"], problem["cog"]) == ("cog_import_failed", "lidar_cog")

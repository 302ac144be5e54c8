"""What `make` does before anything flies: a virtual environment, and what goes into it."""

import os
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest

TOOLS = Path(__file__).parents[2] / "tools"
DEADLINE_S = 120.0
INTERRUPTED = 130


@pytest.fixture(scope="module")
def python(tmp_path_factory):
    """A virtual environment as `make` makes it, for this module alone."""
    folder = tmp_path_factory.mktemp("set-up") / "venv"
    subprocess.run([TOOLS / "make_venv", sys.executable, folder], check=True, capture_output=True)
    return folder / "bin" / "python"


@pytest.fixture
def silent_index():
    """A port that takes connections and never answers."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        server.settimeout(DEADLINE_S)
        yield server


def environment(port):
    index = {"PIP_INDEX_URL": f"http://127.0.0.1:{port}/simple", "PIP_RETRIES": "1"}
    kept = {name: value for name, value in os.environ.items() if not name.startswith("PIP_")}
    return {**kept, **index, "PIP_CONFIG_FILE": os.devnull, "no_proxy": "127.0.0.1"}


def start(words, environ, folder):
    return subprocess.Popen(
        [str(each) for each in words], env=environ, cwd=folder, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True,
    )  # fmt: skip


def test_without_a_network_it_is_one_sentence(python, tmp_path):
    with socket.socket() as closed:
        closed.bind(("127.0.0.1", 0))
        port = closed.getsockname()[1]
        process = start([TOOLS / "install", python, "sim"], environment(port), tmp_path)
        _, error = process.communicate(timeout=DEADLINE_S)
    assert process.returncode == 4
    assert error.count("\n") == 1


def test_what_else_fails_is_said_as_pip_says_it(python, tmp_path):
    environ = {**environment(9), "PIP_NO_INDEX": "1"}
    process = start([TOOLS / "install", python, "sim"], environ, tmp_path)
    _, error = process.communicate(timeout=DEADLINE_S)
    assert process.returncode == 1
    assert "ERROR: " in error, "in the words of pip"


def test_ctrl_c_while_it_installs_is_one_line(python, silent_index, tmp_path):
    port = silent_index.getsockname()[1]
    process = start([TOOLS / "install", python, "sim"], environment(port), tmp_path)
    asked, _ = silent_index.accept()
    # As from a terminal: to every process of the group.
    os.killpg(process.pid, signal.SIGINT)
    _, error = process.communicate(timeout=DEADLINE_S)
    asked.close()
    assert (process.returncode, error.count("\n")) == (INTERRUPTED, 1)


def test_ctrl_c_leaves_no_half_of_an_environment(tmp_path):
    folder = tmp_path / "venv"
    process = start([TOOLS / "make_venv", sys.executable, folder], dict(os.environ), tmp_path)
    deadline_s = time.monotonic() + DEADLINE_S
    while not (folder / "bin" / "python").exists():
        assert process.poll() is None and time.monotonic() < deadline_s
        time.sleep(0.001)
    os.killpg(process.pid, signal.SIGINT)
    _, error = process.communicate(timeout=DEADLINE_S)
    assert (process.returncode, error.count("\n")) == (INTERRUPTED, 1)
    assert not folder.exists()
